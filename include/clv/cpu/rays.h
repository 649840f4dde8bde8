// Rays on the CPU: the rays of a frame, drawn from the RSMs by one four-dimensional sequence that continues across frames.
#ifndef CLV_CPU_RAYS_H
#define CLV_CPU_RAYS_H
#include <utility>

#include "../math/sobol.h"
#include "../stages/rays.h"
#include "texel_sampler.h"

namespace clv {

namespace detail {

// Many at a time of clvCosineFromSquare, on arrays, so that the compiler makes vectors of it.
inline void cosineDirections(int count, const float* __restrict u, const float* __restrict v, const float (*__restrict normal)[TexelSampler::kBlock],
                             float* __restrict x, float* __restrict y, float* __restrict z) {
    for (int k = 0; k < count; ++k) {
        const vec3 d = clvCosineFromSquare(vec2(u[k], v[k]), vec3(normal[0][k], normal[1][k], normal[2][k]));
        x[k] = d.x, y[k] = d.y, z[k] = d.z;
    }
}

// Many at a time of clvGuideDirection, on arrays, to the last bit: resamples each direction, which was made from (u, v). `probability`
// takes up the choice.
inline void chooseDirections(const RayGuide& guide, int count, uint firstIndex, uint seed, const ClvRsmTexel* texel, const float* u, const float* v,
                             float (*direction)[TexelSampler::kBlock], float* probability) {
    constexpr int kBlock = TexelSampler::kBlock, kCandidates = int(kClvGuideCandidates);
    float x[kCandidates][kBlock], y[kCandidates][kBlock], z[kCandidates][kBlock], normal[3][kBlock];
    for (int k = 0; k < count; ++k) {
        for (int axis = 0; axis < 3; ++axis) normal[axis][k] = texel[k].normal[axis];
        x[0][k] = direction[0][k], y[0][k] = direction[1][k], z[0][k] = direction[2][k];
    }
    for (int c = 1; c < kCandidates; ++c) {
        float shiftedU[kBlock], shiftedV[kBlock];
        for (int k = 0; k < count; ++k) {
            const vec2 shifted = clvGuideCandidate(vec2(u[k], v[k]), uint(c));
            shiftedU[k] = shifted.x, shiftedV[k] = shifted.y;
        }
        cosineDirections(count, shiftedU, shiftedV, normal, x[c], y[c], z[c]);
    }
    uint row[kBlock];
    for (int k = 0; k < count; ++k) row[k] = guide.rowAt(texel[k].position);
    float weight[kCandidates][kBlock], sum[kBlock] = {}, left[kBlock];
    for (int c = 0; c < kCandidates; ++c) {
        guide.directionWeights(count, row, x[c], y[c], z[c], weight[c]);
        for (int k = 0; k < count; ++k) sum[k] += weight[c][k];
    }
    for (int k = 0; k < count; ++k) left[k] = clvGuideChoice(firstIndex + uint(k), seed) * sum[k];
    // The first candidate at which the running sum passes what was drawn; the first of all where rounding lets none.
    float chosen[kBlock] = {};
    for (int c = kCandidates - 1; c >= 0; --c) {
        float before[kBlock] = {};
        for (int b = 0; b < c; ++b)
            for (int k = 0; k < count; ++k) before[k] += weight[b][k];
        for (int k = 0; k < count; ++k) {
            const bool takes = (left[k] >= before[k] && left[k] < before[k] + weight[c][k]) || (c == 0 && chosen[k] == 0.0f);
            direction[0][k] = takes ? x[c][k] : direction[0][k];
            direction[1][k] = takes ? y[c][k] : direction[1][k];
            direction[2][k] = takes ? z[c][k] : direction[2][k];
            chosen[k] = takes ? weight[c][k] : chosen[k];
        }
    }
    for (int k = 0; k < count; ++k) probability[k] *= chosen[k] * float(kCandidates) / sum[k];
}

}  // namespace detail

// Ray k of `out` is number firstIndex + k of the sequence; two dimensions pick the texel, two the direction. Each ray carries the
// flux of the whole light, as if it were the only one: the mean over rays is the estimate. `originOffset`, m, see clvRayAlong.
inline void makeRays(const TexelSampler& sampler, uint firstIndex, uint seed, float originOffset, std::span<ClvRay> out) {
    if (sampler.empty()) {
        std::fill(out.begin(), out.end(), clvDeadRay());
        return;
    }
    // In blocks and stage by stage, on arrays: the compiler then makes vectors of it, and memory is fetched for many rays at once.
    constexpr int kBlock = TexelSampler::kBlock;
    float u[kClvSobolDimensions][kBlock], probability[kBlock], normal[3][kBlock], direction[3][kBlock];
    ClvRsmTexel texel[kBlock];
    for (std::size_t first = 0; first < out.size(); first += kBlock) {
        const int count = int(std::min<std::size_t>(kBlock, out.size() - first));
        const uint index = firstIndex + uint(first);
        auto draw = [&](auto dimension) {
            for (int k = 0; k < count; ++k) u[dimension][k] = clvSobolUnit(index + uint(k), dimension, seed);
        };
        [&]<uint... dimension>(std::integer_sequence<uint, dimension...>) {
            (draw(std::integral_constant<uint, dimension>()), ...);
        }(std::make_integer_sequence<uint, kClvSobolDimensions>());
        sampler.sample(count, u[0], u[1], texel, probability);
        for (int k = 0; k < count; ++k) {
            for (int axis = 0; axis < 3; ++axis) normal[axis][k] = texel[k].normal[axis];
        }
        detail::cosineDirections(count, u[2], u[3], normal, direction[0], direction[1], direction[2]);
        if (sampler.guide()) detail::chooseDirections(*sampler.guide(), count, index, seed, texel, u[2], u[3], direction, probability);
        for (int k = 0; k < count; ++k) {
            const vec3 d(direction[0][k], direction[1][k], direction[2][k]);
            out[first + k] = probability[k] > 0.0f ? clvRayAlong(texel[k], d, 1.0f / probability[k], originOffset) : clvDeadRay();
        }
    }
}

}  // namespace clv
#endif
