// The smallest baked volume with everything in it: a grid of two cells, one of them split, in a file of a few thousand bytes.
#pragma once
#include "bindings/volume_file/baked_volume.h"
#include "clv/cpu/build_level.h"

namespace clv::test {

inline BakedVolume smallVolume() {
    BakedVolume volume;
    volume.scene = "cornell", volume.libraryVersion = "0.1.0";
    volume.lights = {{"lamp", {.position = vec3(0.1f, 2.0f, 0.3f), .type = kClvLightPoint, .direction = vec3(0.0f, -1.0f, 0.0f), .innerConeAngle = 0.0f,
                               .intensity = vec3(1.0f), .outerConeAngle = 0.7f, .dynamicity = 0.0f, .pad0 = 0.0f, .pad1 = 0.0f, .pad2 = 0.0f}}};
    volume.layout = {kClvStorageCube, 1};
    ClvVolume grid{};
    grid.cellSize = 0.5f, grid.resolution = ivec3(2, 1, 1), grid.storage = kClvStorageCube;
    BakedCascade cascade{buildLevel(grid, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false}), {}, {}, {}};
    // Cell 0 gets a second slot, behind a plane.
    Level& level = cascade.level;
    level.slots.insert(level.slots.begin() + 1, level.slots[0]);
    level.splits.push_back({vec4(1.0f, 0.0f, 0.0f, 0.25f), 0u, 1u, 0u, 2u});
    level.table = {kClvSplitBit, 2u};
    const std::size_t slots = level.slots.size();
    for (int estimate = 0; estimate < 2; ++estimate) {
        auto& records = cascade.estimates.emplace_back(slots * std::size_t(volume.layout.stride()), 0.0f);
        for (std::size_t s = 0; s < slots; ++s) {
            for (int k = 0; k < volume.layout.values(); ++k) records[s * std::size_t(volume.layout.stride()) + std::size_t(k)] = float(1 + estimate + k);
        }
    }
    cascade.samples.assign(slots, 1000.0f);
    cascade.dynamicity.assign(slots * kSides, 0.5f);
    volume.cascades.push_back(cascade);
    return volume;
}

}  // namespace clv::test
