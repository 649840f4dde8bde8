#include "viz/cell_truth.h"

#include <algorithm>
#include <cmath>

#include "bindings/cli/progress.h"
#include "bindings/embree/path_tracer.h"
#include "clv/math/hash.h"
#include "clv/math/sobol.h"

namespace clv {
namespace {

constexpr std::uint64_t kPlaces = 16;  // in a cell, from which the paths of a side start
constexpr std::uint32_t kTries = 256;  // to find them

// Whether the first surface along a way shows its back; none where there is no surface.
std::optional<bool> firstShowsBack(const EmbreeScene& scene, const vec3& position, const vec3& direction, std::vector<LineHit>& hits) {
    scene.lineHits(position, direction, kClvFar, hits);
    return hits.empty() ? std::nullopt : std::optional(!hits.front().front);
}

std::uint32_t seedOf(const ShownCell& cell) {
    std::uint32_t seed = cell.cascade;
    for (int axis = 0; axis < 3; ++axis) seed = clvHashCombine(seed, uint(cell.cell[axis]));
    return seed;
}

std::vector<vec3> openPlaces(const EmbreeScene& scene, const ShownCell& cell, std::uint64_t count) {
    const std::uint32_t seed = seedOf(cell);
    std::vector<vec3> places;
    for (std::uint32_t k = 0; k < kTries && places.size() < count; ++k) {
        const vec3 share(clvSobolUnit(k, 0u, seed), clvSobolUnit(k, 1u, seed), clvSobolUnit(k, 2u, seed));
        const vec3 place = cell.center + cell.edge * (share - 0.5f);
        if (isOpen(scene, place)) places.push_back(place);
    }
    return places;
}

// From the results of all sides, place by place.
SideTruth meanOf(std::span<const ReferenceResult> results) {
    SideTruth truth;
    const float places = float(results.size() / kSides);
    std::array<float, kSides> squares{};
    for (std::size_t i = 0; i < results.size(); ++i) {
        const ReferenceResult& result = results[i];
        truth.irradiance[i % kSides] += result.irradiance / places;
        if (std::isfinite(result.standardError.x)) squares[i % kSides] += dot(result.standardError, result.standardError);
    }
    for (std::size_t side = 0; side < kSides; ++side) truth.standardError[side] = std::sqrt(squares[side]) / places;
    return truth;
}

}  // namespace

bool isOpen(const EmbreeScene& scene, const vec3& position) {
    int bounded = 0, enclosed = 0;
    std::vector<LineHit> hits;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 direction(0.0f);
        direction[axis] = 1.0f;
        const auto above = firstShowsBack(scene, position, direction, hits), below = firstShowsBack(scene, position, -direction, hits);
        bounded += above || below;
        enclosed += above.value_or(false) && below.value_or(false);
    }
    return enclosed == 0 || enclosed < bounded;
}

std::vector<std::optional<SideTruth>> CellTruth::of(std::span<const ShownCell> cells, const EmbreeScene& scene, const TruthOptions& options, const ParallelFor& parallelFor) {
    if (!(options == options_)) clear();
    options_ = options;
    const auto keyOf = [](const ShownCell& cell) { return Key{cell.center.x, cell.center.y, cell.center.z, cell.edge}; };
    std::vector<const ShownCell*> unknown;
    for (const ShownCell& cell : cells) {
        if (!known_.contains(keyOf(cell))) unknown.push_back(&cell);
    }
    const std::uint64_t placesWanted = std::min(kPlaces, options.samples);
    std::vector<std::optional<SideTruth>> found(unknown.size());
    Progress progress("path tracing cells");
    const ParallelFor watched = Progress::watch(parallelFor, [&progress](double share) { progress.update(share); });
    watched(unknown.size(), [&](std::size_t i) {
        std::vector<ReferencePoint> points;
        for (const vec3& place : openPlaces(scene, *unknown[i], placesWanted)) {
            for (std::size_t side = 0; side < kSides; ++side) points.push_back({place, sideNormal(side)});
        }
        if (points.empty()) return;
        std::vector<ReferenceResult> results(points.size());
        const std::uint64_t places = points.size() / kSides;
        // No more threads: each cell is the work of one.
        referenceIrradiance(scene, points, {.allBounces = options.allBounces, .samplesPerPoint = (options.samples + places - 1) / places, .seed = seedOf(*unknown[i])}, serialFor(), results);
        found[i] = meanOf(results);
    });
    for (std::size_t i = 0; i < unknown.size(); ++i) known_.emplace(keyOf(*unknown[i]), found[i]);
    std::vector<std::optional<SideTruth>> all;
    for (const ShownCell& cell : cells) all.push_back(known_.at(keyOf(cell)));
    return all;
}

}  // namespace clv
