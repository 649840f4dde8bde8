// The walk of 16 rays at once. Lanes advance in lockstep, without branches; crossings of cells that have a slot come out
// step by step, lanes in order, so that every implementation writes the same deposits in the same order.
#ifndef CLV_CPU_PACKET_WALK_H
#define CLV_CPU_PACKET_WALK_H
#include <cstddef>
#include <limits>
#include <span>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "../stages/inject.h"
#include "level.h"

namespace clv {

inline constexpr int kPacketLanes = 16;

// Crossings in the order in which they are to be deposited.
struct CrossingBuffer {
    static constexpr int kCapacity = 1024;
    // Room for a step of 16 lanes past the point at which the buffer is flushed.
    alignas(64) uint entry[kCapacity + kPacketLanes];    // of the cell table
    alignas(64) uint lane[kCapacity + kPacketLanes];
    alignas(64) float weight[kCapacity + kPacketLanes];  // m, or the thesis' 1
    alignas(64) float middle[kCapacity + kPacketLanes];  // m along the ray
    int count = 0;
};

// Walks up to 16 rays; calls flush(buffer) whenever the buffer is full, and leaves the rest in it. Written with the shared
// functions of stages/inject.h: the reference for the vector code, and the path of machines without it.
template <class Flush>
void walkPacketPortable(const Level& level, uint rule, std::span<const ClvRay> rays, CrossingBuffer& buffer, Flush&& flush) {
    ClvWalk walks[kPacketLanes];
    int active = 0;
    const int lanes = int(rays.size());
    const float h = level.volume.cellSize;
    for (int i = 0; i < lanes; ++i) {
        walks[i] = clvWalkBegin(level.volume, rays[i]);
        active += walks[i].running;
    }
    while (active > 0) {
        active = 0;
        for (int i = 0; i < lanes; ++i) {
            if (walks[i].running == 0) continue;
            ClvCrossing crossing = clvWalkStep(walks[i], rays[i].direction);
            active += walks[i].running;
            const uint entry = level.table[clvCellIndex(level.volume, crossing.cell)];
            const float weight = clvCrossingWeight(rule, crossing, h);
            if (entry == kClvNoSlot || !(weight > 0.0f)) continue;
            const int k = buffer.count++;
            buffer.entry[k] = entry;
            buffer.lane[k] = uint(i);
            buffer.weight[k] = weight;
            buffer.middle[k] = 0.5f * (crossing.tBegin + crossing.tEnd) * h;
        }
        if (buffer.count >= CrossingBuffer::kCapacity - kPacketLanes) flush(buffer);
    }
}

#if defined(__AVX512F__)
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
// GCC 12's intrinsics start from values that they leave undefined on purpose, and warn about it where they are inlined.
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace detail {

// Three axes of 16 lanes.
struct Lanes3 {
    __m512 x, y, z;
};

inline __m512 selectAxis(const std::span<const ClvRay>& rays, const float ClvRay::*member) {
    alignas(64) float v[kPacketLanes] = {};
    for (std::size_t i = 0; i < rays.size(); ++i) v[i] = rays[i].*member;
    return _mm512_load_ps(v);
}
inline Lanes3 selectAxes(const std::span<const ClvRay>& rays, const vec3 ClvRay::*member) {
    alignas(64) float x[kPacketLanes] = {}, y[kPacketLanes] = {}, z[kPacketLanes] = {};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        x[i] = (rays[i].*member).x;
        y[i] = (rays[i].*member).y;
        z[i] = (rays[i].*member).z;
    }
    return {_mm512_load_ps(x), _mm512_load_ps(y), _mm512_load_ps(z)};
}

// One axis of the walk.
struct AxisWalk {
    __m512 origin, inverse, boundary, boundaryStep, direction;
    __m512i cell, cellStep;  // storage coordinate, already multiplied by the axis' stride in the cell table
    __m512i wrapAt, wrapBy;  // a coordinate that reaches wrapAt goes on at wrapAt + wrapBy
    __mmask16 parallel, finite;
    __m512 slabLo, slabHi;

    // Follows clvWalkInverse and clvWalkSlab.
    void begin(__m512 originMetres, __m512 dir, float lowest, float scale, float size) {
        const __m512 zero = _mm512_setzero_ps(), one = _mm512_set1_ps(1.0f);
        direction = dir;
        origin = _mm512_mul_ps(_mm512_sub_ps(originMetres, _mm512_set1_ps(lowest)), _mm512_set1_ps(scale));
        const __m512 largest = _mm512_set1_ps(std::numeric_limits<float>::max());
        finite = _mm512_cmp_ps_mask(_mm512_abs_ps(origin), largest, _CMP_LE_OQ) & _mm512_cmp_ps_mask(_mm512_abs_ps(dir), largest, _CMP_LE_OQ);
        parallel = _mm512_cmp_ps_mask(_mm512_abs_ps(dir), _mm512_set1_ps(kClvParallel), _CMP_NGT_UQ);
        inverse = _mm512_mask_div_ps(one, __mmask16(~parallel), one, dir);
        const __m512 top = _mm512_set1_ps(size);
        const __m512 a = _mm512_mul_ps(_mm512_sub_ps(zero, origin), inverse);
        const __m512 b = _mm512_mul_ps(_mm512_sub_ps(top, origin), inverse);
        slabLo = _mm512_min_ps(b, a);
        slabHi = _mm512_max_ps(b, a);
        const __mmask16 inside = _mm512_cmp_ps_mask(origin, zero, _CMP_GE_OQ) & _mm512_cmp_ps_mask(origin, top, _CMP_LE_OQ);
        const __m512 never = _mm512_set1_ps(kClvNever), negative = _mm512_set1_ps(-kClvNever);
        slabLo = _mm512_mask_blend_ps(parallel, slabLo, _mm512_mask_blend_ps(inside, never, negative));
        slabHi = _mm512_mask_blend_ps(parallel, slabHi, _mm512_mask_blend_ps(inside, negative, never));
    }
    // Follows clvWalkBegin and clvWalkFirstBoundary.
    void enter(__m512 t, int resolution, int scroll, int stride) {
        const __m512 zero = _mm512_setzero_ps(), one = _mm512_set1_ps(1.0f);
        __m512 p = _mm512_floor_ps(_mm512_add_ps(origin, _mm512_mul_ps(direction, t)));
        p = _mm512_min_ps(_mm512_set1_ps(float(resolution - 1)), _mm512_max_ps(p, zero));
        const __mmask16 up = _mm512_cmp_ps_mask(direction, zero, _CMP_GT_OQ);
        boundary = _mm512_mask_blend_ps(parallel, _mm512_mask_add_ps(p, up, p, one), _mm512_set1_ps(kClvNever));
        boundaryStep = _mm512_mask_blend_ps(up, _mm512_set1_ps(-1.0f), one);
        const __m512i count = _mm512_set1_epi32(resolution);
        __m512i c = _mm512_add_epi32(_mm512_cvttps_epi32(p), _mm512_set1_epi32(scroll));
        c = _mm512_mask_sub_epi32(c, _mm512_cmpge_epi32_mask(c, count), c, count);
        cell = _mm512_mullo_epi32(c, _mm512_set1_epi32(stride));
        const int period = resolution * stride;
        cellStep = _mm512_mask_blend_epi32(up, _mm512_set1_epi32(-stride), _mm512_set1_epi32(stride));
        wrapAt = _mm512_mask_blend_epi32(up, _mm512_set1_epi32(-stride), _mm512_set1_epi32(period));
        wrapBy = _mm512_mask_blend_epi32(up, _mm512_set1_epi32(period), _mm512_set1_epi32(-period));
    }
    __m512 next() const { return _mm512_mul_ps(_mm512_sub_ps(boundary, origin), inverse); }
    void step(__mmask16 lanes) {
        boundary = _mm512_mask_add_ps(boundary, lanes, boundary, boundaryStep);
        cell = _mm512_mask_add_epi32(cell, lanes, cell, cellStep);
        cell = _mm512_mask_add_epi32(cell, _mm512_cmpeq_epi32_mask(cell, wrapAt), cell, wrapBy);
    }
};

}  // namespace detail

// The same as walkPacketPortable, to the last bit.
template <class Flush>
void walkPacketAvx512(const Level& level, uint rule, std::span<const ClvRay> rays, CrossingBuffer& buffer, Flush&& flush) {
    using namespace detail;
    const ClvVolume& v = level.volume;
    const float scale = 1.0f / v.cellSize;
    const Lanes3 origin = selectAxes(rays, &ClvRay::origin), direction = selectAxes(rays, &ClvRay::direction);
    AxisWalk x, y, z;
    x.begin(origin.x, direction.x, v.origin.x, scale, float(v.resolution.x));
    y.begin(origin.y, direction.y, v.origin.y, scale, float(v.resolution.y));
    z.begin(origin.z, direction.z, v.origin.z, scale, float(v.resolution.z));
    const __m512 zero = _mm512_setzero_ps();
    // Operands are ordered so that NaN and zeros of either sign give what GLM's min and max give.
    const __m512 tBegin = _mm512_max_ps(_mm512_max_ps(zero, z.slabLo), _mm512_max_ps(y.slabLo, x.slabLo));
    const __m512 maxDistance = selectAxis(rays, &ClvRay::maxDistance);
    const __m512 limit = _mm512_mul_ps(maxDistance, _mm512_set1_ps(scale));
    const __m512 tEnd = _mm512_min_ps(_mm512_min_ps(limit, z.slabHi), _mm512_min_ps(y.slabHi, x.slabHi));
    x.enter(tBegin, v.resolution.x, v.scroll.x, 1);
    y.enter(tBegin, v.resolution.y, v.scroll.y, v.resolution.x);
    z.enter(tBegin, v.resolution.z, v.scroll.z, v.resolution.x * v.resolution.y);
    __mmask16 active = __mmask16((1u << rays.size()) - 1u) & x.finite & y.finite & z.finite &
                       _mm512_cmp_ps_mask(maxDistance, zero, _CMP_GT_OQ) & _mm512_cmp_ps_mask(tEnd, tBegin, _CMP_GT_OQ);
    __mmask16 start = _mm512_cmp_ps_mask(tBegin, zero, _CMP_EQ_OQ);
    if (rule != kClvInjectThesis) start = 0;
    __m512 t = tBegin;
    const __m512 cellSize = _mm512_set1_ps(v.cellSize), one = _mm512_set1_ps(1.0f);
    const __m512 half = _mm512_set1_ps(0.5f);
    const __m512i none = _mm512_set1_epi32(int(kClvNoSlot));
    const __m512i laneIndex = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const int* table = reinterpret_cast<const int*>(level.table.data());
    while (active) {
        const __m512 nx = x.next(), ny = y.next(), nz = z.next();
        const __m512 nearest = _mm512_min_ps(nz, _mm512_min_ps(ny, nx));
        const __m512 tNext = _mm512_max_ps(t, _mm512_min_ps(tEnd, nearest));
        const __m512i cell = _mm512_add_epi32(_mm512_add_epi32(x.cell, y.cell), z.cell);
        const __m512i entry = _mm512_mask_i32gather_epi32(none, active, cell, table, 4);
        const __m512 weight = rule == kClvInjectThesis ? _mm512_mask_blend_ps(start, one, zero)
                                                       : _mm512_mul_ps(_mm512_sub_ps(tNext, t), cellSize);
        start = 0;
        const __mmask16 keep = _mm512_cmpneq_epi32_mask(entry, none) & _mm512_cmp_ps_mask(weight, zero, _CMP_GT_OQ) & active;
        const __m512 middle = _mm512_mul_ps(_mm512_mul_ps(half, _mm512_add_ps(t, tNext)), cellSize);
        // Compressed in registers: compressing into memory is microcode on some processors.
        const int k = buffer.count;
        _mm512_storeu_si512(buffer.entry + k, _mm512_maskz_compress_epi32(keep, entry));
        _mm512_storeu_si512(buffer.lane + k, _mm512_maskz_compress_epi32(keep, laneIndex));
        _mm512_storeu_ps(buffer.weight + k, _mm512_maskz_compress_ps(keep, weight));
        _mm512_storeu_ps(buffer.middle + k, _mm512_maskz_compress_ps(keep, middle));
        buffer.count = k + __builtin_popcount(keep);
        t = tNext;
        active &= _mm512_cmp_ps_mask(nearest, tEnd, _CMP_LT_OQ);
        const __mmask16 stepX = active & _mm512_cmp_ps_mask(nx, nearest, _CMP_EQ_OQ);
        const __mmask16 stepY = active & ~stepX & _mm512_cmp_ps_mask(ny, nearest, _CMP_EQ_OQ);
        x.step(stepX);
        y.step(stepY);
        z.step(active & ~stepX & ~stepY);
        if (buffer.count >= CrossingBuffer::kCapacity - kPacketLanes) flush(buffer);
    }
}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif

template <class Flush>
void walkPacket(const Level& level, uint rule, std::span<const ClvRay> rays, CrossingBuffer& buffer, Flush&& flush) {
#if defined(__AVX512F__)
    walkPacketAvx512(level, rule, rays, buffer, flush);
#else
    walkPacketPortable(level, rule, rays, buffer, flush);
#endif
}

}  // namespace clv
#endif
