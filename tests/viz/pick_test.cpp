// Picking by numbers.
#include <gtest/gtest.h>

#include "clv/cpu/parallel.h"
#include "support/hall_volume.h"
#include "viz/describe.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(Pick, aLineOfSightMeetsTheNearestCubeThatIsShown) {
    const BakedVolume volume = hallVolume();
    const View view;
    const auto cells = shownCells(volume, {}, serialFor());
    const ShownCell& target = cells[cells.size() / 3];
    // From inside the gap before the cube.
    const Sight sight{target.center - vec3(0.49f * target.edge, 0.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f)};
    const auto pick = pickAlong(volume, nullptr, view, sight, serialFor());
    ASSERT_TRUE(pick);
    EXPECT_EQ(pick->position, target.center);
    EXPECT_FALSE(pick->normal);
    EXPECT_FALSE(pickAlong(volume, nullptr, view, {vec3(100.0f), vec3(1.0f, 0.0f, 0.0f)}, serialFor()));
}

TEST(Pick, aSliceIsMetWhereItShowsACell) {
    const BakedVolume volume = hallVolume();
    View view;
    view.subject = Subject::samples;
    view.carrier = Carrier::slices;
    view.slices = {{0, volume.anchor.x + 50.0}, {2, volume.anchor.z - 2.2}};
    const auto cells = shownCells(volume, {}, serialFor());
    const auto cut = std::ranges::find_if(cells, [](const ShownCell& cell) { return std::abs(cell.center.z + 2.2f) < 0.4f * cell.edge; });
    ASSERT_NE(cut, cells.end());
    const auto pick = pickAlong(volume, nullptr, view, {vec3(cut->center.x, cut->center.y, 20.0f), vec3(0.0f, 0.0f, -1.0f)}, serialFor());
    ASSERT_TRUE(pick);
    EXPECT_EQ(pick->slice, 1u);
    EXPECT_NEAR(pick->position.z, -2.2f, 1e-5f);
}

TEST(Pick, aSurfaceIsMetOnTheSideThatShows) {
    BakedVolume volume;
    volume.scene = "cornell";
    const Scene scene = loadScene("cornell");
    volume.anchor = scene.anchor;
    volume.lights = scene.lights;
    volume.cascades.emplace_back().level.volume = volumeOverBounds(scene.bounds.lo, scene.bounds.hi, 4, kClvStorageCube9);
    volume.cascades[0].level.table.assign(std::size_t(volume.cascades[0].level.volume.resolution.x * volume.cascades[0].level.volume.resolution.y * volume.cascades[0].level.volume.resolution.z), kClvNoSlot);
    const World world(volume, "");
    View view;
    view.subject = Subject::mesh;
    const vec3 middle = scene.bounds.center(), out = scene.bounds.extent();
    // From above: the ceiling turns its back, the floor or a block below shows its face.
    const auto pick = pickAlong(volume, &world, view, {middle + vec3(0.0f, 3.0f * out.y, 0.0f), vec3(0.0f, -1.0f, 0.0f)}, serialFor());
    ASSERT_TRUE(pick);
    ASSERT_TRUE(pick->normal);
    EXPECT_NEAR(pick->normal->y, 1.0f, 1e-5f);
    EXPECT_LT(pick->position.y, scene.bounds.hi.y - 0.1f * out.y);
}

TEST(Drag, thePlaneStaysUnderTheMouse) {
    const Sight sight{vec3(1.0f, 2.0f, 10.0f), normalize(vec3(0.3f, 0.1f, -1.0f))};
    const vec3 grabbed(0.2f, 2.5f, 1.0f);
    // No other place on the axis is nearer to the line of sight.
    const auto distance = [&](float x) {
        const vec3 p(x, grabbed.y, grabbed.z);
        return glm::length(cross(p - sight.origin, sight.direction));
    };
    const float x = draggedPlace(grabbed, 0, sight);
    EXPECT_LT(distance(x), distance(x - 0.01f));
    EXPECT_LT(distance(x), distance(x + 0.01f));
    EXPECT_EQ(draggedPlace(grabbed, 0, {vec3(-5.0f, 0.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f)}), grabbed.x);
}

TEST(Drag, aLightKeepsItsDistanceFromTheScreen) {
    const vec3 normal(0.0f, 0.0f, 1.0f), grabbed(0.5f, 0.5f, 3.0f);
    const vec3 position = draggedPosition(grabbed, normal, {vec3(0.0f, 0.0f, 10.0f), normalize(vec3(0.2f, -0.1f, -1.0f))});
    EXPECT_NEAR(position.z, 3.0f, 1e-5f);
    EXPECT_NEAR(position.x, 1.4f, 1e-5f);
    EXPECT_NEAR(position.y, -0.7f, 1e-5f);
}

}  // namespace
