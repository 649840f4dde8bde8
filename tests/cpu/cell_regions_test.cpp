// The open regions of a single cell: the point that stands for each.
#include "clv/cpu/cell_regions.h"

#include <gtest/gtest.h>

#include "box_scene.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

// Distance from a position to the surface of a box, m; below 0 inside of it.
float distanceTo(const test::Box& box, const vec3& position) {
    const vec3 beyond = abs((position - box.center) * box.axes) - box.half;
    const float inside = std::min(std::max(beyond.x, std::max(beyond.y, beyond.z)), 0.0f);
    return length(max(beyond, vec3(0.0f))) + inside;
}

TEST(CellRegions, thePointOfARegionThatBendsAroundAColumnKeepsClearOfIt) {
    const float h = 0.5f;
    ClvVolume volume{};
    volume.resolution = ivec3(3);
    volume.cellSize = h;
    const CellBox all{ivec3(0), volume.resolution};
    LineGrid lines;
    RegionFinder finder;
    int large = 0;
    float meanClearance = 0.0f;  // cells
    for (uint i = 0; i < 100; ++i) {
        const float halfWidth = (0.15f + 0.15f * test::randomUnit(1, i)) * h;
        const vec3 off(test::randomUnit(2, i) - 0.5f, 0.0f, test::randomUnit(3, i) - 0.5f);
        const test::Box column{vec3(1.5f * h) + 0.5f * h * off, vec3(halfWidth, 2.0f * h, halfWidth), false, test::turned(test::randomUnit(4, i))};
        const test::BoxScene scene{{column}};
        lines.trace(volume, all, 8, {}, scene.probe(), serialFor());
        const CellRegions& found = finder.find(lines, ivec3(1));
        ASSERT_FALSE(found.regions.empty());
        for (const OpenRegion& region : found.regions) {
            EXPECT_GT(distanceTo(column, region.inside), 0.0f) << i;
            if (region.volume < 0.2f * h * h * h) continue;
            ++large;
            meanClearance += distanceTo(column, region.inside) / h;
        }
    }
    ASSERT_GT(large, 50);
    EXPECT_GT(meanClearance / float(large), 0.25f);
}

TEST(CellRegions, aSolidLongerThanTheLinesIsStillSolid) {
    // Longer along x than lines reach on either side of the grid; as wide as the grid, so that whole cells lie inside.
    const float h = 0.5f;
    ClvVolume volume{};
    volume.resolution = ivec3(3);
    volume.cellSize = h;
    const test::BoxScene scene{{{vec3(1.5f * h), vec3(100.0f, 0.7f * h, 0.9f * h)}}};
    LineGrid lines;
    lines.trace(volume, {ivec3(0), volume.resolution}, 8, {}, scene.probe(), serialFor());
    RegionFinder finder;
    EXPECT_TRUE(finder.find(lines, ivec3(1)).regions.empty());
    // The cells beside it are open but for what it fills of them: 0.2 of their height.
    const CellRegions& beside = finder.find(lines, ivec3(1, 2, 1));
    ASSERT_EQ(beside.regions.size(), 1u);
    EXPECT_NEAR(beside.regions[0].volume, 0.8f * h * h * h, 0.01f * h * h * h);

    // Where surfaces are sheets, the inside is open space of its own.
    SceneProbe sheets = scene.probe();
    sheets.solids = false;
    lines.trace(volume, {ivec3(0), volume.resolution}, 8, {}, sheets, serialFor());
    ASSERT_EQ(finder.find(lines, ivec3(1)).regions.size(), 1u);
    EXPECT_FLOAT_EQ(finder.find(lines, ivec3(1)).regions[0].volume, h * h * h);
    const CellRegions& both = finder.find(lines, ivec3(1, 2, 1));
    ASSERT_EQ(both.regions.size(), 2u);
    EXPECT_NEAR(both.regions[0].volume, 0.8f * h * h * h, 0.01f * h * h * h);
    EXPECT_NEAR(both.regions[1].volume, 0.2f * h * h * h, 0.01f * h * h * h);
    ASSERT_EQ(both.splits.size(), 1u);
}

}  // namespace
