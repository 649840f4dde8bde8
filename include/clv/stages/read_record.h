// A slot's record, read for a normal.
//
// A shader defines, before it includes this: vec4 clvReadHistory(uint row), four numbers of the records.
#ifndef CLV_STAGES_READ_RECORD_H
#define CLV_STAGES_READ_RECORD_H
#include "record.h"
CLV_NAMESPACE_BEGIN

// Adds what four numbers of a record give, from coefficient times channel `index` on.
CLV_FN void clvReadNumber(CLV_INOUT(vec3) sum, uint channels, ClvCoefficients read, uint index, float value) {
    if (channels == 1u) {
        sum.x += clvCoefficient(read, index) * value;
        return;
    }
    float part = clvCoefficient(read, index / 3u) * value;
    uint channel = index % 3u;
    if (channel == 0u) sum.x += part;
    if (channel == 1u) sum.y += part;
    if (channel == 2u) sum.z += part;
}

// The sum over coefficients of `read` times the record's, W m, by channel; three equal ones in a scene without colour.
CLV_READER_FN vec3 clvReadRecord(CLV_READER uint record, uint storage, uint channels, uint stride, ClvCoefficients read) {
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    uint values = clvCoefficientCount(storage) * channels;
    for (uint index = 0u; index < values; index += 4u) {
        vec4 row = CLV_READ clvReadHistory(record * (stride / 4u) + index / 4u);
        clvReadNumber(sum, channels, read, index, row.x);
        clvReadNumber(sum, channels, read, index + 1u, row.y);
        clvReadNumber(sum, channels, read, index + 2u, row.z);
        clvReadNumber(sum, channels, read, index + 3u, row.w);
    }
    return channels == 1u ? vec3(sum.x, sum.x, sum.x) : sum;
}

CLV_NAMESPACE_END
#endif
