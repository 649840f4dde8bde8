#include "bindings/cli/lit_level.h"

#include <deque>

#include "clv/cpu/volume.h"

namespace clv {

void addIrradiance(std::span<const LitLevel> levels, LookupTable Lookups::*which, const DepositLayout& layout, std::span<const ClvReceiver> receivers,
                   const ParallelFor& parallelFor, std::span<glm::vec3> sum) {
    struct Part {
        const LookupTable& table;
        std::span<const float> history;
        float weight;
    };
    std::vector<Part> parts;
    std::deque<AlignedFloats> means;
    for (const LitLevel& level : levels) {
        if (level.weight == 0.0) continue;
        const auto halves = level.light->histories();
        std::span<const float> history = halves[0];
        if (halves.size() == 2) {
            averageHalves(halves[0], halves[1], parallelFor, means.emplace_back());
            history = means.back();
        }
        parts.push_back({level.lookups.get()->*which, history, float(level.weight)});
    }
    forReceivers(receivers.size(), parallelFor, [&](std::size_t i) {
        const ClvCoefficients read = layout.read(receivers[i].normal);
        for (const Part& part : parts) sum[i] += part.table.irradiance(i, layout, part.history, read) * part.weight;
    });
}

void addHalves(const LitLevel& level, LookupTable Lookups::*which, const DepositLayout& layout, std::span<const ClvReceiver> receivers, float scale,
               const ParallelFor& parallelFor, HalfEstimates& sums) {
    if (scale == 0.0f) return;
    const auto histories = level.light->histories();
    const std::size_t count = sums.half[0].size();
    forReceivers(count, parallelFor, [&](std::size_t i) {
        const std::size_t receiver = i * receivers.size() / count;
        const ClvCoefficients read = layout.read(receivers[receiver].normal);
        for (std::size_t half = 0; half < 2; ++half)
            sums.half[half][i] += (level.lookups.get()->*which).irradiance(receiver, layout, histories[half], read) * scale;
    });
}

}  // namespace clv
