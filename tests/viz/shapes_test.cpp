// What views come down to, by numbers: scales, merged cubes, slices, meshes.
#include <gtest/gtest.h>

#include <map>

#include "clv/cpu/parallel.h"
#include "support/hall_volume.h"
#include "viz/cell_shapes.h"
#include "viz/camera_pose.h"
#include "viz/color_bar.h"
#include "viz/scene_mesh.h"
#include "viz/status.h"
#include "viz/text_style.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(ColorScale, endsAtARoundNumberThatFewValuesExceed) {
    std::vector<float> values;
    for (int i = 1; i <= 100; ++i) values.push_back(0.013f * float(i));
    values.push_back(NAN);
    const ColorScale scale = scaleFor("x", values);
    EXPECT_EQ(scale.lo, 0.0);
    EXPECT_DOUBLE_EQ(scale.hi, 2.0);
    EXPECT_FLOAT_EQ(float(scale.most), 1.3f);
    EXPECT_EQ(scale.color(-1.0), scale.color(0.0));
    EXPECT_EQ(scale.color(7.0), scale.color(2.0));
    EXPECT_NE(scale.color(0.5), scale.color(1.0));
}

TEST(ColorBar, marksTheEndsThatValuesLieBeyond) {
    ColorScale scale{.title = "x", .lo = -2.0, .hi = 2.0, .least = -1.0, .most = 2.0};
    EXPECT_EQ(labelOf(scale, 1.0), "2.00");
    EXPECT_EQ(labelOf(scale, 0.0), "-2.00");
    scale.least = -2.5, scale.most = 7.0;
    EXPECT_EQ(labelOf(scale, 1.0), ">= 2.00");
    EXPECT_EQ(labelOf(scale, 0.5), "0.00");
    EXPECT_EQ(labelOf(scale, 0.0), "<= -2.00");
}

TEST(Status, saysWhatKeysHaveSet) {
    View view;
    EXPECT_EQ(statusOf(view, 1), "cells with any light, exposure +0.0");
    view.threshold = 0.002f, view.exposure = -1.5, view.cascade = 1;
    EXPECT_EQ(statusOf(view, 3), "cells from 0.002 W/m^2, exposure -1.5, cascade 1 alone");
    view.subject = Subject::samples, view.slices = {{2, 0.25}};
    EXPECT_EQ(statusOf(view, 1), "z = 0.250 m");
    view.lookup.planeCulling = false;
    view.subject = Subject::mesh;
    EXPECT_EQ(statusOf(view, 1), "exposure -1.5, no plane culling");
}

TEST(ColorScale, moreStopsAreBrighterAndNoLightIsBlack) {
    const std::vector<vec3> radiance(10, vec3(0.2f, 0.4f, 0.1f));
    const glm::u8vec3 plain = screenColor(radiance[0], exposureFor(radiance, 0.0)), brighter = screenColor(radiance[0], exposureFor(radiance, 1.0));
    for (int c = 0; c < 3; ++c) EXPECT_GT(brighter[c], plain[c]);
    EXPECT_EQ(screenColor(vec3(0.0f), exposureFor(radiance, 0.0)), glm::u8vec3(0));
}

TEST(Caption, isBrokenAtSpacesWhereThePaneEnds) {
    const double tenLetters = 0.6 * kTextSize * 10.5;
    EXPECT_EQ(wrapped("a caption", tenLetters), "a caption");
    EXPECT_EQ(wrapped("ten letter and more", tenLetters), "ten letter\nand more");
    EXPECT_EQ(wrapped("eleven lett\ners in a line", tenLetters), "eleven\nlett\ners in a\nline");
    EXPECT_EQ(wrapped("irradiance of all", tenLetters), "irradiance\nof all");
    EXPECT_EQ(wrapped("standard-errors of all", tenLetters), "standard-errors\nof all");
    EXPECT_EQ(wrapped("", tenLetters), "");
}

TEST(Difference, isShownWhereEitherFileHasLight) {
    const BakedVolume lit = hallVolume();
    BakedVolume dark = lit;
    for (BakedCascade& cascade : dark.cascades) {
        for (auto& estimate : cascade.estimates) std::ranges::fill(estimate, 0.0f);
    }
    View view;
    view.subject = Subject::irradiance;
    view.carrier = Carrier::cells;
    Drawing lost, gained, none;
    drawDifference(lit, dark, Quantity::irradiance, view, serialFor(), lost);
    drawDifference(dark, lit, Quantity::irradiance, view, serialFor(), gained);
    drawDifference(dark, dark, Quantity::irradiance, view, serialFor(), none);
    EXPECT_GT(lost.cubes.size(), 100u);
    EXPECT_EQ(gained.cubes.size(), lost.cubes.size());
    EXPECT_TRUE(none.cubes.empty());
}

TEST(Overview, showsWhatOfTheSceneTheOutermostCascadeHolds) {
    BakedVolume volume;
    volume.cascades.resize(2);
    ClvVolume& grid = volume.cascades[1].level.volume;
    grid.origin = vec3(-8.0f), grid.cellSize = 1.0f, grid.resolution = ivec3(16);
    EXPECT_EQ(litBounds(volume).hi, vec3(8.0f));
    volume.mark = SceneMark{.triangles = 1, .bounds = {vec3(-1.0f, -9.0f, 2.0f), vec3(3.0f, 1.0f, 4.0f)}};
    EXPECT_EQ(litBounds(volume).lo, vec3(-1.0f, -8.0f, 2.0f));
    EXPECT_EQ(litBounds(volume).hi, vec3(3.0f, 1.0f, 4.0f));
    volume.mark->bounds = {vec3(20.0f), vec3(21.0f)};
    EXPECT_EQ(litBounds(volume).lo, vec3(-8.0f));
}

TEST(MergedCubes, standForBlocksOfEightWithTheirMeanColor) {
    std::vector<LitCube> cubes;
    for (int i = 0; i < 64; ++i) {
        LitCube cube{vec3(i % 4, i / 4 % 4, i / 16) + 0.5f, 0.7f, 1.0f, {}};
        cube.side.fill(glm::u8vec3(i % 2 ? 100 : 50));
        cubes.push_back(cube);
    }
    const std::vector<LitCube> merged = mergedCubes(cubes);
    ASSERT_EQ(merged.size(), 8u);
    for (const LitCube& cube : merged) {
        EXPECT_EQ(cube.cell, 2.0f);
        EXPECT_FLOAT_EQ(cube.edge, 1.4f);
        EXPECT_EQ(glm::mod(cube.center, vec3(2.0f)), vec3(1.0f));
        EXPECT_EQ(cube.side[3], glm::u8vec3(75));
    }
}

TEST(Slices, showEachCellThatThePlaneCutsAsASquareOnIt) {
    const BakedVolume volume = hallVolume();
    View view;
    view.carrier = Carrier::slices;
    view.slices = {{2, volume.anchor.z - 2.2}};
    Drawing drawing;
    drawQuantity(volume, Quantity::samples, view, serialFor(), drawing);
    EXPECT_TRUE(drawing.cubes.empty());
    std::size_t expected = 0;
    for (const ShownCell& cell : shownCells(volume, {}, serialFor())) expected += std::abs(cell.center.z + 2.2f) < 0.5f * cell.edge ? 1 : 0;
    EXPECT_GT(expected, 20u);
    EXPECT_EQ(drawing.tiles.colors.size(), expected);
    ASSERT_EQ(drawing.tiles.points.size(), 4 * expected);
    for (const vec3& p : drawing.tiles.points) EXPECT_NEAR(p.z, -2.2f, 1e-5f);
    ASSERT_TRUE(drawing.scale);
    EXPECT_EQ(drawing.scale->title, "samples, rays");
}

TEST(VolumeCarrier, hasAValueWhereACellIsShownAndNoneElsewhere) {
    const BakedVolume volume = hallVolume();
    View view;
    view.carrier = Carrier::volume;
    Drawing drawing;
    drawQuantity(volume, Quantity::open, view, serialFor(), drawing);
    ASSERT_EQ(drawing.grids.size(), 2u);
    for (std::size_t cascade = 0; cascade < 2; ++cascade) {
        const GridValues& grid = drawing.grids[cascade];
        for (uint i = 0; i < grid.values.size(); ++i) {
            const auto shown = shownCell(volume, uint(cascade), clvCellFromIndex(grid.grid, i), {});
            EXPECT_EQ(std::isfinite(grid.values[i]), shown.has_value());
            if (!shown) continue;
            EXPECT_FLOAT_EQ(grid.values[i], valueOf(*shown, Quantity::open));
        }
    }
}

TEST(SceneMesh, coversTheSceneWithTrianglesThatFaceAsTheirsDo) {
    const Scene scene = loadScene("cornell");
    const auto areaOf = [](const vec3& a, const vec3& b, const vec3& c) { return 0.5 * double(glm::length(glm::cross(b - a, c - a))); };
    double sceneArea = 0.0;
    for (const glm::uvec3& t : scene.triangles) sceneArea += areaOf(scene.positions[t.x], scene.positions[t.y], scene.positions[t.z]);
    for (const bool backs : {false, true}) {
        const SceneMesh mesh = meshOf(scene, 2000, backs);
        double area = 0.0;
        for (const glm::uvec3& t : mesh.triangles) {
            const vec3 a = mesh.points[t.x], b = mesh.points[t.y], c = mesh.points[t.z];
            area += areaOf(a, b, c);
            EXPECT_GT(dot(cross(b - a, c - a), mesh.receivers[t.x].normal), 0.0f);
        }
        EXPECT_NEAR(area, sceneArea * (backs ? 2.0 : 1.0), 1e-3 * sceneArea);
        EXPECT_GT(mesh.triangles.size(), 2000u);
        EXPECT_EQ(mesh.albedo.size(), mesh.points.size());
    }
}

}  // namespace
