// Levels with light, and how receivers read a mix of them.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "bindings/cli/lighting.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/parallel.h"
#include "clv/cpu/resolution.h"

namespace clv {

// Receivers stand still: their weights are found once a level.
struct Lookups {
    LookupTable points, judges;
};

struct LitLevel {
    int resolution = 0;
    std::unique_ptr<LightLevel> light;
    std::shared_ptr<const Lookups> lookups;
    double weight = 1.0;  // in the mix
};

// Calls body(i) for each receiver, many at the same time.
template <class Body>
void forReceivers(std::size_t count, const ParallelFor& parallelFor, Body&& body) {
    constexpr std::size_t kPiece = LookupTable::kPiece;
    parallelFor((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
        for (std::size_t i = piece * kPiece; i < std::min(count, (piece + 1) * kPiece); ++i) body(i);
    });
}

// The mix of the levels: E at the receivers of that table, W/m^2, is added to `sum`.
void addIrradiance(std::span<const LitLevel> levels, LookupTable Lookups::*which, const DepositLayout& layout, std::span<const ClvReceiver> receivers,
                   const ParallelFor& parallelFor, std::span<glm::vec3> sum);

// What each half of the rays says in one level, times `scale`, is added to both sums: at as many of the receivers, evenly chosen, as these have.
void addHalves(const LitLevel& level, LookupTable Lookups::*which, const DepositLayout& layout, std::span<const ClvReceiver> receivers, float scale,
               const ParallelFor& parallelFor, HalfEstimates& sums);

}  // namespace clv
