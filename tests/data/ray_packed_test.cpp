#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "clv/data/ray_packed.h"
#include "support/chi_square.h"

using namespace clv;

namespace ray_packed_test {

using Words = std::array<uint, 8>;

Words wordsOf(const ClvRayPacked& packed) {
    Words words;
    static_assert(sizeof(words) == sizeof(packed));
    std::memcpy(words.data(), &packed, sizeof(words));
    return words;
}

ClvRayPacked packedOf(const Words& words) {
    ClvRayPacked packed;
    std::memcpy(&packed, words.data(), sizeof(packed));
    return packed;
}

float signedUnit(uint seed, uint index) { return 2.0f * test::randomUnit(seed, index) - 1.0f; }

ClvRay randomRay(uint i) {
    ClvRay ray{};
    ray.origin = vec3(signedUnit(1u, i), signedUnit(2u, i), signedUnit(3u, i)) * 1000.0f;
    ray.maxDistance = i % 3u == 0u ? kClvFar : 100.0f * test::randomUnit(4u, i);
    ray.direction = test::randomDirection(5u, i);
    ray.dynamicity = test::randomUnit(6u, i);
    float scale = std::ldexp(1.0f, int(80.0f * signedUnit(7u, i)));
    ray.flux = vec3(test::randomUnit(8u, i), test::randomUnit(9u, i), test::randomUnit(10u, i)) * scale;
    return ray;
}

TEST(RayPacked, staysWithinItsErrorBounds) {
    for (uint i = 0; i < 300000; ++i) {
        ClvRay ray = randomRay(i), back = clvUnpackRay(clvPackRay(ray));
        ASSERT_EQ(back.origin, ray.origin);
        ASSERT_EQ(back.maxDistance, ray.maxDistance);
        ASSERT_NEAR(length(back.direction), 1.0f, 1e-6f);
        ASSERT_LT(length(cross(back.direction, ray.direction)), 7e-5f);
        ASSERT_GT(dot(back.direction, ray.direction), 0.0f);
        ASSERT_NEAR(back.dynamicity, ray.dynamicity, 1.0f / 131070.0f + 1e-7f);
        float largest = std::max({ray.flux.x, ray.flux.y, ray.flux.z});
        ASSERT_EQ(std::max({back.flux.x, back.flux.y, back.flux.z}), largest);
        vec3 error = abs(back.flux - ray.flux);
        ASSERT_LE(std::max({error.x, error.y, error.z}), std::ldexp(largest, -24));
    }
}

TEST(RayPacked, directionsAlongTheAxesStayExact) {
    for (int axis = 0; axis < 3; ++axis) {
        for (float sign : {1.0f, -1.0f}) {
            ClvRay ray = randomRay(0u);
            ray.direction = vec3(0.0f);
            ray.direction[axis] = sign;
            EXPECT_EQ(clvUnpackRay(clvPackRay(ray)).direction, ray.direction);
        }
    }
}

TEST(RayPacked, packingTwiceGivesTheSameRay) {
    for (uint i = 0; i < 100000; ++i) {
        Words first = wordsOf(clvPackRay(randomRay(i))), second = wordsOf(clvPackRay(clvUnpackRay(packedOf(first))));
        first[4] = second[4] = 0u;  // the folded corners of the octahedron have two codes for one direction
        ASSERT_EQ(first, second);
    }
}

TEST(RayPacked, deadRaysStayDead) {
    ClvRay ray = randomRay(1u);
    ray.maxDistance = 0.0f;
    ray.flux = vec3(0.0f);
    ClvRay back = clvUnpackRay(clvPackRay(ray));
    EXPECT_EQ(back.maxDistance, 0.0f);
    EXPECT_EQ(back.flux, vec3(0.0f));
}

void expectUsable(const ClvRay& ray) {
    ASSERT_TRUE(clvIsFinite(ray.origin) && clvIsFinite(ray.direction) && clvIsFinite(ray.flux));
    ASSERT_TRUE(clvIsFinite(ray.maxDistance) && clvIsFinite(ray.dynamicity));
    ASSERT_NEAR(length(ray.direction), 1.0f, 1e-6f);
    ASSERT_GE(ray.maxDistance, 0.0f);
    ASSERT_TRUE(ray.dynamicity >= 0.0f && ray.dynamicity <= 1.0f);
    ASSERT_TRUE(ray.flux.x >= 0.0f && ray.flux.y >= 0.0f && ray.flux.z >= 0.0f);
}

TEST(RayPacked, anyBitsGiveAUsableRay) {
    for (uint i = 0; i < 300000; ++i) {
        Words words;
        for (uint j = 0; j < 8; ++j) words[j] = clvHashCombine(i, j);
        expectUsable(clvUnpackRay(packedOf(words)));
    }
    for (uint bits : {0u, 0xffffffffu, 0x7f800000u, 0xff800000u, 0x80000000u, 0x80008000u}) {
        Words words;
        words.fill(bits);
        expectUsable(clvUnpackRay(packedOf(words)));
    }
}

TEST(RayPacked, aRayThatIsNotFiniteComesBackUsable) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    ClvRay ray{vec3(nan), nan, vec3(nan), nan, vec3(nan), nan};
    ClvRay back = clvUnpackRay(clvPackRay(ray));
    expectUsable(back);
    EXPECT_EQ(back.maxDistance, 0.0f);
    EXPECT_EQ(back.flux, vec3(0.0f));
}

// Raise kClvRayPackedVersion and add a block below when these bits change; never edit one.
TEST(RayPacked, goldenBytesOfVersion1) {
    ASSERT_EQ(kClvRayPackedVersion, 1u);
    static_assert(std::endian::native == std::endian::little);
    ClvRay ray{};
    ray.origin = vec3(1.0f, -2.0f, 0.5f);
    ray.maxDistance = 8.0f;
    ray.direction = vec3(0.6f, 0.0f, -0.8f);
    ray.dynamicity = 0.25f;
    ray.flux = vec3(3.0f, 0.75f, 0.001f);
    EXPECT_EQ(wordsOf(clvPackRay(ray)), (Words{0x3f800000u, 0xc0000000u, 0x3f000000u, 0x41000000u, 0x49247fffu, 0x80c00000u, 0x00300000u, 0x40001062u}));
}

}  // namespace ray_packed_test
