// The weights and interval rules of the inject stage; the walk itself is tested with the packets that follow it (tests/cpu).
#include "clv/stages/inject.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clv/math/sampling.h"
#include "clv/math/sobol.h"
#include "clv/stages/record.h"

using namespace clv;

namespace {

TEST(Inject, aCrossingWeighsItsLengthInMetres) {
    const ClvCrossing crossing{ivec3(0), 1.25f, 2.0f, 1};
    EXPECT_FLOAT_EQ(clvCrossingWeight(kClvInjectTrackLength, crossing, 0.5f), 0.375f);
}

TEST(Inject, theThesisWeighsEveryCellOneButTheFirst) {
    EXPECT_EQ(clvCrossingWeight(kClvInjectThesis, ClvCrossing{ivec3(0), 1.0f, 1.1f, 0}, 0.5f), 1.0f);
    EXPECT_EQ(clvCrossingWeight(kClvInjectThesis, ClvCrossing{ivec3(0), 0.0f, 1.1f, 1}, 0.5f), 0.0f);
}

TEST(Inject, aSlabIsTheIntervalBetweenItsPlanes) {
    EXPECT_EQ(clvWalkSlab(-1.0f, 0.5f, 2.0f, 4.0f), vec2(2.0f, 10.0f));
    EXPECT_EQ(clvWalkSlab(5.0f, -0.5f, -2.0f, 4.0f), vec2(2.0f, 10.0f));
}

TEST(Inject, aParallelRayIsInItsSlabForEverOrNever) {
    for (float direction : {0.0f, 1e-30f, -1e-30f}) {
        const float inverse = clvWalkInverse(direction);
        EXPECT_EQ(inverse, 1.0f);
        EXPECT_EQ(clvWalkSlab(2.0f, direction, inverse, 4.0f), vec2(-kClvNever, kClvNever));
        EXPECT_EQ(clvWalkSlab(0.0f, direction, inverse, 4.0f), vec2(-kClvNever, kClvNever));
        const vec2 outside = clvWalkSlab(-0.5f, direction, inverse, 4.0f);
        EXPECT_GT(outside.x, outside.y);
        EXPECT_EQ(clvWalkFirstBoundary(direction, 2), kClvNever);
    }
}

TEST(Inject, theFirstBoundaryLiesAhead) {
    EXPECT_EQ(clvWalkFirstBoundary(0.1f, 2), 3.0f);
    EXPECT_EQ(clvWalkFirstBoundary(-0.1f, 2), 2.0f);
}

// However many rays add to a float, and however many of those floats are added up.
TEST(Inject, sumsOfTheMostThatRaysAddAreFinite) {
    for (float start : {1.0f, 0x1p23f, 0x1p24f, 0x1p25f - 4.0f}) {
        float sum = start * kClvMostDeposit;
        for (int k = 0; k < 1000; ++k) sum += kClvMostDeposit;
        EXPECT_LE(sum, 0x1p25f * kClvMostDeposit);
    }
    EXPECT_TRUE(std::isfinite(4096.0f * (0x1p25f * kClvMostDeposit)));
    for (float cellSize : {1e-9f, 0.5f, 1e5f}) EXPECT_LE(clvMostFlux(kClvInjectTrackLength, cellSize) * clvLargestDeposit(kClvInjectTrackLength, 1u, cellSize), kClvMostDeposit * 1.000001f);
    EXPECT_EQ(clvMostFlux(kClvInjectThesis, 0.5f), kClvMostDeposit);
}

TEST(Inject, fluxBeyondTheMostIsCutOffChannelByChannel) {
    ClvRay ray{};
    ray.direction = vec3(0.0f, 1.0f, 0.0f), ray.flux = vec3(3e38f, -3e38f, 5.0f);
    EXPECT_EQ(clvChannelFlux(3, ray, 100.0f), vec3(100.0f, -100.0f, 5.0f));
    ray.flux = vec3(3e38f);
    EXPECT_FLOAT_EQ(clvChannelFlux(1, ray, 100.0f).x, 100.0f);
}

TEST(Inject, aRayWhoseDirectionIsNotOfUnitLengthCarriesNothing) {
    ClvRay ray{};
    ray.flux = vec3(1.0f);
    for (const vec3& direction : {vec3(0.0f), vec3(1e-30f), vec3(1e30f, 0.0f, 0.0f), vec3(0.0f, 2.1f, 0.0f), vec3(0.0f, 0.0f, 0.4f)}) {
        ray.direction = direction;
        EXPECT_EQ(clvChannelFlux(3, ray, 100.0f), vec3(0.0f)) << direction.x;
    }
    ray.direction = vec3(0.999f, 0.0f, 0.0f);
    EXPECT_EQ(clvChannelFlux(3, ray, 100.0f), vec3(1.0f));
}

TEST(Inject, aDimRayIsNotLostInARecord) {
    ClvRay ray{};
    ray.direction = vec3(0.0f, 1.0f, 0.0f), ray.flux = vec3(1e-30f);
    EXPECT_EQ(clvRecordValue(clvRecordOfRay(kClvStorageCube, 1, ray, ray.direction, 100.0f), 1, 3), 1e-30f);
}

TEST(Inject, aFixedPointScaleExistsForAnyFlux) {
    for (float flux : {0.0f, 1e-38f, 1.0f, 3e38f}) {
        const float scale = clvFixedScale(flux, 1u << 30, clvLargestDeposit(kClvInjectTrackLength, 0u, 1e5f));
        EXPECT_TRUE(std::isfinite(scale) && scale > 0.0f && std::isfinite(1.0f / scale)) << flux;
    }
}

// Through the middle of a cell in any direction: no coefficient gets more than the bound, and some get all of it.
TEST(Inject, noDepositExceedsTheLargest) {
    const float side = 0.5f;
    ClvVolume volume{};
    volume.cellSize = side, volume.resolution = ivec3(1);
    // Along the grid, and with an axis along the cell's diagonal.
    const mat3 axes[2] = {mat3(1.0f), glm::transpose(mat3(normalize(vec3(1.0f)), normalize(vec3(1.0f, -1.0f, 0.0f)), normalize(vec3(1.0f, 1.0f, -2.0f))))};
    float largest[2] = {};
    for (std::uint32_t i = 0; i < 4096; ++i) {
        const vec4 u = clvSobol4(i, 5);
        ClvRay ray{};
        ray.direction = i < 3 ? vec3(i == 0, i == 1, i == 2) : i == 3 ? normalize(vec3(1.0f)) : clvSphereFromSquare(vec2(u.x, u.y));
        ray.origin = vec3(0.5f * side) - ray.direction, ray.maxDistance = kClvFar, ray.flux = vec3(1.0f);
        ClvWalk walk = clvWalkBegin(volume, ray);
        const float length = clvCrossingWeight(kClvInjectTrackLength, clvWalkStep(walk, ray.direction), side);
        for (const uint storage : {kClvStorageCube9, kClvStorageCube, kClvStorageSh1, kClvStorageSh2}) {
            for (int turned = 0; turned < 2; ++turned) {
                const ClvRecord record = clvRecordOfRay(storage, 1, ray, axes[turned] * ray.direction, clvMostFlux(kClvInjectTrackLength, side));
                for (uint k = 0; k < clvCoefficientCount(storage); ++k) largest[turned] = std::max(largest[turned], std::abs(clvRecordValue(record, 1, k)) * length);
            }
        }
    }
    for (uint turned = 0; turned < 2; ++turned) EXPECT_NEAR(largest[turned], clvLargestDeposit(kClvInjectTrackLength, turned, side), 1e-6f) << turned;
}

TEST(Inject, fixedPointHoldsTheLargestSumsAndUsesTheIntegers) {
    for (const uint rays : {1u, 1000u, 1u << 20}) {
        const float flux = 3.0f, deposit = 0.25f, scale = clvFixedScale(flux, rays, deposit);
        const double sum = double(rays) * (double(flux) * deposit * scale + 0.5);
        EXPECT_LT(sum, 2147483647.0);
        EXPECT_GT(sum, 0.99 * 2147483647.0);
        EXPECT_EQ(clvFixedFromFloat(-0.3f / scale, scale), 0);
        EXPECT_EQ(clvFixedFromFloat(-0.7f / scale, scale), -1);
    }
}

}  // namespace
