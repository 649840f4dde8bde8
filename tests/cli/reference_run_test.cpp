// Passes of the path tracer are joined as independent measurements.
#include "bindings/cli/reference_run.h"

#include "bindings/scene/builtin_scenes.h"

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

TEST(ReferenceRun, errorsOfTinyAndOfHugeLightAreJoinedToo) {
    for (const float scale : {1e-30f, 1e30f}) {
        std::vector<ReferenceResult> mean{{glm::vec3(scale), glm::vec3(0.3f * scale)}};
        const std::vector<ReferenceResult> pass{{glm::vec3(scale), glm::vec3(0.4f * scale)}};
        joinPass(mean, 100, pass, 100);
        EXPECT_NEAR(mean[0].standardError.x / scale, 0.25f, 1e-6f);
    }
}

TEST(ReferenceRun, noLightAfterAFewPathsIsNotYetDarkness) {
    // A closed box whose lamp stands outside.
    Scene scene = makeBuiltinScene("furnace_box");
    scene.lights[0].light.position = glm::vec3(0.0f, 5.0f, 0.0f);
    const EmbreeScene embree(scene);
    const ReferencePoint point{{0.0f, 0.0f, 0.3f}, {0.0f, 1.0f, 0.0f}};
    ReferenceBudget budget;
    budget.targetError = 0.05;
    const ReferenceRun run = runReference(embree, std::span(&point, 1), budget, false, 1, serialFor());
    EXPECT_EQ(run.results[0].irradiance, glm::vec3(0.0f));
    EXPECT_GE(run.samplesPerPoint, 64u << 10);
}

}  // namespace
