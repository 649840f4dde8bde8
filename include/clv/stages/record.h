// The record of a slot: coefficient k of channel c at index k * channels + c, padded with zeros to whole vectors of eight.
#ifndef CLV_STAGES_RECORD_H
#define CLV_STAGES_RECORD_H
#include "../data/cell.h"
#include "../data/ray.h"
#include "../math/finite.h"
CLV_NAMESPACE_BEGIN

// A set of coefficients for each channel; a scene without colour uses the first.
struct ClvRecord {
    ClvCoefficients r;
    ClvCoefficients g;
    ClvCoefficients b;
};

CLV_FN ClvCoefficients clvNoCoefficients() {
    ClvCoefficients x;
    x.a = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    x.b = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    x.c = 0.0f;
    return x;
}

CLV_FN ClvRecord clvNoRecord() {
    ClvRecord record;
    record.r = clvNoCoefficients();
    record.g = clvNoCoefficients();
    record.b = clvNoCoefficients();
    return record;
}

// Coefficient k; 0 from the ninth on.
CLV_FN float clvCoefficient(ClvCoefficients x, uint k) {
    if (k < 4u) return k == 0u ? x.a.x : k == 1u ? x.a.y : k == 2u ? x.a.z : x.a.w;
    if (k < 8u) return k == 4u ? x.b.x : k == 5u ? x.b.y : k == 6u ? x.b.z : x.b.w;
    return k == 8u ? x.c : 0.0f;
}

// Number `index` of the record; what pads it is 0.
CLV_FN float clvRecordValue(ClvRecord record, uint channels, uint index) {
    if (channels == 1u) return clvCoefficient(record.r, index);
    uint channel = index % 3u;
    if (channel == 0u) return clvCoefficient(record.r, index / 3u);
    if (channel == 1u) return clvCoefficient(record.g, index / 3u);
    return clvCoefficient(record.b, index / 3u);
}

// Four numbers of the record, from index 4 * row on.
CLV_FN vec4 clvRecordRow(ClvRecord record, uint channels, uint row) {
    return vec4(clvRecordValue(record, channels, 4u * row), clvRecordValue(record, channels, 4u * row + 1u),
                clvRecordValue(record, channels, 4u * row + 2u), clvRecordValue(record, channels, 4u * row + 3u));
}

CLV_FN void clvAddCoefficients(CLV_INOUT(ClvCoefficients) sum, ClvCoefficients x, float weight) {
    sum.a += x.a * weight;
    sum.b += x.b * weight;
    sum.c += x.c * weight;
}

// Adds coefficients of this flux and weight; `channels` is 3, or 1 to use flux.x alone.
CLV_FN void clvAddToRecord(CLV_INOUT(ClvRecord) record, uint channels, ClvCoefficients x, vec3 flux, float weight) {
    clvAddCoefficients(record.r, x, flux.x * weight);
    if (channels == 1u) return;
    clvAddCoefficients(record.g, x, flux.y * weight);
    clvAddCoefficients(record.b, x, flux.z * weight);
}

// Whether a ray can carry light: its flux is finite, and its direction of unit length, or nearly.
CLV_FN bool clvCarriesLight(ClvRay ray) {
    float squared = dot(ray.direction, ray.direction);
    return clvIsFinite(ray.flux) && clvIsFinite(ray.direction) && squared > 0.25f && squared < 4.0f;
}

// Flux of a ray by channel: in a scene without colour the mean in x. A ray that cannot carry light has none. What a channel has beyond
// `most`, W, see clvMostFlux, is cut off.
CLV_FN vec3 clvChannelFlux(uint channels, ClvRay ray, float most) {
    if (!clvCarriesLight(ray)) return vec3(0.0f, 0.0f, 0.0f);
    vec3 flux = min(max(ray.flux, vec3(-most, -most, -most)), vec3(most, most, most));
    if (channels == 1u) return vec3((flux.x + flux.y + flux.z) * (1.0f / 3.0f), 0.0f, 0.0f);
    return flux;
}

// What a ray adds to a record per metre. kept: its direction as cells keep it; most: see clvChannelFlux.
CLV_FN ClvRecord clvRecordOfRay(uint storage, uint channels, ClvRay ray, vec3 kept, float most) {
    ClvRecord record = clvNoRecord();
    // A direction that is not finite would make 0 * NaN.
    if (clvCarriesLight(ray)) clvAddToRecord(record, channels, clvDepositCoefficients(storage, kept), clvChannelFlux(channels, ray, most), 1.0f);
    return record;
}

CLV_NAMESPACE_END
#endif
