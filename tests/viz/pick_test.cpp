// Picking by numbers.
#include <gtest/gtest.h>

#include <sstream>

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

TEST(Pick, isOfTheCascadeThatIsShownAlone) {
    const BakedVolume volume = hallVolume();
    View view;
    view.cascade = 1;
    const auto coarse = shownCells(volume, view.cascade, serialFor());
    const auto target = std::ranges::find_if(coarse, [&](const ShownCell& cell) { return cellAt(volume, cell.center, {})->cascade == 0; });
    ASSERT_NE(target, coarse.end());
    const auto pick = pickAlong(volume, nullptr, view, {target->center - vec3(0.49f * target->edge, 0.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f)}, serialFor());
    ASSERT_TRUE(pick);
    EXPECT_EQ(pickedCell(volume, *pick)->cascade, 1u);
    EXPECT_EQ(pickedCell(volume, *pick)->cell, target->cell);
    const glm::dvec3 place = glm::dvec3(target->center) + volume.anchor;
    EXPECT_EQ(pickedCell(volume, typedPick({place.x, place.y, place.z}, volume, 1))->cascade, 1u);
    EXPECT_EQ(pickedCell(volume, typedPick({place.x, place.y, place.z}, volume, {}))->cascade, 0u);
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
    view.subject = Subject::samples;
    view.carrier = Carrier::slices;
    EXPECT_FALSE(pickAlong(volume, &world, view, {middle + vec3(0.0f, 3.0f * out.y, 0.0f), vec3(0.0f, -1.0f, 0.0f)}, serialFor())) << "no surface is drawn";
}

// What follows a word, up to the end of its line.
std::vector<std::string> linesAfter(const std::string& text, const std::string& word) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) lines.push_back(text.substr(at + word.size(), text.find('\n', at + word.size()) - at - word.size()));
    return lines;
}

TEST(Describe, aCutCellRegionByRegionAndWhichOneWasPicked) {
    const BakedVolume volume = hallVolume();
    const auto cells = shownCells(volume, {}, serialFor());
    const auto cut = std::ranges::find_if(cells, [](const ShownCell& cell) { return cell.light.slots == 2; });
    ASSERT_NE(cut, cells.end());
    const BakedCascade& cascade = volume.cascades[cut->cascade];
    const uint entry = cascade.level.table[clvCellIndex(cascade.level.volume, cut->cell)];
    const CellSlots slots = slotsOfCell(cascade.level, entry);
    int described = 0;
    for (uint i = 0; i < 2; ++i) {
        const vec3 place = cascade.level.slots[slots.first + i].openCentroid;
        if (slotAtPosition(cascade.level, entry, place) != slots.first + i) continue;
        ++described;
        const std::string text = describe(volume, {.position = place}, {});
        const auto regions = linesAfter(text, "\nregion "), up = linesAfter(text, "\n+y ");
        ASSERT_EQ(regions.size(), 2u) << text;
        ASSERT_EQ(up.size(), 2u) << text;
        for (uint k = 0; k < 2; ++k) {
            EXPECT_EQ(regions[k].ends_with(": here"), k == i) << text;
            EXPECT_NEAR(std::stof(up[k]), regionLight(volume, cascade, slots.first + k).irradiance[2].x, 1e-3f * std::stof(up[k]));
        }
    }
    EXPECT_GT(described, 0);
}

TEST(Describe, whatASurfaceReadsByWeightAndItsSum) {
    const BakedVolume volume = hallVolume();
    const Pick pick{.position = vec3(0.3f, -1.0f, -2.3f), .normal = vec3(0.0f, 1.0f, 0.0f)};
    const std::string text = describe(volume, pick, {});
    const std::size_t table = text.find("cell         weight");
    ASSERT_NE(table, std::string::npos) << text;
    std::istringstream lines(text.substr(text.find('\n', table) + 1));
    double last = 1.0, sum = 0.0;
    int terms = 0;
    for (std::string line; std::getline(lines, line) && !line.empty() && !line.starts_with("cascade"); ++terms) {
        const bool others = line.find("others") != std::string::npos;
        const double weight = others ? 0.0 : std::stod(line.substr(13));
        EXPECT_LE(weight, last) << line;
        EXPECT_TRUE(others || weight > 0.0) << line;
        last = weight;
        if (const std::size_t adds = line.find('('); adds != std::string::npos) sum += std::stod(line.substr(adds + 1));
    }
    EXPECT_GT(terms, 8);
    const std::size_t gives = text.find("cascade 0 gives (");
    ASSERT_NE(gives, std::string::npos) << text;
    const double expected = std::stod(text.substr(gives + 17));
    EXPECT_NEAR(sum, expected, 2e-3 * expected);
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
