// Passes of the path tracer are joined as independent measurements.
#include "bindings/cli/reference_run.h"

#include <gtest/gtest.h>

namespace {

using namespace clv;

TEST(ReferenceRun, passesAreWeightedByTheirSamples) {
    std::vector<ReferenceResult> mean = {{glm::vec3(1.0f), glm::vec3(0.3f)}};
    const std::vector<ReferenceResult> pass = {{glm::vec3(5.0f), glm::vec3(0.4f)}};
    joinPass(mean, 300, pass, 100);
    EXPECT_NEAR(mean[0].irradiance.x, 2.0f, 1e-6f);
    // sqrt((0.75 * 0.3)^2 + (0.25 * 0.4)^2)
    EXPECT_NEAR(mean[0].standardError.y, 0.24622145f, 1e-6f);
}

TEST(ReferenceRun, standardErrorsAreRelativeToTheMeanIrradiance) {
    const std::vector<ReferenceResult> results = {{{4, 2, 0}, {0.1f, 0.1f, 0.1f}}, {{2, 2, 2}, {0.3f, 0.3f, 0.3f}}};
    EXPECT_NEAR(relativeStandardError(results), std::sqrt(0.05) / 2.0, 1e-7);
    EXPECT_NEAR(meanStandardError(results), 0.2, 1e-7);
}

}  // namespace
