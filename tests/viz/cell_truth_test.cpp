// The truth of cells, against scenes whose answer is known, and what the view makes of it.
#include <gtest/gtest.h>

#include <cmath>

#include "bindings/embree/task_pool.h"
#include "viz/baked_scene.h"
#include "viz/cell_errors.h"
#include "viz/truth_error.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(CellTruth, insideOfSolidsIsNotOpenAndAllElseIs) {
    const Scene scene = loadScene("furnace_box");  // a cupboard, and a plank around (-0.21, -0.18, 0.13)
    const EmbreeScene embree(scene);
    const auto at = [&](const glm::dvec3& world) { return isOpen(embree, vec3(world - scene.anchor)); };
    EXPECT_TRUE(at({0.0, 0.0, 0.0}));
    EXPECT_TRUE(at({-0.5, -0.45, 0.5})) << "next to a corner";
    EXPECT_FALSE(at({-0.21, -0.18, 0.13})) << "the plank";
    EXPECT_TRUE(at({-0.21, -0.30, 0.13})) << "below it";
    EXPECT_TRUE(at({0.0, 5.0, 0.0})) << "outside of all";
}

TEST(CellTruth, inASphereLitFromItsMiddleAllSidesReadTheSame) {
    // One bounce: albedo 0.8 times a flux of 4 pi W over an area of 4 pi m^2, from all directions alike; the facets of the sphere are
    // lit within a percent of it.
    const Scene scene = loadScene("white_sphere");
    const EmbreeScene embree(scene);
    std::vector<ShownCell> cells;
    for (const float x : {-0.3f, 0.0f, 0.4f}) cells.push_back({0, ivec3(int(10.0f * x), 0, 0), vec3(glm::dvec3(x, 0.1, 0.2) - scene.anchor), 0.1f, {}});
    CellTruth truths;
    const auto truth = truths.of(cells, embree, {.samples = 4096}, tbbParallelFor());
    ASSERT_EQ(truth.size(), 3u);
    for (const auto& cell : truth) {
        ASSERT_TRUE(cell);
        for (std::size_t side = 0; side < kSides; ++side) {
            EXPECT_NEAR(cell->irradiance[side].y, 0.8f, 0.01f);
            EXPECT_LT(cell->standardError[side], 0.02f);
        }
    }
}

TEST(CellTruth, isKeptUntilTheQuestionIsAnother) {
    const Scene scene = loadScene("cornell");
    const EmbreeScene embree(scene);
    const std::vector<ShownCell> cells{{0, ivec3(3), vec3(0.0f), 0.05f, {}}};
    CellTruth truths;
    int asked = 0;
    const ParallelFor counting = [&](std::size_t count, const std::function<void(std::size_t)>& body) {
        asked += int(count);
        for (std::size_t i = 0; i < count; ++i) body(i);
    };
    const auto first = truths.of(cells, embree, {.samples = 32}, counting), again = truths.of(cells, embree, {.samples = 32}, counting);
    EXPECT_EQ(asked, 1);
    ASSERT_TRUE(first[0] && again[0]);
    EXPECT_EQ(first[0]->irradiance, again[0]->irradiance);
    truths.of(cells, embree, {.samples = 64}, counting);
    EXPECT_EQ(asked, 2);
    truths.clear();
    truths.of(cells, embree, {.samples = 64}, counting);
    EXPECT_EQ(asked, 3);
}

TEST(MedianError, isOfPointsThatReceiveLight) {
    const std::vector<vec3> truth{vec3(0.0f), vec3(3.0f, 0.0f, 0.0f), vec3(0.0f), vec3(0.0f), vec3(4.0f, 0.0f, 0.0f)};
    const std::vector<float> errors{0.0f, 0.3f, 0.0f, 0.0f, 0.4f};
    EXPECT_NEAR(medianError(errors, truth), 0.1, 1e-6);
    EXPECT_EQ(medianError({}, {}), 0.0);
}

struct ErrorView {
    BakedVolume volume = bakedScene("cornell", 10);
    World world{volume, ""};
    View view;
    Drawing drawing;

    ErrorView() {
        view.subject = Subject::error;
        view.errorSamples = 256;
    }
    void draw() { drawCellErrors(volume, world, view, tbbParallelFor(), drawing); }
    // How many of the values that a scale of 1 gives colours to are above a limit.
    double shareAbove(double limit) const {
        std::size_t above = 0, all = 0;
        const glm::u8vec3 bound = drawing.scale->color(limit);
        for (const LitCube& cube : drawing.cubes) {
            for (const glm::u8vec3& color : cube.side) ++all, above += luma(color) > luma(bound);
        }
        return double(above) / double(all);
    }
    static int luma(const glm::u8vec3& c) { return 2 * c.x + 7 * c.y + c.z; }
};

TEST(CellErrors, aGoodVolumeErrsLittleAndADimmedOneByAsMuchAsItIsDimmed) {
    ErrorView good;
    good.view.range = {0.0, 1.0};
    good.draw();
    ASSERT_GT(good.drawing.cubes.size(), 200u);
    EXPECT_EQ(good.drawing.scale->title, "error / truth");
    // The median is about the noise of the truth, a tenth, and that of few rays.
    EXPECT_LT(good.shareAbove(0.2), 0.5);

    ErrorView dim;
    dim.view.range = {0.0, 1.0};
    for (auto& estimate : dim.volume.cascades[0].estimates) {
        for (float& value : estimate) value *= 0.4f;
    }
    dim.draw();
    EXPECT_GT(dim.shareAbove(0.5), 0.5) << "the median is 0.6";
    EXPECT_LT(dim.shareAbove(0.7), 0.5);
}

TEST(CellErrors, slicesAndVolumesShowTheSameCells) {
    ErrorView slices;
    slices.view.slices = {{2, slices.volume.anchor.z + 0.01}};
    slices.draw();
    EXPECT_TRUE(slices.drawing.cubes.empty());
    EXPECT_EQ(slices.drawing.tiles.colors.size(), cellsCutBy(slices.volume, slices.view.slices[0], {}).size());
    EXPECT_GT(slices.drawing.tiles.colors.size(), 50u);

    ErrorView volume;
    volume.view.carrier = Carrier::volume;
    volume.draw();
    ASSERT_EQ(volume.drawing.grids.size(), 1u);
    std::size_t known = 0;
    for (const float value : volume.drawing.grids[0].values) known += std::isfinite(value);
    EXPECT_EQ(known, shownCells(volume.volume, {}, serialFor()).size());
}

TEST(CellErrors, ofManyCellsOneInABlockIsMeasured) {
    ErrorView fine;
    fine.volume = bakedScene("cornell", 20);
    fine.view.errorSamples = 16;
    fine.draw();
    EXPECT_LE(fine.drawing.cubes.size(), kMostMeasured);
    EXPECT_GT(fine.drawing.cubes.size(), kMostMeasured / 10);
    EXPECT_NE(fine.drawing.caption.find("one cell in 2 x 2 x 2"), std::string::npos) << fine.drawing.caption;
}

}  // namespace
