// What the machine can do at best, for stages to be held against: copies of as many bytes, the same additions to the same addresses,
// the same rays in bare Embree.
#pragma once
#include <cstring>
#include <span>
#include <vector>

#include "benchmarks/native_tracer.h"
#include "clv/cpu/aligned.h"
#include "clv/cpu/inject.h"

namespace clv {

// Reads and writes `bytes` in all, half of them each.
class Copy {
public:
    explicit Copy(double bytes) : from_(std::size_t(0.5 * bytes)), to_(from_.size()) {}
    void operator()() { std::memcpy(to_.data(), from_.data(), from_.size()); }

private:
    std::vector<char> from_, to_;
};

// One ray at a time.
inline float traceBare(const NativeTracer& bare, std::span<const ClvRay> rays) {
    float sum = 0.0f;
    for (const ClvRay& ray : rays) sum += bare.trace(ray);
    return sum;
}

// The crossings of rays with the slots of a level, as a walk finds them, and what inject does to them without the walk.
class ScatterAdd {
public:
    ScatterAdd(const Level& level, const DepositLayout& layout, std::span<const ClvRay> rays)
        : stride_(layout.stride()), values_(rays.size() * layout.stride(), 1e-6f) {
        CrossingBuffer buffer;
        for (std::size_t first = 0; first < rays.size(); first += kPacketLanes) {
            auto flush = [&](CrossingBuffer& full) {
                for (int k = 0; k < full.count; ++k) {
                    slot_.push_back(full.entry[k]);
                    ray_.push_back(std::uint32_t(first) + full.lane[k]);
                    weight_.push_back(full.weight[k]);
                }
                full.count = 0;
            };
            walkPacket(level, kClvInjectTrackLength, rays.subspan(first, std::min<std::size_t>(kPacketLanes, rays.size() - first)), buffer, flush);
            flush(buffer);
        }
    }
    std::size_t crossings() const { return slot_.size(); }

    void operator()(AlignedFloats& deposits) const {
        switch (stride_) {
            case 16: return addStrided<16>(deposits);
            case 24: return addStrided<24>(deposits);
            default: return addStrided<32>(deposits);
        }
    }

private:
    template <int Stride>
    void addStrided(AlignedFloats& deposits) const {
        for (std::size_t k = 0; k < slot_.size(); ++k) {
            float* __restrict record = deposits.data() + std::size_t(slot_[k]) * Stride;
            const float* __restrict add = values_.data() + std::size_t(ray_[k]) * Stride;
            const float weight = weight_[k];
#pragma GCC unroll 1
            for (int j = 0; j < Stride; ++j) record[j] += add[j] * weight;
        }
    }

    int stride_;
    std::vector<std::uint32_t> slot_, ray_;
    std::vector<float> weight_;
    AlignedFloats values_;
};

}  // namespace clv
