// The slot weights of receivers that stand still, found once and then read every frame.
#ifndef CLV_CPU_LOOKUP_TABLE_H
#define CLV_CPU_LOOKUP_TABLE_H
#include <span>
#include <vector>

#include "evaluate.h"
#include "parallel.h"

namespace clv {

class LookupTable {
public:
    LookupTable() = default;
    // The level's slots must not change afterwards.
    LookupTable(const Level& level, std::span<const ClvReceiver> receivers, const LookupOptions& options, const ParallelFor& parallelFor) {
        const std::size_t pieces = (receivers.size() + kPiece - 1) / kPiece;
        std::vector<LookupTable> parts(pieces);
        parallelFor(pieces, [&](std::size_t piece) {
            SlotWeights found;
            LookupTable& part = parts[piece];
            for (std::size_t i = piece * kPiece; i < std::min(receivers.size(), (piece + 1) * kPiece); ++i) {
                lookupWeights(level, receivers[i], options, found);
                part.slot_.insert(part.slot_.end(), found.slot.begin(), found.slot.begin() + found.count);
                part.weight_.insert(part.weight_.end(), found.weight.begin(), found.weight.begin() + found.count);
                part.end_.push_back(part.slot_.size());
            }
        });
        end_.reserve(receivers.size());
        for (const LookupTable& part : parts) {
            const std::size_t before = slot_.size();
            for (std::size_t end : part.end_) end_.push_back(before + end);
            slot_.insert(slot_.end(), part.slot_.begin(), part.slot_.end());
            weight_.insert(weight_.end(), part.weight_.begin(), part.weight_.end());
        }
    }

    std::size_t size() const { return end_.size(); }
    // Receiver i reads slots()[k] with weights()[k], k from where the receiver before it ends to ends()[i].
    std::span<const std::size_t> ends() const { return end_; }
    std::span<const uint> slots() const { return slot_; }
    std::span<const float> weights() const { return weight_; }
    std::size_t bytes() const { return end_.size() * sizeof(std::size_t) + slot_.size() * (sizeof(uint) + sizeof(float)); }

    // Irradiance at receiver i, W/m^2, see readIrradiance.
    vec3 irradiance(std::size_t i, const DepositLayout& layout, std::span<const float> deposits, const ClvCoefficients& read) const {
        const std::size_t begin = i == 0 ? 0 : end_[i - 1], count = end_[i] - begin;
        return readIrradiance(layout, deposits, {slot_.data() + begin, count}, {weight_.data() + begin, count}, read);
    }

    static constexpr std::size_t kPiece = 256;  // receivers that are worth a task of their own

private:
    std::vector<std::size_t> end_;
    std::vector<uint> slot_;
    std::vector<float> weight_;
};

}  // namespace clv
#endif
