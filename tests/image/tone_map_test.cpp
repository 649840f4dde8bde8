// Tone mapping keeps hue and order, and finds its exposure by itself.
#include "bindings/image/tone_map.h"

#include <gtest/gtest.h>

namespace {

using namespace clv;

TEST(ToneMap, autoExposureBringsAnEvenPictureToMiddleGrey) {
    const Image even(4, 4, glm::vec3(250.0f));
    EXPECT_NEAR(autoExposure(even).scale * 250.0f, 0.18f, 1e-5f);
    EXPECT_EQ(autoExposure(even).white, 1.0f);
}

TEST(ToneMap, autoExposureIgnoresBlackAndTakesTheGeometricMean) {
    Image image(3, 1);
    image.at(0, 0) = glm::vec3(1.0f);
    image.at(1, 0) = glm::vec3(100.0f);
    EXPECT_NEAR(autoExposure(image).scale, 0.018f, 1e-6f);
    EXPECT_EQ(autoExposure(Image(2, 2)).scale, 1.0f);
}

TEST(ToneMap, autoExposureMakesTheBrightestPixelWhite) {
    Image image(100, 1, glm::vec3(1.0f));
    image.at(0, 0) = glm::vec3(1000.0f);
    const Image mapped = toneMap(image, autoExposure(image));
    EXPECT_NEAR(mapped.at(0, 0).x, 1.0f, 1e-5f);
    EXPECT_LT(mapped.at(1, 0).x, 0.18f);
}

TEST(ToneMap, whiteBecomesOneAndSmallValuesHardlyChange) {
    Image image(2, 1);
    image.at(0, 0) = glm::vec3(2.0f);
    image.at(1, 0) = glm::vec3(5e-4f);
    const Image mapped = toneMap(image, {2.0f, 4.0f});
    EXPECT_NEAR(mapped.at(0, 0).x, 1.0f, 1e-6f);
    EXPECT_NEAR(mapped.at(1, 0).x, 1e-3f, 2e-6f);
}

TEST(ToneMap, channelsKeepTheirRatios) {
    Image image(1, 1, glm::vec3(4.0f, 2.0f, 1.0f));
    const glm::vec3 mapped = toneMap(image, {1.0f, 4.0f}).at(0, 0);
    EXPECT_NEAR(mapped.x / mapped.z, 4.0f, 1e-5f);
    EXPECT_NEAR(mapped.y / mapped.z, 2.0f, 1e-5f);
}

TEST(ToneMap, brighterStaysBrighter) {
    Image ramp(200, 1);
    for (int x = 0; x < ramp.width; ++x) ramp.at(x, 0) = glm::vec3(0.05f * float(x));
    const Image mapped = toneMap(ramp, {1.0f, 4.0f});
    for (int x = 1; x < ramp.width; ++x) EXPECT_GT(mapped.at(x, 0).x, mapped.at(x - 1, 0).x);
}

}  // namespace
