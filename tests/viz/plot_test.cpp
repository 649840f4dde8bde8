// Plots and differences by numbers.
#include <gtest/gtest.h>

#include "clv/cpu/parallel.h"
#include "support/hall_volume.h"
#include "viz/cell_shapes.h"
#include "viz/plot.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(Probe, readsTheCellsThatTheLinePasses) {
    const BakedVolume volume = hallVolume();
    const vec3 from(-3.0f, -1.0f, -2.2f), to(5.0f, -1.0f, -2.2f);
    const Plot plot = probe(volume, Quantity::samples, {}, from, to);
    EXPECT_FALSE(plot.bars);
    EXPECT_EQ(plot.yTitle, "samples, rays");
    ASSERT_GT(plot.points.size(), 100u);
    for (const glm::dvec2& point : plot.points) {
        const auto cell = cellAt(volume, from + float(point.x) * vec3(1.0f, 0.0f, 0.0f), {});
        EXPECT_EQ(std::isfinite(point.y), cell.has_value());
        if (!cell) continue;
        EXPECT_FLOAT_EQ(float(point.y), valueOf(*cell, Quantity::samples));
        EXPECT_GE(point.x, 0.0);
        EXPECT_LE(point.x, 8.0);
    }
}

TEST(Probe, ofOpenCellsWithoutLightIsZeroAndOfSolidOnesAGap) {
    BakedVolume volume = hallVolume();
    for (BakedCascade& cascade : volume.cascades) {
        for (auto& estimate : cascade.estimates) std::ranges::fill(estimate, 0.0f);
    }
    const vec3 from(-3.9f, -5.0f, -1.0f), to(5.0f, 2.5f, -1.0f);
    const Plot plot = probe(volume, Quantity::irradiance, {}, from, to);
    std::size_t gaps = 0;
    for (const glm::dvec2& point : plot.points) {
        const bool open = cellAt(volume, mix(from, to, float(point.x) / glm::length(to - from)), {}).has_value();
        gaps += open ? 0 : 1;
        EXPECT_EQ(std::isnan(point.y), !open);
        EXPECT_FALSE(open && point.y != 0.0);
    }
    EXPECT_GT(gaps, 10u);
    EXPECT_LT(gaps, plot.points.size() - 10);
}

TEST(Histogram, countsEveryCellThatIsShownOnce) {
    const BakedVolume volume = hallVolume();
    for (const Quantity quantity : {Quantity::irradiance, Quantity::samples, Quantity::open, Quantity::dynamicity}) {
        const Plot plot = histogram(volume, quantity, {}, serialFor());
        EXPECT_TRUE(plot.bars);
        const auto cells = shownCells(volume, {}, serialFor());
        double sum = 0.0, mean = 0.0, expected = 0.0;
        for (const glm::dvec2& bar : plot.points) sum += bar.y, mean += bar.x * bar.y;
        for (const ShownCell& cell : cells) expected += double(valueOf(cell, quantity));
        EXPECT_EQ(sum, double(cells.size()));
        // A bar stands for the values within half its width.
        const double width = plot.points[1].x - plot.points[0].x;
        EXPECT_NEAR(mean / sum, expected / double(cells.size()), 0.5 * width);
    }
}

TEST(Histogram, ofEqualValuesIsOneBar) {
    BakedVolume volume = hallVolume();
    for (BakedCascade& cascade : volume.cascades) std::ranges::fill(cascade.samples, 64.0f);
    const Plot plot = histogram(volume, Quantity::samples, {}, serialFor());
    EXPECT_EQ(std::ranges::count_if(plot.points, [](const glm::dvec2& bar) { return bar.y > 0.0; }), 1);
    EXPECT_LT(plot.points.front().x, 64.0);
    EXPECT_GT(plot.points.back().x, 64.0);
}

TEST(Difference, isRedWhereTheFirstHasMoreAndBlueWhereItHasLess) {
    const BakedVolume volume = hallVolume();
    BakedVolume other = volume;
    // Twice the light in half of the slots, half of it in the others.
    std::vector<float>& a = other.cascades[0].estimates[0];
    std::vector<float>& b = other.cascades[0].estimates[1];
    const std::size_t stride = std::size_t(volume.layout.stride());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const float factor = i / stride < a.size() / stride / 2 ? 2.0f : 0.5f;
        a[i] *= factor, b[i] *= factor;
    }
    View view;
    view.cascade = 0;
    Drawing drawing;
    drawDifference(volume, other, Quantity::irradiance, view, serialFor(), drawing);
    const auto cells = shownCells(volume, view.cascade, serialFor());
    ASSERT_EQ(drawing.cubes.size(), cells.size());
    std::size_t blue = 0, red = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const uint cell = clvCellIndex(volume.cascades[0].level.volume, cells[i].cell);
        const float here = luminance(cells[i].light.irradiance[2]), there = luminance(cellLight(other, other.cascades[0], cell).irradiance[2]);
        if (std::abs(here - there) < 0.1f * std::abs(here)) continue;  // a cell of slots of both kinds
        const glm::u8vec3 color = drawing.cubes[i].side[2];
        if (here < there) {
            ++blue;
            EXPECT_GT(color.z, color.x);
        } else {
            ++red;
            EXPECT_GT(color.x, color.z);
        }
    }
    EXPECT_GT(blue, 10u);
    EXPECT_GT(red, 10u);
    EXPECT_EQ(drawing.scale->lo, -drawing.scale->hi);

    other.cascades[0].level.volume.cellSize *= 2.0f;
    EXPECT_THROW(drawDifference(volume, other, Quantity::irradiance, view, serialFor(), drawing), InputError);
}

}  // namespace
