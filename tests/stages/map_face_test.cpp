// Pictures of what a light sees: every ray of its map is in one of them, where its points are drawn.
#include <gtest/gtest.h>

#include "clv/plan/map_faces.h"

using namespace clv;

namespace {

constexpr uint kSide = 64;
const vec3 kLo(-3.0f, -1.0f, 2.0f), kHi(2.0f, 4.0f, 5.0f);

ClvLight lightOf(uint type, float outerConeAngle = 0.7f) {
    ClvLight light{};
    light.type = type;
    light.position = vec3(-0.5f, 1.0f, 3.0f), light.direction = normalize(vec3(0.3f, -1.0f, 0.2f));
    light.outerConeAngle = outerConeAngle, light.innerConeAngle = 0.5f * outerConeAngle;
    light.intensity = vec3(1.0f);
    return light;
}

// Point lights, cones of all widths and parallel light.
std::vector<ClvLight> allLights() {
    return {lightOf(kClvLightPoint), lightOf(kClvLightSpot, 0.1f), lightOf(kClvLightSpot, kWidestFace), lightOf(kClvLightSpot, 0.5f * kClvPi), lightOf(kClvLightDirectional)};
}

TEST(MapFaces, areAsManyAsALightNeeds) {
    std::vector<uint> counts(5);
    const std::vector<ClvLight> lights = allLights();
    uint last = 0;
    for (const ClvMapFace& face : mapFaces(lights, kLo, kHi, kSide)) {
        EXPECT_GE(face.light, last);
        last = face.light;
        ++counts.at(face.light);
    }
    EXPECT_EQ(counts, (std::vector<uint>{6, 1, 1, 5, 1}));
}

TEST(MapFaces, holdEveryRayOfALightAtTheTexelWhereItsPointsAreDrawn) {
    const std::vector<ClvLight> lights = allLights();
    const std::vector<ClvMapFace> faces = mapFaces(lights, kLo, kHi, kSide);
    for (uint k = 0; k < lights.size(); ++k) {
        for (uint i = 0; i < 4096; ++i) {
            const ClvRay ray = clvLightRay(lights[k], vec2((float(i % 64) + 0.5f) / 64.0f, (float(i / 64) + 0.5f) / 64.0f), kLo, kHi);
            int seen = 0;
            for (const ClvMapFace& face : faces) {
                const vec2 place = clvFaceTexel(face, ray, kSide);
                if (face.light != k || place.x < 0.0f) continue;
                ++seen;
                // The texels around it are in the picture.
                EXPECT_GE(std::min(place.x, place.y), 0.7f);
                EXPECT_LE(std::max(place.x, place.y), kSide - 0.7f);
                for (const float distance : {0.7f, 2.0f}) {
                    const vec4 clip = clvFacePosition(face, ray.origin + ray.direction * distance);
                    EXPECT_NEAR((0.5f + 0.5f * clip.x / clip.w) * kSide, place.x, 1e-3f);
                    EXPECT_NEAR((0.5f - 0.5f * clip.y / clip.w) * kSide, place.y, 1e-3f);
                    EXPECT_GT(clip.z, 0.0f);
                    EXPECT_LT(clip.z, clip.w);
                }
                const vec4 near = clvFacePosition(face, ray.origin + ray.direction * 0.7f), far = clvFacePosition(face, ray.origin + ray.direction * 0.71f);
                EXPECT_GT(near.z / near.w, far.z / far.w);
            }
            ASSERT_GE(seen, 1) << k << " " << i;
        }
    }
}

TEST(MapFaces, moveRaysToTheMiddleOfATexel) {
    const std::vector<ClvLight> lights = allLights();
    for (const ClvMapFace& face : mapFaces(lights, kLo, kHi, kSide)) {
        const ClvRay ray = clvFaceRay(face, clvLightRay(lights[face.light], vec2(0.5f), kLo, kHi), uvec2(3, 60), uvec2(kSide));
        const vec2 place = clvFaceTexel(face, ray, kSide);
        EXPECT_NEAR(place.x, 3.5f, 1e-3f);
        EXPECT_NEAR(place.y, 60.5f, 1e-3f);
        EXPECT_NEAR(length(ray.direction), 1.0f, 1e-6f);
    }
}

TEST(MapFaces, holdAFlatScene) {
    const std::vector<ClvLight> lights{lightOf(kClvLightDirectional)};
    for (const ClvMapFace& face : mapFaces(lights, kLo, vec3(kHi.x, kLo.y, kLo.z), kSide)) {
        EXPECT_TRUE(std::isfinite(dot(face.right, face.up)));
        const vec4 clip = clvFacePosition(face, kLo);
        EXPECT_GT(clip.z, 0.0f);
        EXPECT_LT(clip.z, 1.0f);
    }
}

}  // namespace
