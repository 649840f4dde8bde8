// Light for the hall of boxes: a lit patch of its far wall and one of its ceiling, as a reflective shadow map would have them.
#ifndef CLV_TESTS_CPU_MOVING_SCENE_H
#define CLV_TESTS_CPU_MOVING_SCENE_H
#include "clv/cpu/moving_lighting.h"
#include "cpu/box_scene.h"

namespace clv::test {

// 2 * 16 * 16 texels; the flux of the wall's patch is multiplied by `wall`, and texels have this dynamicity.
inline std::vector<ClvRsmTexel> litPatches(float wall = 1.0f, float dynamicity = 0.0f) {
    const int n = 16;
    std::vector<ClvRsmTexel> texels;
    for (int row = 0; row < 2 * n; ++row) {
        for (int column = 0; column < n; ++column) {
            const float u = (float(column) + 0.5f) / n, v = (float(row % n) + 0.5f) / n;
            ClvRsmTexel texel{};
            texel.valid = 1;
            texel.dynamicity = dynamicity;
            if (row < n) {
                texel.position = vec3(-10.03f, -2.0f + 3.0f * v, -3.0f + 6.0f * u);
                texel.normal = vec3(1.0f, 0.0f, 0.0f);
                texel.flux = vec3(0.5f, 0.4f, 0.2f) * wall;
            } else {
                texel.position = vec3(3.0f + 4.0f * u, 3.02f, -4.0f + 5.0f * v);
                texel.normal = vec3(0.0f, -1.0f, 0.0f);
                texel.flux = vec3(0.1f, 0.2f, 0.3f);
            }
            texels.push_back(texel);
        }
    }
    return texels;
}

struct LitHall {
    BoxScene scene = hall();
    std::vector<ClvRsmTexel> texels = litPatches();
    TexelSampler sampler;

    LitHall() { light(litPatches()); }
    LitHall(const LitHall&) = delete;
    void light(std::vector<ClvRsmTexel> lit) {
        texels = std::move(lit);
        sampler.build(texels, 16, serialFor());
    }
    Tracer tracer() const {
        return [this](std::span<ClvRay> rays) { scene.trace(rays); };
    }
    void frame(MovingLighting& lighting, std::size_t rays, float timestep = 1.0f / 60.0f) const {
        lighting.rays(sampler, rays);
        lighting.trace();
        lighting.inject();
        lighting.merge(timestep);
    }
};

// Two cascades of cells of 0.5 and 1 m.
inline MovingLightingSettings twoCascades() {
    return {.cascades = {.count = 2, .resolution = ivec3(20, 16, 20), .finestCellSize = 0.5}, .linesPerCell = 3};
}

inline CameraView viewFrom(double x, double y, double z) { return {.position = {x, y, z}}; }

// Points of the hall's floor within `reach` (m) of a position, looking up.
inline std::vector<ClvReceiver> floorAround(const vec3& center, float reach) {
    std::vector<ClvReceiver> receivers;
    const int n = 12;
    for (int i = 0; i < n * n; ++i) {
        const vec3 offset(float(i % n) + 0.5f - 0.5f * n, 0.0f, float(i / n) + 0.5f - 0.5f * n);
        const vec3 p = vec3(center.x, -3.02f, center.z) + offset * (2.0f * reach / n);
        const bool inHall = std::abs(p.x) < 9.8f && std::abs(p.z) < 6.8f;
        if (inHall) receivers.push_back({p, 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
    }
    return receivers;
}

inline std::vector<vec3> irradianceAt(const MovingLighting& lighting, std::span<const ClvReceiver> receivers) {
    std::vector<vec3> out;
    for (const ClvReceiver& receiver : receivers) out.push_back(lighting.irradiance(receiver));
    return out;
}

// What a still volume says where a cascade of `lighting` stands, after all its rays at once.
inline std::vector<vec3> stillIrradiance(const LitHall& hall, const MovingLighting& lighting, int cascade,
                                         std::span<const ClvReceiver> receivers, std::size_t count, uint seed) {
    const DepositLayout layout;
    const ClvVolume& place = lighting.cascades().volumes[cascade];
    Volume volume(buildLevel(place, hall.scene.probe(), {}, serialFor(), {.linesPerCell = 3}), layout, {.halves = 1, .chunks = 1});
    FrameRays rays({.halves = 1, .chunks = 1}, seed, 1e-4f);
    rays.draw(hall.sampler, count, serialFor());
    rays.trace(hall.tracer(), serialFor());
    inject(volume.level(), layout, kClvInjectTrackLength, rays.all(), volume.partial(0, 0));
    volume.merge(double(count), 1.0f / float(count), serialFor());
    std::vector<vec3> out;
    for (const ClvReceiver& receiver : receivers) {
        SlotWeights weights;
        lookupWeights(volume.level(), receiver, {}, weights);
        out.push_back(readIrradiance(layout, volume.history(0), weights, clvReadCoefficients(layout.storage, receiver.normal)));
    }
    return out;
}

inline vec3 meanOf(std::span<const vec3> values) {
    vec3 sum(0.0f);
    for (const vec3& v : values) sum += v;
    return sum / float(values.size());
}

// Root mean square of the difference over all channels, over the mean of the truth.
inline double relativeError(std::span<const vec3> values, std::span<const vec3> truth) {
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const vec3 d = values[i] - truth[i];
        squares += dot(d, d);
        sum += double(truth[i].x) + truth[i].y + truth[i].z;
    }
    return std::sqrt(squares / (3.0 * double(truth.size()))) / (sum / (3.0 * double(truth.size())));
}

}  // namespace clv::test
#endif
