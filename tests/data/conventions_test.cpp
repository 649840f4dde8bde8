// Conversions to and from the axes and depths of engines.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "clv/data/engine_space.h"

using namespace clv;

namespace {

const vec3 kSamples[] = {{1.0f, 2.0f, 3.0f}, {-4.0f, 0.5f, 7.0f}, {0.0f, -1.0f, 0.25f}};
const vec3 kX(1.0f, 0.0f, 0.0f), kY(0.0f, 1.0f, 0.0f), kZ(0.0f, 0.0f, 1.0f);

// +1 where the map keeps handedness, -1 where it mirrors.
float handedness(vec3 (*map)(vec3)) { return dot(cross(map(kX), map(kY)), map(kZ)); }

TEST(EngineSpace, upAndAheadOfEachEngineArriveAtTheLibrarysUpAndAhead) {
    EXPECT_EQ(clvFromZUp(kZ), kY);
    EXPECT_EQ(clvFromZUp(kY), -kZ);
    EXPECT_EQ(clvFromZUp(kX), kX);
    EXPECT_EQ(clvMirrorZ(kY), kY);
    EXPECT_EQ(clvMirrorZ(kZ), -kZ);
    EXPECT_EQ(clvFromLeftHandedZUp(kZ), kY);
    EXPECT_EQ(clvFromLeftHandedZUp(kX), -kZ);
    EXPECT_EQ(clvFromLeftHandedZUp(kY), kX);
}

TEST(EngineSpace, conversionsRoundTripExactly) {
    for (vec3 v : kSamples) {
        EXPECT_EQ(clvToZUp(clvFromZUp(v)), v);
        EXPECT_EQ(clvMirrorZ(clvMirrorZ(v)), v);
        EXPECT_EQ(clvToLeftHandedZUp(clvFromLeftHandedZUp(v)), v);
    }
}

TEST(EngineSpace, onlyLeftHandedSpacesAreMirrored) {
    EXPECT_EQ(handedness(clvFromZUp), 1.0f);
    EXPECT_EQ(handedness(clvMirrorZ), -1.0f);
    EXPECT_EQ(handedness(clvFromLeftHandedZUp), -1.0f);
}

class Depth : public testing::TestWithParam<float> {};

TEST_P(Depth, distanceAheadComesBackFromTheDepthThatGlmsProjectionsWrite) {
    const float near = 0.1f, far = 500.0f, ahead = GetParam();
    const float tolerance = 2e-7f * far / near * ahead;  // a depth buffer's own resolution at this distance
    glm::vec4 p(0.0f, 0.0f, -ahead, 1.0f);
    glm::vec4 standard = glm::perspectiveRH_ZO(1.0f, 1.5f, near, far) * p;
    glm::vec4 reversed = glm::perspectiveRH_ZO(1.0f, 1.5f, far, near) * p;
    glm::vec4 signedDepth = glm::perspectiveRH_NO(1.0f, 1.5f, near, far) * p;
    EXPECT_NEAR(clvAheadFromDepth(standard.z / standard.w, near, far), ahead, tolerance * ahead / far);
    EXPECT_NEAR(clvAheadFromDepth(reversed.z / reversed.w, far, near), ahead, 1e-5f * ahead);
    EXPECT_NEAR(clvAheadFromDepth(clvDepthFromSignedDepth(signedDepth.z / signedDepth.w), near, far), ahead, 2.0f * tolerance * ahead / far);
    EXPECT_NEAR(clvAheadFromInfiniteReversedDepth(near / ahead, near), ahead, 1e-6f * ahead);
    EXPECT_NEAR(clvDepthFromAhead(ahead, near, far), standard.z / standard.w, 1e-6f);
    EXPECT_NEAR(clvAheadFromDepth(clvDepthFromAhead(ahead, far, near), far, near), ahead, 1e-5f * ahead);
}

INSTANTIATE_TEST_SUITE_P(distances, Depth, testing::Values(0.1f, 0.5f, 3.0f, 40.0f, 499.0f));

TEST(EngineSpace, viewPositionIsWhatTheInverseProjectionGives) {
    const float yfov = 0.9f, aspect = 16.0f / 9.0f, near = 0.1f, far = 100.0f;
    const vec2 tanHalfFov(std::tan(0.5f * yfov) * aspect, std::tan(0.5f * yfov));
    glm::mat4 projection = glm::perspectiveRH_ZO(yfov, aspect, near, far);
    for (vec3 view : {vec3(0.3f, -0.2f, -1.0f), vec3(-7.0f, 3.0f, -20.0f)}) {
        glm::vec4 clip = projection * glm::vec4(view, 1.0f);
        vec2 ndc = vec2(clip) / clip.w;
        EXPECT_NEAR(length(clvNdcFromViewPosition(view, tanHalfFov) - ndc), 0.0f, 1e-6f);
        EXPECT_NEAR(length(clvViewPositionFromNdc(ndc, clip.w, tanHalfFov) - view), 0.0f, 1e-5f * length(view));
    }
}

}  // namespace
