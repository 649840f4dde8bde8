// Plots as text: all of the data in the picture, in the right places.
#include "benchmarks/report/chart.h"

#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>

#include <gtest/gtest.h>

namespace {

using namespace clv;

// Centres of the markers of a colour such as "#d55e00", in pixels from the upper left.
std::vector<glm::dvec2> markersOf(const std::string& svg, const std::string& color) {
    const std::regex group("transform=\"matrix\\(([^,]+),0,0,([^,]+),([^,]+),([^)]+)\\)\"[^]*?<g fill=\"" + color + "\"[^]*?</g>");
    const std::regex use("<use x=\"([^\"]+)\"\\s+y=\"([^\"]+)\"\\s+width=\"([^\"]+)\"\\s+height=\"([^\"]+)\"");
    std::vector<glm::dvec2> centres;
    std::smatch found;
    if (!std::regex_search(svg, found, group)) return centres;
    const std::string text = found[0];
    const auto number = [](const std::ssub_match& m) { return std::stod(m.str()); };
    for (std::sregex_iterator it(text.begin(), text.end(), use), end; it != end; ++it) {
        const glm::dvec2 centre(number((*it)[1]) + 0.5 * number((*it)[3]), number((*it)[2]) + 0.5 * number((*it)[4]));
        centres.emplace_back(number(found[1]) * centre.x + number(found[3]), number(found[2]) * centre.y + number(found[4]));
    }
    return centres;
}

Chart oneSeries(std::vector<glm::dvec2> points) {
    return {.title = "title", .xTitle = "time, ms", .yTitle = "error, %", .series = {{.points = std::move(points), .color = {213, 94, 0}}}};
}

TEST(Chart, pointsLieInsideAndWhereTheirLogarithmsSay) {
    unsetenv("DISPLAY");
    const std::string svg = svgOf(oneSeries({{1, 100}, {10, 10}, {1000, 1}}), 640, 400);
    const auto at = markersOf(svg, "#d55e00");
    ASSERT_EQ(at.size(), 3u) << svg.substr(0, 500);
    for (const glm::dvec2& p : at) {
        EXPECT_TRUE(p.x > 0.0 && p.x < 640.0) << p.x;
        EXPECT_TRUE(p.y > 0.0 && p.y < 400.0) << p.y;
    }
    EXPECT_NEAR((at[2].x - at[0].x) / (at[1].x - at[0].x), 3.0, 0.02);
    EXPECT_NEAR((at[2].y - at[0].y) / (at[1].y - at[0].y), 2.0, 0.02);
    // A decade is as long on either axis, but for the room that the numbers happen to take.
    EXPECT_NEAR((at[1].x - at[0].x) / (at[1].y - at[0].y), 1.0, 0.1);
}

TEST(Chart, needsNothingFromElsewhereAndCutsNothingOff) {
    const std::string svg = svgOf(oneSeries({{1, 1}, {10, 10}}), 640, 400);
    EXPECT_TRUE(svg.starts_with("<svg"));
    EXPECT_EQ(svg.find("clip-path"), std::string::npos);
    EXPECT_EQ(svg.find("<text"), std::string::npos) << "letters are drawn: the reader's fonts may be others";
    EXPECT_EQ(svg.find("href=\"http"), std::string::npos);
}

TEST(Chart, colourAndMarkerTogetherTellDozensApart) {
    std::set<std::pair<int, std::string>> seen;
    constexpr std::size_t kCurves = 30;
    for (std::size_t i = 0; i < kCurves; ++i) {
        const glm::u8vec3 c = chartColor(i);
        seen.emplace(c.x << 16 | c.y << 8 | c.z, chartMarker(i));
    }
    EXPECT_EQ(seen.size(), kCurves);
}

TEST(Chart, allMarkersAreFilledShapes) {
    Chart chart;
    for (std::size_t i = 0; i < 8; ++i) chart.series.push_back({.points = {{1.0 + double(i), 1}, {10, 10}}, .color = chartColor(i), .marker = i});
    const std::string svg = svgOf(chart, 640, 400);
    EXPECT_NE(svg.find("<symbol id=\"Circle\""), std::string::npos);
    for (const char* lines : {"<symbol id=\"Cross\"", "<symbol id=\"Plus\""}) EXPECT_EQ(svg.find(lines), std::string::npos);
}

TEST(Chart, valuesThatHaveNoLogarithmAreLeftOut) {
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(markersOf(svgOf(oneSeries({{1, 1}, {0, 5}, {5, -1}, {3, infinite}, {10, 10}}), 640, 400), "#d55e00").size(), 2u);
    EXPECT_TRUE(svgOf(oneSeries({}), 640, 400).starts_with("<svg"));
}

}  // namespace
