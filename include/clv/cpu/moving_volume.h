// A moving level with its light: history stays with the cells that are kept, and new ones start from a first guess.
#ifndef CLV_CPU_MOVING_VOLUME_H
#define CLV_CPU_MOVING_VOLUME_H
#include "../stages/merge.h"
#include "evaluate.h"
#include "moving_level.h"
#include "partial_volume.h"

namespace clv {

struct MovingVolumeSettings {
    MovingLevelSettings level{};
    DepositLayout layout{};
    int chunks = 1;                   // >= 1: partial volumes that are filled at the same time
    bool movingLights = false;        // false: no dynamicity is stored, and history gives way by its age alone
    float guessFrames = 8.0f;         // >= 0: frames that a new cell's guess from the next coarser cascade counts for at most
    float slidOutFrames = 1.0f;       // >= 0: the same for a guess from what slid out, whose light was a volume's length away
    float newCellDynamicity = 0.5f;   // [0, 1]: of the sides of new cells that hold a guess, where lights move
};

class MovingVolume {
public:
    explicit MovingVolume(const MovingVolumeSettings& settings)
        : settings_(settings), level_(settings.level), partials_(std::size_t(settings.chunks)), fromCoarser_(guessStride(settings)) {
        const std::size_t slots = MovingLevel::slotsOf(settings.level);
        for (PartialVolume& partial : partials_) partial.reserve(slots, settings.layout, settings.movingLights);
        history_.reserve(slots, settings.layout, settings.movingLights);
        frames_.reserve(slots);
        leaving_.reserve(level_.level().cellCount() * guessStride());
    }

    // Bytes of a volume before it is made; see MovingLevel::bytes.
    static std::size_t bytes(const MovingVolumeSettings& settings) {
        const std::size_t slots = MovingLevel::slotsOf(settings.level), cells = MovingLevel::cellsOf(settings.level);
        return MovingLevel::bytes(settings.level) + slots * sizeof(float) + (cells + 1) * guessStride(settings) * sizeof(float) +
               PartialVolume::bytes(slots, settings.layout, settings.movingLights) * std::size_t(settings.chunks + 1);
    }
    std::size_t bytes() const {
        std::size_t sum = level_.bytes() + history_.bytes() + (frames_.capacity() + leaving_.capacity() + fromCoarser_.capacity()) * sizeof(float);
        for (const PartialVolume& partial : partials_) sum += partial.bytes();
        return sum;
    }

    const Level& level() const { return level_.level(); }
    // Mean deposits, settings.layout.stride() floats a slot: W m for one frame's whole flux.
    std::span<const float> history() const { return history_.deposits; }
    // Frames, weighed alike, that a slot's history stands for.
    std::span<const float> frames() const { return frames_; }
    // kSides numbers a slot, [0, 1]; empty where no light moves.
    std::span<const float> dynamicity() const { return history_.dynamicity; }
    DepositTarget partial(int chunk) { return partials_[std::size_t(chunk)].target(); }

    // Goes to its new place between two frames. New cells take their first guess from `coarser`, which has moved before, or else,
    // as in Brattén and Lindén (2013), from the history that slid out of the same place in memory. `coarser`: may be null.
    // Where memory runs out on the way, the volume covers nothing afterwards, as at first.
    void moveTo(const PlacedCascade& placed, const MovingVolume* coarser, const SceneProbe& probe, const ParallelFor& parallelFor) {
        struct Unfinished {
            MovingVolume* volume;
            ~Unfinished() {
                if (volume) volume->forget();
            }
        } unfinished{this};
        level_.moveTo(placed);
        keepLeaving();
        level_.fill(probe, parallelFor);
        const std::size_t slots = level().slots.size();
        for (PartialVolume& partial : partials_) partial.resize(slots, settings_.layout, settings_.movingLights);
        history_.resize(slots, settings_.layout, settings_.movingLights);
        frames_.resize(slots);
        seedExposed(coarser);
        unfinished.volume = nullptr;
    }

    // Takes this frame's deposits into the history; `scale` turns their raw sums into an estimate.
    void merge(float scale, const ClvMergeSettings& merge, const ParallelFor& parallelFor) {
        const std::size_t stride = settings_.layout.stride(), slots = level().slots.size(), kPiece = 2048;
        auto mergePiece = [&](std::size_t piece) {
            for (std::size_t slot = piece * kPiece; slot < std::min(slots, (piece + 1) * kPiece); ++slot) {
                const float weight = clvMergeWeight(merge, settings_.movingLights ? mergeDynamicity(merge, partials_, slot, &history_.dynamicity[slot * kSides]) : 0.0f, frames_[slot] + 1.0f);
                frames_[slot] = clvFramesFromWeight(weight);
                mergeDeposits(partials_, slot, stride, scale, weight, history_.deposits.data() + slot * stride);
            }
        };
        parallelFor((slots + kPiece - 1) / kPiece, std::ref(mergePiece));
    }

    // Irradiance at a receiver inside the volume, W/m^2. May be called from several threads.
    vec3 irradiance(const ClvReceiver& receiver, const LookupOptions& lookup) const {
        SlotWeights weights;
        lookupWeights(level(), receiver, lookup, weights);
        return readIrradiance(settings_.layout, history_.deposits, weights, settings_.layout.read(receiver.normal));
    }

    // Forgets what was injected since the last merge.
    void dropFrame() {
        for (PartialVolume& partial : partials_) partial.clear();
    }
    // Forgets all light, and stays where it is.
    void reset() {
        dropFrame();
        history_.clear();
        std::fill(frames_.begin(), frames_.end(), 0.0f);
    }

private:
    void forget() {
        level_.forget();
        for (PartialVolume& partial : partials_) partial.resize(0, settings_.layout, settings_.movingLights);
        history_.resize(0, settings_.layout, settings_.movingLights);
        frames_.clear();
    }

    // A first guess: how many frames it stands for, then mean coefficients, W/m^2, in the order of a record.
    static std::size_t guessStride(const MovingVolumeSettings& settings) { return 1 + std::size_t(settings.layout.stride()); }
    std::size_t guessStride() const { return guessStride(settings_); }

    // Adds a slot's history to a guess with weight w; returns the open volume that this stands for. A slot without history adds nothing.
    float addToGuess(uint slot, float w, std::span<float> guess) const {
        if (!(frames_[slot] > 0.0f)) return 0.0f;
        const std::size_t stride = settings_.layout.stride();
        guess[0] = std::max(guess[0], frames_[slot]);
        for (std::size_t j = 0; j < stride; ++j) guess[1 + j] += w * history_.deposits[slot * stride + j];
        return w * level().slots[slot].openVolume;
    }
    static void finishGuess(std::span<float> guess, float openVolume) {
        for (float& mean : guess.subspan(1)) mean *= openVolume > 0.0f ? 1.0f / openVolume : 0.0f;
    }

    // What the exposed cells still hold: the means of the cells whose place in memory they take.
    void keepLeaving() {
        leaving_.clear();
        level_.forExposedCells([&](const ivec3& cell) {
            leaving_.resize(leaving_.size() + guessStride(), 0.0f);
            const uint entry = level().table[clvCellIndex(level().volume, cell)];
            if (entry == kClvNoSlot) return;
            const std::span<float> guess = std::span(leaving_).last(guessStride());
            const CellSlots slots = slotsOfCell(level(), entry);
            float openVolume = 0.0f;
            for (uint s = 0; s < slots.count; ++s) openVolume += addToGuess(slots.first + s, 1.0f, guess);
            finishGuess(guess, openVolume);
        });
    }

    // The guess at a position, m: interpolated between the slot that holds it and those that this one sees.
    void guessAt(const vec3& position, std::span<float> guess) const {
        std::fill(guess.begin(), guess.end(), 0.0f);
        const ClvVolume& v = level().volume;
        const ivec3 home = clvCellFromPosition(v, position);
        const uint homeSlot = detail::slotAt(level(), home, position);
        if (homeSlot == kClvNoSlot) return;
        const vec3 fromCenter = (position - clvCellCenter(v, home)) / v.cellSize;
        float openVolume = 0.0f;
        for (int k = 0; k < 27; ++k) {
            const ivec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            const float weight = clvLookupWeight(kClvLookupTrilinear, vec3(step) - fromCenter);
            if (!(weight > 0.0f) || !clvCellInside(v, home + step)) continue;
            const uint entry = level().table[clvCellIndex(v, home + step)];
            if (entry == kClvNoSlot) continue;
            const CellSlots slots = slotsOfCell(level(), entry);
            for (uint s = 0; s < slots.count; ++s) {
                if (detail::sees(level().slots[homeSlot], step, s)) openVolume += addToGuess(slots.first + s, weight, guess);
            }
        }
        finishGuess(guess, openVolume);
    }

    void seedExposed(const MovingVolume* coarser) {
        std::span<const float> leaving = leaving_;
        level_.forExposedCells([&](const ivec3& cell) {
            const std::span<const float> left = leaving.first(guessStride());
            leaving = leaving.subspan(guessStride());
            const uint entry = level().table[clvCellIndex(level().volume, cell)];
            if (entry == kClvNoSlot) return;
            const CellSlots slots = slotsOfCell(level(), entry);
            for (uint slot = slots.first; slot < slots.first + slots.count; ++slot) {
                if (coarser) coarser->guessAt(level_.inside(slot), fromCoarser_);
                if (fromCoarser_[0] > 0.0f) seed(slot, fromCoarser_, settings_.guessFrames);
                else seed(slot, left, settings_.slidOutFrames);
            }
        });
    }

    void seed(uint slot, std::span<const float> guess, float mostFrames) {
        const std::size_t stride = settings_.layout.stride();
        frames_[slot] = std::min(guess[0], mostFrames);
        const float openVolume = level().slots[slot].openVolume;
        for (std::size_t j = 0; j < stride; ++j) history_.deposits[slot * stride + j] = guess[1 + j] * openVolume;
        if (!settings_.movingLights) return;
        const float dynamicity = frames_[slot] > 0.0f ? settings_.newCellDynamicity : 0.0f;
        std::fill_n(history_.dynamicity.begin() + std::ptrdiff_t(slot * kSides), kSides, dynamicity);
    }

    MovingVolumeSettings settings_;
    MovingLevel level_;
    std::vector<PartialVolume> partials_;
    PartialVolume history_;
    std::vector<float> frames_;       // a slot each
    std::vector<float> leaving_;      // guesses of the exposed cells, in their order
    std::vector<float> fromCoarser_;  // one guess; stays 0 where there is no coarser cascade
};

}  // namespace clv
#endif
