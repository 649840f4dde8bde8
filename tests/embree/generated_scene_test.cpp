// Scenes made up from a seed: each is whole, lit and seen, no two are alike.
#include <gtest/gtest.h>

#include <set>

#include "bindings/embree/direct_light.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/generated_scene.h"

namespace clv::test {
namespace {

constexpr std::uint32_t kSeeds = 60;

TEST(GeneratedScene, isTheSameForTheSameSeed) {
    const Scene a = makeGeneratedScene(4), b = makeGeneratedScene(4);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.lights.size(), b.lights.size());
}

TEST(GeneratedScene, differsFromSeedToSeed) {
    std::set<std::size_t> triangles;
    std::set<float> sizes, albedos;
    std::set<uint> lights;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const Scene scene = makeGeneratedScene(seed);
        triangles.insert(scene.triangles.size());
        sizes.insert(scene.bounds.extent().x);
        albedos.insert(scene.materials.front().albedo.x);
        lights.insert(scene.lights.front().light.type);
    }
    EXPECT_GT(triangles.size(), kSeeds / 2);
    EXPECT_EQ(sizes.size(), kSeeds);
    EXPECT_EQ(albedos.size(), kSeeds);
    EXPECT_EQ(lights, (std::set<uint>{kClvLightPoint, kClvLightSpot, kClvLightDirectional}));
}

TEST(GeneratedScene, isWholeForAnySeed) {
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const Scene scene = makeGeneratedScene(seed);
        EXPECT_EQ(scene.droppedTriangles, 0u) << seed;
        for (const Material& material : scene.materials) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_GT(material.albedo[c], 0.0f) << seed;
                EXPECT_LT(material.albedo[c], 1.0f) << seed;
            }
        }
        for (const glm::vec3& p : scene.positions) {
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, scene.bounds.lo)) && glm::all(glm::lessThanEqual(p, scene.bounds.hi))) << seed;
        }
        for (const Camera& camera : scene.cameras) {
            EXPECT_LT(glm::length(camera.position - scene.bounds.center()), 0.5f * glm::length(scene.bounds.extent())) << seed;
        }
    }
}

TEST(GeneratedScene, showsItsCamerasSurfacesThatItsLampsLight) {
    constexpr std::size_t kPoints = 1000;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const Scene scene = makeGeneratedScene(seed);
        const EmbreeScene embree(scene);
        const auto points = visiblePoints(embree, kPoints, 1);
        ASSERT_EQ(points.size(), kPoints) << seed;
        std::size_t lit = 0;
        for (const ClvReceiver& p : points) {
            for (const NamedLight& named : scene.lights) {
                const DirectLight direct = directLightAt(named.light, p.position);
                const glm::vec3 from = p.position + p.normal * embree.surfaceOffset();
                if (dot(direct.towardsLight, p.normal) > 0.0f && direct.irradiance.x > 0.0f &&
                    !embree.occluded(from, direct.towardsLight, direct.distance)) {
                    ++lit;
                    break;
                }
            }
        }
        EXPECT_GT(lit, 0u) << seed;
    }
}

}  // namespace
}  // namespace clv::test
