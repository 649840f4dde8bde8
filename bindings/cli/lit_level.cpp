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

}  // namespace clv
