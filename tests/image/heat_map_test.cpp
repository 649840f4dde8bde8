// Heat maps can be read: brighter is more, and the bar's numbers stand where they belong.
#include "bindings/image/heat_map.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bindings/image/bitmap_font.h"
#include "bindings/image/tone_map.h"

namespace {

using namespace clv;

TEST(HeatMap, colorsBrightenAllTheWayFromBlackToWhite) {
    EXPECT_EQ(heatColor(0.0f), glm::vec3(0.0f));
    EXPECT_NEAR(luminance(heatColor(1.0f)), 1.0f, 1e-5f);
    for (int i = 1; i <= 256; ++i) EXPECT_GT(luminance(heatColor(float(i) / 256.0f)), luminance(heatColor(float(i - 1) / 256.0f)));
}

TEST(HeatMap, niceCeilingIsOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_DOUBLE_EQ(niceCeiling(0.013), 0.02);
    EXPECT_DOUBLE_EQ(niceCeiling(0.2), 0.2);
    EXPECT_DOUBLE_EQ(niceCeiling(0.21), 0.5);
    EXPECT_DOUBLE_EQ(niceCeiling(0.7), 1.0);
    EXPECT_DOUBLE_EQ(niceCeiling(60.0), 100.0);
}

TEST(HeatMap, valuesTakeTheirColorAndTheTopIsTheLimit) {
    const float nothing = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> values(200 * 100, 0.05f);
    values[0] = 0.0f;
    values[1] = 0.3f;
    values[2] = nothing;
    const Image map = heatMap(values, 200, 100, 0.1);
    EXPECT_EQ(map.at(0, 0), heatColor(0.0f));
    EXPECT_EQ(map.at(1, 0), heatColor(1.0f));
    EXPECT_EQ(map.at(3, 0), heatColor(0.5f));
    const glm::vec3 grey = map.at(2, 0);
    EXPECT_TRUE(grey.x == grey.y && grey.y == grey.z && grey.x > 0.0f);
}

TEST(HeatMap, barRunsFromTheTopColorDownToBlack) {
    const int width = 160, height = 120;
    const Image map = heatMap(std::vector<float>(std::size_t(width * height), 0.0f), width, height, 0.2);
    ASSERT_GT(map.width, width);
    const int barX = width + 2 * kGlyphWidth;
    int previousRow = 0;
    float previous = 2.0f;
    for (int y = 0; y < height; ++y) {
        const float value = luminance(map.at(barX, y));
        if (value == 0.0f) continue;
        EXPECT_LT(value, previous) << "row " << y;
        previous = value;
        previousRow = y;
    }
    EXPECT_GT(previousRow, height / 2);
}

// Whether `text` stands at (x, y), ink and gaps.
bool reads(const Image& image, int x, int y, const std::string& text) {
    Image expected(textWidth(text, 1), kGlyphHeight);
    drawText(expected, 0, 0, 1, text, glm::vec3(1.0f));
    for (int row = 0; row < expected.height; ++row)
        for (int column = 0; column < expected.width; ++column)
            if (image.at(x + column, y + row) != expected.at(column, row)) return false;
    return true;
}

TEST(HeatMap, numbersOnTheBarRiseFromZeroToTheTop) {
    const int width = 160, height = 120;
    const Image map = heatMap(std::vector<float>(std::size_t(width * height), 0.0f), width, height, 0.2);
    // Found from below upwards, each in the same column of the picture.
    int found = 0, previous = height;
    for (const std::string text : {"0%", "5%", "10%", "15%", "20%"})
        for (int y = previous - kGlyphHeight - 1; y >= 0; --y)
            if (reads(map, map.width - kGlyphWidth - textWidth("20%", 1), y, text)) {
                ++found;
                previous = y;
                break;
            }
    EXPECT_EQ(found, 5);
    EXPECT_LT(previous, kGlyphHeight);
}

TEST(BitmapFont, everyCharacterOfANumberHasItsOwnShape) {
    std::vector<std::vector<glm::vec3>> shapes;
    for (char character : std::string("0123456789.%")) {
        Image image(kGlyphWidth, kGlyphHeight);
        drawText(image, 0, 0, 1, std::string(1, character), glm::vec3(1.0f));
        for (const auto& other : shapes) EXPECT_NE(image.pixels, other) << character;
        EXPECT_NE(image.pixels, Image(kGlyphWidth, kGlyphHeight).pixels) << character;
        shapes.push_back(image.pixels);
    }
}

TEST(BitmapFont, textIsScaledPlacedAndCutAtTheEdge) {
    Image image(20, 20);
    drawText(image, 4, 3, 2, "1", glm::vec3(1.0f));
    EXPECT_EQ(image.at(4 + 4, 3), glm::vec3(1.0f));  // the top of the stroke: column 2, row 0
    EXPECT_EQ(image.at(4 + 5, 3 + 1), glm::vec3(1.0f));
    EXPECT_EQ(image.at(4, 3), glm::vec3(0.0f));
    EXPECT_EQ(textWidth("50%", 2), 2 * (3 * kGlyphWidth + 2));
    Image small(3, 3);
    drawText(small, -2, -2, 1, "88", glm::vec3(1.0f));
    EXPECT_EQ(small.at(2, 0), glm::vec3(1.0f));  // column 4, row 2 of the first letter
    EXPECT_EQ(small.at(2, 1), glm::vec3(0.0f));  // column 4, row 3
}

}  // namespace
