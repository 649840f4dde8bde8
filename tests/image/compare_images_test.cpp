// Pictures that differ are told apart.
#include "bindings/image/compare_images.h"

#include <cmath>

#include <gtest/gtest.h>

namespace {

using namespace clv;

// A grey ramp with a stripe of eight pixels down its middle.
Image stripedRamp(const glm::vec3& stripe) {
    Image image(64, 36);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) image.at(x, y) = x >= 28 && x < 36 ? stripe : glm::vec3(0.2f + 0.01f * float(x));
    }
    return image;
}

TEST(CompareImages, theSamePictureHasNoErrorAndNothingThatEyesSee) {
    const Image image = stripedRamp(glm::vec3(0.4f));
    const ImageErrors errors = compareImages(image, image);
    EXPECT_EQ(errors.rms, 0.0);
    EXPECT_TRUE(std::isinf(errors.psnr));
    EXPECT_EQ(errors.perceptualFailures, 0.0);
}

TEST(CompareImages, psnrFollowsFromTheRootMeanSquareAtWhiteEqualOne) {
    const ImageErrors errors = compareImages(stripedRamp(glm::vec3(0.8f)), stripedRamp(glm::vec3(0.4f)));
    EXPECT_GT(errors.rms, 0.0);
    EXPECT_NEAR(errors.psnr, -20.0 * std::log10(errors.rms), 1e-3);
}

TEST(CompareImages, eyesSeeAStripeOfAnotherHueButNotAFaintOne) {
    const Image truth = stripedRamp(glm::vec3(0.52f));
    EXPECT_EQ(compareImages(stripedRamp(glm::vec3(0.53f, 0.52f, 0.52f)), truth).perceptualFailures, 0.0);
    EXPECT_NEAR(compareImages(stripedRamp(glm::vec3(1.5f, 0.52f, 0.52f)), truth).perceptualFailures, 8.0 / 64.0, 1.0 / 64.0);
}

}  // namespace
