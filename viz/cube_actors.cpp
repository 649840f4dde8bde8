#include "viz/cube_actors.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "viz/flat_actors.h"

namespace clv {
namespace {

float facePlane(const LitCube& cube, int direction) {
    const float sign = direction % 2 == 0 ? 1.0f : -1.0f;
    return cube.center[direction / 2] + sign * 0.5f * cube.edge;
}

// The faces of the cubes that look in one direction.
FlatQuads facesOf(std::span<const LitCube> cubes, int direction) {
    static constexpr float kCorner[4][2] = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
    const int axis = direction / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool positive = direction % 2 == 0;
    FlatQuads quads;
    quads.points.reserve(4 * cubes.size()), quads.colors.reserve(cubes.size());
    for (const LitCube& cube : cubes) {
        for (int k = 0; k < 4; ++k) {
            glm::vec3 p = cube.center;
            p[axis] = facePlane(cube, direction);
            // Counter-clockwise from outside.
            const float* corner = kCorner[positive ? k : 3 - k];
            p[u] += corner[0] * cube.edge, p[v] += corner[1] * cube.edge;
            quads.points.push_back(p);
        }
        quads.colors.push_back(cube.side[std::size_t(direction)]);
    }
    return quads;
}

}  // namespace

std::vector<LitCube> mergedCubes(std::span<const LitCube> cubes) {
    // Cubes of a block become neighbours. Sorting is faster than a map of a million blocks.
    using Key = std::tuple<float, int, int, int>;
    std::vector<std::pair<Key, std::uint32_t>> order;
    order.reserve(cubes.size());
    for (const LitCube& cube : cubes) {
        const glm::ivec3 block = glm::floor(cube.center / (2.0f * cube.cell));
        order.push_back({{cube.cell, block.z, block.y, block.x}, std::uint32_t(order.size())});
    }
    std::ranges::sort(order);
    std::vector<LitCube> merged;
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
        glm::vec3 center(0.0f);
        std::array<glm::vec3, 6> side{};
        float edge = 0.0f;
        for (; end < order.size() && order[end].first == order[first].first; ++end) {
            const LitCube& cube = cubes[order[end].second];
            center += cube.center, edge += cube.edge;
            for (std::size_t k = 0; k < 6; ++k) side[k] += glm::vec3(cube.side[k]);
        }
        const float count = float(end - first);
        LitCube& block = merged.emplace_back(LitCube{center / count, 2.0f * edge / count, 2.0f * std::get<0>(order[first].first), {}});
        for (std::size_t k = 0; k < 6; ++k) block.side[k] = glm::u8vec3(side[k] / count + 0.5f);
    }
    return merged;
}

void CubeActors::add(std::span<const LitCube> cubes, bool merged, vtkRenderer& renderer) {
    if (cubes.empty()) return;
    glm::vec3 lo = cubes[0].center, hi = lo;
    for (const LitCube& cube : cubes) lo = glm::min(lo, cube.center), hi = glm::max(hi, cube.center);
    const glm::vec3 middle = 0.5f * (lo + hi);
    std::array<std::vector<LitCube>, 8> octants;
    for (const LitCube& cube : cubes) {
        const auto above = glm::greaterThan(cube.center, middle);
        octants[std::size_t(above.x) + 2 * std::size_t(above.y) + 4 * std::size_t(above.z)].push_back(cube);
    }
    for (const std::vector<LitCube>& octant : octants) {
        if (octant.empty()) continue;
        for (int direction = 0; direction < 6; ++direction) {
            Batch& batch = batches_.emplace_back();
            const auto plane = [&](const LitCube& cube) { return facePlane(cube, direction); };
            const auto [least, most] = std::ranges::minmax_element(octant, {}, plane);
            batch.direction = direction, batch.nearest = plane(direction % 2 == 0 ? *least : *most), batch.merged = merged;
            batch.actor = actorOf(facesOf(octant, direction));
            renderer.AddActor(batch.actor);
        }
    }
}

void CubeActors::show(std::span<const LitCube> cubes, vtkRenderer& renderer) {
    clear(renderer);
    add(cubes, false, renderer);
    std::vector<LitCube> merged(cubes.begin(), cubes.end());
    while (merged.size() > kMostWhileTurning) merged = mergedCubes(merged);
    hasMerged_ = merged.size() < cubes.size();
    if (hasMerged_) add(merged, true, renderer);
}

void CubeActors::clear(vtkRenderer& renderer) {
    for (Batch& batch : batches_) renderer.RemoveActor(batch.actor);
    batches_.clear();
    hasMerged_ = false;
}

void CubeActors::prepare(const glm::vec3& eye, bool turning) {
    for (Batch& batch : batches_) {
        const float along = eye[batch.direction / 2];
        const bool faces = batch.direction % 2 == 0 ? along > batch.nearest : along < batch.nearest;
        batch.actor->SetVisibility(faces && batch.merged == (turning && hasMerged_));
    }
}

}  // namespace clv
