#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "clv/stages/rsm.h"
#include "support/chi_square.h"

namespace clv::test {
namespace {

const vec3 kLo(-3.0f, 0.5f, 2.0f), kHi(4.0f, 6.0f, 11.0f);
constexpr double kSignificance = 1e-3;

ClvLight makeLight(uint type) {
    ClvLight light{};
    light.type = type;
    light.position = vec3(1.0f, 2.0f, 3.0f);
    light.direction = glm::normalize(vec3(0.3f, -0.8f, 0.5f));
    light.intensity = vec3(1.0f, 2.0f, 4.0f);
    light.innerConeAngle = 0.4f;
    light.outerConeAngle = 0.9f;
    light.dynamicity = 0.25f;
    return light;
}

// Mean flux over the map: the light's whole flux, if its rays stand for the right share each.
glm::dvec3 meanFlux(const ClvLight& light, int resolution) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < resolution; ++y) {
        for (int x = 0; x < resolution; ++x) {
            sum += glm::dvec3(clvLightRay(light, vec2((x + 0.5f) / resolution, (y + 0.5f) / resolution), kLo, kHi).flux);
        }
    }
    return sum / double(resolution * resolution);
}

TEST(Rsm, samplePointStaysInItsTexelInEveryPass) {
    for (uint pass = 0; pass < 64; ++pass) {
        for (uvec2 texel : {uvec2(0, 0), uvec2(7, 3), uvec2(12, 12)}) {
            const vec2 u = clvRsmSamplePoint(texel, 13, pass, 5) * 13.0f;
            EXPECT_EQ(uint(u.x), texel.x);
            EXPECT_EQ(uint(u.y), texel.y);
        }
    }
}

TEST(Rsm, passesSpreadOverTheTexel) {
    // 16 passes are a (0, 4, 2)-net: one in each sixteenth of the texel, in slices of any of these shapes.
    for (glm::ivec2 shape : {glm::ivec2(16, 1), glm::ivec2(4, 4), glm::ivec2(1, 16)}) {
        std::vector<int> count(16, 0);
        for (uint pass = 0; pass < 16; ++pass) {
            const vec2 u = clvRsmSamplePoint(uvec2(0, 0), 1, pass, 9);
            ++count[int(u.y * float(shape.y)) * shape.x + int(u.x * float(shape.x))];
        }
        EXPECT_EQ(count, std::vector<int>(16, 1)) << shape.x << " x " << shape.y;
    }
}

TEST(Rsm, samplePointsDifferBetweenTexelsAndSeeds) {
    const vec2 inTexel = fract(clvRsmSamplePoint(uvec2(3, 3), 8, 0, 1) * 8.0f);
    EXPECT_NE(inTexel, fract(clvRsmSamplePoint(uvec2(3, 4), 8, 0, 1) * 8.0f));
    EXPECT_NE(inTexel, fract(clvRsmSamplePoint(uvec2(3, 3), 8, 0, 2) * 8.0f));
}

TEST(Rsm, capComesBackThroughItsSquare) {
    const vec3 axis = randomDirection(11, 0);
    for (float capHeight : {1e-4f, 0.3f, 1.0f, 1.8f}) {
        for (uint i = 0; i < 1000; ++i) {
            const vec2 u(randomUnit(12, 2 * i), randomUnit(12, 2 * i + 1));
            const vec3 direction = clvCapFromSquare(u, axis, capHeight);
            EXPECT_NEAR(glm::length(direction), 1.0f, 1e-6f);
            // A direction is known to 1e-7 rad: the narrower the cap, the coarser is that in its square.
            EXPECT_LT(glm::length(clvSquareFromCap(direction, axis, capHeight) - u), 2e-6f / std::sqrt(capHeight)) << capHeight;
        }
    }
}

TEST(Rsm, capIsUniformBySolidAngle) {
    constexpr int kHeights = 9, kTurns = 9, kSamples = 100000;
    const vec3 axis = randomDirection(13, 1);
    vec3 tangent, bitangent;
    clvBasis(axis, tangent, bitangent);
    for (float capHeight : {0.05f, 1.0f, 2.0f}) {
        std::vector<double> counts(kHeights * kTurns, 0.0);
        for (uint i = 0; i < kSamples; ++i) {
            const vec3 d = clvCapFromSquare(vec2(randomUnit(14, 2 * i), randomUnit(14, 2 * i + 1)), axis, capHeight);
            const double height = (1.0 - glm::dot(glm::dvec3(d), glm::dvec3(axis))) / capHeight;
            const double turn = std::atan2(dot(d, bitangent), dot(d, tangent)) / (2.0 * M_PI) + 0.5;
            ++counts[std::clamp(int(height * kHeights), 0, kHeights - 1) * kTurns + std::clamp(int(turn * kTurns), 0, kTurns - 1)];
        }
        const std::vector<double> expected(counts.size(), double(kSamples) / double(counts.size()));
        EXPECT_GT(chiSquareChance(counts, expected), kSignificance) << capHeight;
    }
}

TEST(Rsm, pointLightIsUniformOverTheSphere) {
    constexpr int kHeights = 9, kTurns = 9, kSamples = 100000;
    std::vector<double> counts(kHeights * kTurns, 0.0);
    for (uint i = 0; i < kSamples; ++i) {
        const vec3 d = clvLightRay(makeLight(kClvLightPoint), vec2(randomUnit(15, 2 * i), randomUnit(15, 2 * i + 1)), vec3(-5.0f), vec3(5.0f)).direction;
        const double turn = std::atan2(d.x, d.z) / (2.0 * M_PI) + 0.5;
        ++counts[std::min(int((0.5 + 0.5 * d.y) * kHeights), kHeights - 1) * kTurns + std::min(int(turn * kTurns), kTurns - 1)];
    }
    const std::vector<double> expected(counts.size(), double(kSamples) / double(counts.size()));
    EXPECT_GT(chiSquareChance(counts, expected), kSignificance);
}

TEST(Rsm, pointLightSendsItsIntensityOverTheWholeSphere) {
    const glm::dvec3 flux = meanFlux(makeLight(kClvLightPoint), 8);
    EXPECT_NEAR(flux.x, 4.0 * M_PI, 1e-5);
    EXPECT_NEAR(flux.y, 8.0 * M_PI, 2e-5);
}

TEST(Rsm, spotLightSendsTheFluxOfItsFalloff) {
    for (float outer : {0.06f, 0.9f, float(0.5 * M_PI)}) {
        ClvLight light = makeLight(kClvLightSpot);
        light.outerConeAngle = outer;
        light.innerConeAngle = 0.4f * outer;
        // The integral of ((c - c_out) / (c_in - c_out))^2 over the ramp is a third of it; inside the inner cone it is 1.
        const double inner = std::cos(light.innerConeAngle), ramp = inner - std::cos(double(outer));
        const double expected = 2.0 * M_PI * (ramp / 3.0 + 1.0 - inner);
        EXPECT_NEAR(meanFlux(light, 256).x / expected, 1.0, 1e-3) << outer;
    }
}

TEST(Rsm, spotRaysFillTheOuterConeAndNoMore) {
    const ClvLight light = makeLight(kClvLightSpot);
    // The map's edge is the cone's.
    EXPECT_NEAR(dot(clvLightRay(light, vec2(0.0f, 0.5f), kLo, kHi).direction, light.direction), std::cos(light.outerConeAngle), 1e-6f);
    for (uint i = 0; i < 1000; ++i) {
        const ClvRay ray = clvLightRay(light, vec2(randomUnit(16, 2 * i), randomUnit(16, 2 * i + 1)), kLo, kHi);
        EXPECT_GE(dot(ray.direction, light.direction), std::cos(light.outerConeAngle) - 1e-6f);
        EXPECT_EQ(ray.origin, light.position);
    }
}

TEST(Rsm, raysFromAfarBeginBeforeTheSceneAndSpreadOverIt) {
    const vec3 center = 0.5f * (kLo + kHi);
    const float radius = 0.5f * length(kHi - kLo);
    for (const float distance : {3.0f * radius, 1e4f, 1e8f}) {
        ClvLight light = makeLight(kClvLightPoint);
        const vec3 axis = glm::normalize(vec3(0.2f, -0.9f, 0.4f));
        light.position = center - axis * distance;
        double across = 0.0;
        for (uint i = 0; i < 1000; ++i) {
            const ClvRay ray = clvLightRay(light, vec2(randomUnit(18, 2 * i), randomUnit(18, 2 * i + 1)), kLo, kHi);
            EXPECT_GE(length(ray.origin - center), 0.999f * radius);
            EXPECT_LE(length(ray.origin - center), 3.0f * radius);
            EXPECT_GT(dot(center - ray.origin, axis), 0.999f * radius);
            // It passes through the light.
            const vec3 away = ray.origin - light.position;
            EXPECT_LE(length(away - ray.direction * dot(away, ray.direction)), 1e-6f * distance);
            const vec3 met = ray.origin + ray.direction * (dot(center - ray.origin, axis) / dot(ray.direction, axis));
            across += dot(met - center, met - center) / (1000.0 * radius * radius);
        }
        // Half of the square of the cap's radius, which is a hundredth wider than the sphere seen from there.
        EXPECT_NEAR(across, 0.51, distance > 100.0f ? 0.03 : 0.1) << distance;
    }
}

TEST(Rsm, directionalRaysStartOutsideTheBoundsAndCoverThem) {
    const ClvLight light = makeLight(kClvLightDirectional);
    vec3 tangent, bitangent;
    clvBasis(light.direction, tangent, bitangent);
    vec2 reachLo(1e9f), reachHi(-1e9f);
    for (vec2 u : {vec2(0, 0), vec2(1, 1)}) {
        const ClvRay ray = clvLightRay(light, u, kLo, kHi);
        reachLo = min(reachLo, vec2(dot(ray.origin, tangent), dot(ray.origin, bitangent)));
        reachHi = max(reachHi, vec2(dot(ray.origin, tangent), dot(ray.origin, bitangent)));
    }
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p(corner & 1 ? kHi.x : kLo.x, corner & 2 ? kHi.y : kLo.y, corner & 4 ? kHi.z : kLo.z);
        EXPECT_GT(dot(p - clvLightRay(light, vec2(0.5f, 0.5f), kLo, kHi).origin, light.direction), 0.0f);
        EXPECT_GE(dot(p, tangent), reachLo.x - 1e-5f);
        EXPECT_LE(dot(p, tangent), reachHi.x + 1e-5f);
        EXPECT_GE(dot(p, bitangent), reachLo.y - 1e-5f);
        EXPECT_LE(dot(p, bitangent), reachHi.y + 1e-5f);
    }
    const vec2 size = reachHi - reachLo;
    EXPECT_NEAR(meanFlux(light, 4).y / (2.0 * size.x * size.y), 1.0, 1e-5);
}

TEST(Rsm, directionalRaysStartBeforeAFlatScene) {
    ClvLight light = makeLight(kClvLightDirectional);
    light.direction = vec3(0, -1, 0);
    EXPECT_GT(clvLightRay(light, vec2(0.5f, 0.5f), vec3(-1, 0, -1), vec3(1, 0, 1)).origin.y, 0.0f);
}

TEST(Rsm, texelCarriesTheReflectedShareOfItsRay) {
    const ClvRay ray = clvLightRay(makeLight(kClvLightPoint), vec2(0.3f, 0.4f), kLo, kHi);
    const ClvHit hit{.normal = vec3(0, 1, 0), .distance = 2.0f, .albedo = vec3(0.5f, 0.25f, 0.0f), .primitive = 7};
    const ClvRsmTexel texel = clvRsmTexelFromHit(ray, hit, 0.125f);
    EXPECT_EQ(texel.valid, 1u);
    EXPECT_EQ(texel.position, ray.origin + ray.direction * 2.0f);
    EXPECT_EQ(texel.normal, hit.normal);
    EXPECT_EQ(texel.dynamicity, 0.25f);
    EXPECT_EQ(texel.flux, ray.flux * vec3(0.5f, 0.25f, 0.0f) * 0.125f);
}

TEST(Rsm, texelThatMetNothingIsNotValidAndCarriesNothing) {
    const ClvRay ray = clvLightRay(makeLight(kClvLightPoint), vec2(0.3f, 0.4f), kLo, kHi);
    const ClvHit nothing{.normal = vec3(0.0f), .distance = kClvFar, .albedo = vec3(0.0f), .primitive = 0xffffffffu};
    const ClvRsmTexel texel = clvRsmTexelFromHit(ray, nothing, 0.125f);
    EXPECT_EQ(texel.valid, 0u);
    EXPECT_EQ(texel.flux, vec3(0.0f));
    EXPECT_TRUE(std::isfinite(texel.position.x));
}

}  // namespace
}  // namespace clv::test
