#include "bindings/embree/embree_scene.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "clv/math/sampling.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

// A square in the plane z = 0, front towards +z, grey.
Scene squareScene() {
    SmallScene scene;
    scene.rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, scene.material(glm::vec3(0.25f, 0.5f, 0.75f)));
    return scene.finish();
}

TEST(EmbreeScene, traceCutsARayAtItsFirstHit) {
    const Scene scene = squareScene();
    const EmbreeScene embree(scene);
    std::vector<ClvRay> rays{rayAlong({0.3f, 0.2f, 2.0f}, {0, 0, -1})};
    embree.trace(rays);
    EXPECT_FLOAT_EQ(rays[0].maxDistance, 2.0f);
    EXPECT_EQ(rays[0].origin, glm::vec3(0.3f, 0.2f, 2.0f));
    EXPECT_EQ(rays[0].flux, glm::vec3(1.0f));
}

TEST(EmbreeScene, traceLeavesRaysThatMeetNothingAsTheyAre) {
    const Scene scene = squareScene();
    const EmbreeScene embree(scene);
    std::vector<ClvRay> rays{rayAlong({0, 0, 2}, {0, 0, 1}), rayAlong({0, 0, 2}, {0, 0, -1}, 1.5f)};
    std::vector<ClvRay> judged = rays;
    std::vector<ClvHit> hits(2);
    embree.trace(rays);
    embree.trace(judged, hits);
    for (const std::vector<ClvRay>& traced : {rays, judged}) {
        EXPECT_EQ(traced[0].maxDistance, kClvFar);
        EXPECT_EQ(traced[1].maxDistance, 1.5f);
    }
    for (const ClvHit& hit : hits) {
        EXPECT_EQ(hit.distance, kClvFar);
        EXPECT_EQ(hit.normal, glm::vec3(0.0f));
        EXPECT_EQ(hit.primitive, 0xffffffffu);
    }
}

TEST(EmbreeScene, deadRaysStayDead) {
    const Scene scene = squareScene();
    const EmbreeScene embree(scene);
    std::vector<ClvRay> rays{rayAlong({0, 0, 0}, {0, 0, -1}, 0.0f), rayAlong({0, 0, 2}, {0, 0, -1})};
    std::vector<ClvHit> hits(2);
    embree.trace(rays, hits);
    EXPECT_EQ(rays[0].maxDistance, 0.0f);
    EXPECT_EQ(hits[0].primitive, 0xffffffffu);
    EXPECT_NE(hits[1].primitive, 0xffffffffu);
    embree.trace(rays);
    embree.killOccluded(rays);
    EXPECT_EQ(rays[0].maxDistance, 0.0f);
}

TEST(EmbreeScene, surfacesAtDistanceZeroDoNotCount) {
    SmallScene room;
    const auto grey = room.material(glm::vec3(0.5f));
    for (int axis = 0; axis < 3; ++axis) {
        for (double side : {-1.0, 1.0}) {
            glm::dvec3 corner(-1.0), x(0.0), y(0.0);
            corner[axis] = side, x[(axis + 1) % 3] = 2.0, y[(axis + 2) % 3] = 2.0;
            room.rectangle(corner, x, y, grey);
        }
    }
    const Scene scene = room.finish();
    const EmbreeScene embree(scene);
    // From a corner, where three walls meet, to the opposite ones.
    std::vector<ClvRay> rays;
    for (uint k = 0; k < 64; ++k) rays.push_back(rayAlong(glm::vec3(1.0f), -abs(randomDirection(3, k))));
    std::vector<ClvRay> judged = rays;
    std::vector<ClvHit> hits(rays.size());
    embree.trace(rays);
    embree.trace(judged, hits);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const glm::vec3 d = abs(rays[k].direction);
        const float expected = 2.0f / std::max({d.x, d.y, d.z});
        EXPECT_NEAR(rays[k].maxDistance, expected, 1e-5f);
        EXPECT_NEAR(judged[k].maxDistance, expected, 1e-5f);
        EXPECT_NEAR(embree.hit(rays[k].origin, rays[k].direction, kClvFar).distance, expected, 1e-5f);
        EXPECT_FALSE(embree.occluded(rays[k].origin, rays[k].direction, 0.99f * expected));
    }
}

TEST(EmbreeScene, hitTurnsTheNormalAgainstTheRayAndReadsTheAlbedo) {
    const Scene scene = squareScene();
    const EmbreeScene embree(scene);
    for (float side : {-1.0f, 1.0f}) {
        const ClvHit hit = embree.hit({0.1f, 0.2f, side}, {0, 0, -side}, kClvFar);
        EXPECT_EQ(hit.normal, glm::vec3(0, 0, side));
        EXPECT_EQ(hit.albedo, glm::vec3(0.25f, 0.5f, 0.75f));
        EXPECT_FLOAT_EQ(hit.distance, 1.0f);
    }
}

TEST(EmbreeScene, hitReadsTheTextureAtItsPlace) {
    Scene scene = squareScene();
    // Dark where x < 0, bright where x > 0.
    scene.textures.push_back({.name = "halves", .width = 2, .height = 1, .texels = {glm::vec3(0.0f), glm::vec3(1.0f)}});
    scene.materials[0] = {.name = "painted", .albedo = glm::vec3(0.5f), .texture = 0};
    for (const glm::vec3& p : scene.positions) scene.uvs.push_back(0.5f * glm::vec2(p.x, p.y) + 0.5f);
    const EmbreeScene embree(scene);
    EXPECT_EQ(embree.hit({-0.5f, 0.3f, 1}, {0, 0, -1}, kClvFar).albedo, glm::vec3(0.0f));
    EXPECT_EQ(embree.hit({0.5f, -0.3f, 1}, {0, 0, -1}, kClvFar).albedo, glm::vec3(0.5f));
}

TEST(EmbreeScene, packetsOfAnySizeAgreeWithSingleRays) {
    const Scene scene = triangleSoup(300, 0.4f, 21);
    const EmbreeScene embree(scene);
    for (std::size_t count = 1; count <= 40; ++count) {
        const std::vector<ClvRay> rays = randomRays(count, 100 + uint(count));
        std::vector<ClvRay> fast = rays, judged = rays, blocked = rays, fastJudged = rays, fastBlocked = rays;
        std::vector<ClvHit> hits(count), fastHits(count);
        embree.trace(fast);
        embree.trace(judged, hits);
        embree.killOccluded(blocked);
        embree.traceFast(fastJudged, fastHits);
        embree.killOccludedFast(fastBlocked);
        for (std::size_t i = 0; i < count; ++i) {
            const ClvHit single = embree.hit(rays[i].origin, rays[i].direction, kClvFar);
            EXPECT_EQ(hits[i].primitive, single.primitive);
            EXPECT_EQ(hits[i].normal, single.normal);
            EXPECT_EQ(hits[i].albedo, single.albedo);
            // The kinds of triangle test round differently.
            EXPECT_NEAR(judged[i].maxDistance, single.distance, 1e-6f * (1.0f + single.distance));
            EXPECT_NEAR(fast[i].maxDistance, single.distance, 1e-6f * (1.0f + single.distance));
            EXPECT_EQ(embree.occluded(rays[i].origin, rays[i].direction, kClvFar), single.distance < kClvFar);
            EXPECT_EQ(blocked[i].maxDistance, single.distance < kClvFar ? 0.0f : kClvFar);
            EXPECT_EQ(fastHits[i].primitive, single.primitive);
            EXPECT_EQ(fastHits[i].normal, single.normal);
            EXPECT_EQ(fastHits[i].albedo, single.albedo);
            EXPECT_EQ(fastJudged[i].maxDistance, fast[i].maxDistance);
            EXPECT_EQ(fastBlocked[i].maxDistance, blocked[i].maxDistance);
        }
    }
}

TEST(EmbreeScene, occlusionEndsAtTheRaysReach) {
    const Scene scene = squareScene();
    const EmbreeScene embree(scene);
    EXPECT_TRUE(embree.occluded({0, 0, 2}, {0, 0, -1}, 2.1f));
    EXPECT_FALSE(embree.occluded({0, 0, 2}, {0, 0, -1}, 1.9f));
}

TEST(EmbreeScene, closedSceneLetsNoRayOut) {
    // A box turned out of the axes, its walls cut into so many triangles that rays meet edges often. Its axes are whole numbers,
    // so that neighbours share their vertices to the last bit.
    SmallScene small;
    const std::uint32_t grey = small.material(glm::vec3(0.5f));
    const glm::dvec3 x(2, 1, 2), y(-2, 2, 1), z(-1, -2, 2);
    constexpr int kCuts = 32;
    const auto wall = [&](const glm::dvec3& normal, const glm::dvec3& u, const glm::dvec3& v) {
        for (int i = 0; i < kCuts; ++i) {
            for (int j = 0; j < kCuts; ++j) {
                small.rectangle(normal + u * (2.0 * i / kCuts - 1.0) + v * (2.0 * j / kCuts - 1.0), u * (2.0 / kCuts), v * (2.0 / kCuts), grey);
            }
        }
    };
    for (double side : {-1.0, 1.0}) {
        wall(side * x, y, z);
        wall(side * y, z, x);
        wall(side * z, x, y);
    }
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    std::vector<ClvRay> rays;
    // The vertices of all triangles are aimed at first, then all directions.
    for (const glm::vec3& p : scene.positions) rays.push_back(rayAlong(glm::vec3(0.0f), glm::normalize(p)));
    for (uint i = 0; i < 300000; ++i) rays.push_back(rayAlong(glm::vec3(0.0f), randomDirection(31, i)));
    std::vector<ClvHit> hits(rays.size());
    embree.trace(rays, hits);
    EXPECT_EQ(std::count_if(hits.begin(), hits.end(), [](const ClvHit& hit) { return hit.distance >= kClvFar; }), 0);
}

TEST(EmbreeScene, raysThatLeaveASurfaceDoNotMeetItAgain) {
    // Far from the origin coordinates are coarse, and the offset must follow.
    for (float distance : {0.0f, 1000.0f}) {
        Scene scene = triangleSoup(1, 1.0f, 41);
        for (glm::vec3& p : scene.positions) p += glm::vec3(distance);
        scene.bounds.lo += glm::vec3(distance);
        scene.bounds.hi += glm::vec3(distance);
        const EmbreeScene embree(scene);
        const glm::vec3 center = (scene.positions[0] + scene.positions[1] + scene.positions[2]) / 3.0f;
        int met = 0;
        for (uint i = 0; i < 100000; ++i) {
            const glm::vec3 origin = center + 3.0f * randomDirection(42, i);
            const glm::vec3 direction = glm::normalize(center + 0.3f * randomDirection(43, i) - origin);
            const ClvHit hit = embree.hit(origin, direction, kClvFar);
            if (hit.distance >= kClvFar) continue;
            ++met;
            const glm::vec3 start = origin + direction * hit.distance + hit.normal * embree.surfaceOffset();
            const glm::vec3 onward = clvCosineFromSquare(vec2(randomUnit(44, 2 * i), randomUnit(44, 2 * i + 1)), hit.normal);
            EXPECT_FALSE(embree.occluded(start, onward, kClvFar)) << i << " at " << distance;
        }
        EXPECT_GT(met, 1000);
    }
}

// Every crossing, by solving for each triangle in double precision. Sorted by distance.
std::vector<LineHit> crossingsOf(const Scene& scene, const ClvRay& ray) {
    std::vector<LineHit> hits;
    const glm::dvec3 o(ray.origin), d(ray.direction);
    for (const glm::uvec3& t : scene.triangles) {
        const glm::dvec3 a(scene.positions[t.x]), e1 = glm::dvec3(scene.positions[t.y]) - a, e2 = glm::dvec3(scene.positions[t.z]) - a;
        const glm::dvec3 n = glm::cross(e1, e2);
        const double distance = glm::dot(a - o, n) / glm::dot(d, n);
        const glm::dvec3 p = o + d * distance - a;
        const double u = glm::dot(glm::cross(p, e2), n) / glm::dot(n, n), v = glm::dot(glm::cross(e1, p), n) / glm::dot(n, n);
        if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= 0.0 || distance >= ray.maxDistance) continue;
        hits.push_back({.distance = float(distance), .front = glm::dot(n, d) < 0.0, .normal = glm::vec3(glm::normalize(n))});
    }
    std::sort(hits.begin(), hits.end(), [](const LineHit& a, const LineHit& b) { return a.distance < b.distance; });
    return hits;
}

TEST(EmbreeScene, lineMeetsEveryTriangleOnceInOrder) {
    // Long thin triangles: the builder splits them, and would report each part.
    SmallScene small;
    const std::uint32_t grey = small.material(glm::vec3(0.5f));
    for (uint i = 0; i < 400; ++i) {
        const glm::vec3 a = randomDirection(51, i), b = randomDirection(52, i);
        small.triangle(a, b, b + 0.05f * randomDirection(53, i), grey);
    }
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    std::vector<LineHit> hits;
    std::size_t total = 0;
    for (const ClvRay& ray : randomRays(2000, 54, 1.2f)) {
        embree.lineHits(ray.origin, ray.direction, ray.maxDistance, hits);
        const std::vector<LineHit> expected = crossingsOf(scene, ray);
        ASSERT_EQ(hits.size(), expected.size());
        total += hits.size();
        for (std::size_t i = 0; i < hits.size(); ++i) {
            EXPECT_NEAR(hits[i].distance, expected[i].distance, 1e-4f);
            EXPECT_EQ(hits[i].front, expected[i].front);
            EXPECT_LT(glm::length(hits[i].normal - expected[i].normal), 1e-3f);
        }
    }
    EXPECT_GT(total, 1000u);
}

TEST(EmbreeScene, lineMeetsBothOfTwoCoincidentSurfaces) {
    SmallScene small;
    const std::uint32_t grey = small.material(glm::vec3(0.5f));
    small.rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, grey);
    small.rectangle({-1, -1, 0}, {0, 2, 0}, {2, 0, 0}, grey);
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    std::vector<LineHit> hits(5);
    embree.lineHits({0.3f, 0.2f, 1}, {0, 0, -1}, 3.0f, hits);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_EQ(hits[0].distance, hits[1].distance);
    EXPECT_NE(hits[0].front, hits[1].front);
}

TEST(EmbreeScene, lineThatMeetsNothingClearsItsHits) {
    const Scene scene = squareScene();
    const EmbreeScene embree(scene);
    std::vector<LineHit> hits(5);
    embree.lineHits({5, 5, 1}, {0, 0, -1}, 3.0f, hits);
    EXPECT_TRUE(hits.empty());
}

}  // namespace
}  // namespace clv::test
