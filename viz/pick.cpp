#include "viz/pick.h"

#include <algorithm>
#include <cmath>

#include "viz/cell_values.h"

namespace clv {
namespace {

// Distance along the line to a box around `center`, m; infinite where it misses.
float distanceToCube(const Sight& sight, const vec3& center, float edge) {
    float enter = 0.0f, leave = kClvFar;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = (center[axis] - 0.5f * edge - sight.origin[axis]) / sight.direction[axis];
        const float b = (center[axis] + 0.5f * edge - sight.origin[axis]) / sight.direction[axis];
        // Written so that a line in the plane of a side, whose distance is not a number, keeps what the other axes say.
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave ? enter : HUGE_VALF;
}

// The nearest of what was found so far.
struct Nearest {
    float distance = HUGE_VALF;
    Pick pick{};

    void offer(float at, const Pick& candidate) {
        if (at < distance) distance = at, pick = candidate;
    }
    std::optional<Pick> found() const { return distance < HUGE_VALF ? std::optional(pick) : std::nullopt; }
};

void offerCells(const BakedVolume& volume, const View& view, const Sight& sight, const ParallelFor& parallelFor, Nearest& nearest) {
    const std::vector<ShownCell> cells = cellsOf(volume, view, parallelFor);
    const auto distanceTo = [&](const ShownCell& cell) { return distanceToCube(sight, cell.center, kCubeShare * cell.edge); };
    const auto first = std::ranges::min_element(cells, {}, distanceTo);
    if (first != cells.end()) nearest.offer(distanceTo(*first), {first->center, {}, {}, first->cascade});
}

void offerSlices(const BakedVolume& volume, const View& view, const Sight& sight, Nearest& nearest) {
    for (std::size_t k = 0; k < view.slices.size(); ++k) {
        const int axis = view.slices[k].axis;
        const float distance = (float(view.slices[k].place - volume.anchor[axis]) - sight.origin[axis]) / sight.direction[axis];
        if (!(distance > 0.0f)) continue;
        const vec3 position = sight.origin + distance * sight.direction;
        if (const auto cell = cellAt(volume, position, view.cascade)) nearest.offer(distance, {position, {}, k, cell->cascade});
    }
}

void offerSurface(const World& world, bool backs, const Sight& sight, Nearest& nearest) {
    std::vector<LineHit> hits;
    world.embree().lineHits(sight.origin, sight.direction, kClvFar, hits);
    for (const LineHit& hit : hits) {
        if (!hit.front && !backs) continue;
        nearest.offer(hit.distance, {sight.origin + hit.distance * sight.direction, hit.front ? hit.normal : -hit.normal, {}, {}});
        return;
    }
}

}  // namespace

Pick typedPick(const std::vector<double>& n, const BakedVolume& volume, ShownCascade shown) {
    const vec3 position(glm::dvec3(n[0], n[1], n[2]) - volume.anchor);
    if (n.size() == 6) return {.position = position, .normal = normalize(vec3(n[3], n[4], n[5]))};
    return {.position = position, .normal = {}, .cascade = shown};
}

std::optional<Pick> pickAlong(const BakedVolume& volume, const World* world, const View& view, const Sight& sight, const ParallelFor& parallelFor) {
    Nearest nearest;
    const Carrier carrier = carrierOf(view);
    const bool error = view.subject == Subject::error, quantity = error || quantityOf(view.subject);
    const bool surfaces = view.mesh || view.subject == Subject::mesh || (error && carrier == Carrier::surfaces);
    if (quantity && carrier == Carrier::slices) offerSlices(volume, view, sight, nearest);
    if (showsCubes(view)) offerCells(volume, view, sight, parallelFor, nearest);
    if (world && surfaces) offerSurface(*world, view.backs, sight, nearest);
    return nearest.found();
}

vec3 placeInCell(const BakedVolume& volume, const Pick& pick) {
    const float ahead = kClvSideOffset * volume.cascades.front().level.volume.cellSize;
    return pick.position + ahead * pick.normal.value_or(vec3(0.0f));
}

std::optional<ShownCell> pickedCell(const BakedVolume& volume, const Pick& pick) { return cellAt(volume, placeInCell(volume, pick), pick.cascade); }

float draggedPlace(const vec3& grabbed, int axis, const Sight& sight) {
    vec3 along(0.0f);
    along[axis] = 1.0f;
    // Closest points of two lines: grabbed + s along, origin + t direction.
    const vec3 between = sight.origin - grabbed;
    const float cosine = dot(along, sight.direction), denominator = 1.0f - cosine * cosine;
    if (denominator < 1e-6f) return grabbed[axis];
    return grabbed[axis] + (dot(between, along) - cosine * dot(between, sight.direction)) / denominator;
}

vec3 draggedPosition(const vec3& grabbed, const vec3& screenNormal, const Sight& sight) {
    const float distance = dot(grabbed - sight.origin, screenNormal) / dot(sight.direction, screenNormal);
    return sight.origin + distance * sight.direction;
}

}  // namespace clv
