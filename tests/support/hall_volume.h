// A small baked volume of the hall of boxes, for tests that need one with walls, splits and two cascades.
#pragma once
#include "bindings/volume_file/baked_volume.h"
#include "clv/cpu/build_level.h"
#include "clv/math/hash.h"
#include "clv/math/sampling.h"
#include "cpu/box_scene.h"

namespace clv::test {

// Here and there a cell has no slot.
inline BakedCascade hallCascade(const vec3& origin, float cellSize, const DepositLayout& layout, int estimates, bool moving) {
    ClvVolume grid{};
    grid.origin = origin;
    grid.cellSize = cellSize;
    grid.resolution = ivec3(8, 7, 6);
    grid.storage = layout.storage;
    const ParallelFor serial = [](std::size_t count, const std::function<void(std::size_t)>& body) {
        for (std::size_t i = 0; i < count; ++i) body(i);
    };
    const BoxScene scene = hall();
    std::vector<std::uint8_t> needed(8 * 7 * 6, 1);
    for (std::size_t cell = 5; cell < needed.size(); cell += 11) needed[cell] = 0;
    BakedCascade cascade{buildLevel(grid, scene.probe(), needed, serial, {.linesPerCell = 3}), {}, {}, {}};
    const std::size_t slots = cascade.level.slots.size(), stride = std::size_t(layout.stride());
    uint state = 1;
    const auto random = [&] { return clvUnitFloat(clvHash(state++)); };
    for (int i = 0; i < estimates; ++i) {
        auto& records = cascade.estimates.emplace_back(slots * stride, 0.0f);
        for (std::size_t s = 0; s < slots; ++s)
            for (int j = 0; j < layout.values(); ++j) records[s * stride + std::size_t(j)] = (0.5f + random()) * cascade.level.slots[s].openVolume;
    }
    for (std::size_t s = 0; s < slots; ++s) cascade.samples.push_back(float(1 + s % 7) * 1000.0f);
    for (std::size_t k = 0; k < slots * kSides && moving; ++k) cascade.dynamicity.push_back(random());
    return cascade;
}

// Two cascades around a camera that stands before the thin wall, far from the origin of the world.
inline BakedVolume hallVolume(int estimates = 2, bool moving = true, uint storage = kClvStorageCube9) {
    BakedVolume volume;
    volume.scene = "hall & \"boxes\" <1>";
    volume.mark = SceneMark{.triangles = 76, .bounds = {vec3(-3.3f, -2.1f, -4.7f), vec3(1.0f / 3.0f, 2.5f, 6.1f)}};
    volume.libraryVersion = "0.1.0";
    volume.anchor = {1e6, -2.5, 1.0 / 3.0};
    volume.lights = {{"lamp", {.position = vec3(0.1f, 2.0f, 0.3f), .type = kClvLightSpot, .direction = vec3(0.0f, -1.0f, 0.0f), .innerConeAngle = 0.3f,
                               .intensity = vec3(1.0f, 0.7f, 0.1f), .outerConeAngle = 0.7f, .dynamicity = 0.25f, .pad0 = 0.0f, .pad1 = 0.0f, .pad2 = 0.0f}}};
    volume.camera = Camera{.name = "door", .position = vec3(0.2f, 0.1f, -2.0f), .forward = vec3(1.0f, 0.0f, 0.0f)};
    volume.seed = 7;
    volume.frame = 3;
    volume.layout.storage = storage;
    volume.marginCells = 1.0f;
    volume.blendCells = 1.5f;
    volume.cascades.push_back(hallCascade(vec3(-1.03f, -3.7f, -4.1f), 0.61f, volume.layout, estimates, moving));
    volume.cascades.push_back(hallCascade(vec3(-4.03f, -5.3f, -6.1f), 1.22f, volume.layout, estimates, moving));
    return volume;
}

}  // namespace clv::test
