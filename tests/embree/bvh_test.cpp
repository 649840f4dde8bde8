// The tree of boxes, and the walk through it, against Embree.
#include "bindings/embree/bvh.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "bindings/embree/embree_scene.h"
#include "embree/small_scenes.h"
#include "support/scene_reader.h"

namespace clv::test {
namespace {

struct Tree {
    explicit Tree(const Scene& scene) : bvh(buildBvh(scene)) {}
    ClvBvhHit meet(const ClvRay& ray) const { return clvTraceBvh(SceneReader{bvh, rows}, ray.origin, ray.direction, ray.maxDistance); }
    Bvh bvh;
    SurfaceRows rows;
};

template <class Row>
bool sameBits(const std::vector<Row>& a, const std::vector<Row>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Row)) == 0;
}
bool sameBits(const Bvh& a, const Bvh& b) { return sameBits(a.boxes, b.boxes) && sameBits(a.children, b.children) && sameBits(a.triangles, b.triangles); }

Scene sceneOf(const std::vector<glm::vec3>& corners) {
    Scene scene;
    scene.positions = corners;
    scene.materials = {Material()};
    for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3) {
        scene.triangles.push_back({i, i + 1, i + 2});
        scene.materialOf.push_back(0);
    }
    scene.bounds = {corners.empty() ? glm::vec3(0.0f) : corners[0], corners.empty() ? glm::vec3(0.0f) : corners[0]};
    for (const glm::vec3& p : corners) scene.bounds = {glm::min(scene.bounds.lo, p), glm::max(scene.bounds.hi, p)};
    return scene;
}

// Follows every branch: notes how often each triangle is in a leaf, expects it inside all boxes above it, and returns the most
// entries that a walk can leave waiting.
class TreeCheck {
public:
    TreeCheck(const Scene& scene, const Bvh& bvh) : scene_(scene), bvh_(bvh), found_(scene.triangles.size()) {}

    std::size_t visit(uint node, const Bounds& within) {
        ++nodes_;
        std::size_t children = 0, deepest = 0;
        for (int i = 0; i < 4; ++i) {
            const uint child = bvh_.children[node][i];
            if (child == kClvNoChild) continue;
            ++children;
            const auto side = [&](uint row) { return bvh_.boxes[node * kClvBvhBoxRows + row][i]; };
            const Bounds box{{side(0), side(2), side(4)}, {side(1), side(3), side(5)}};
            const Bounds both{glm::max(box.lo, within.lo), glm::min(box.hi, within.hi)};
            if (child & kClvBvhLeafBit) {
                leaf(child, both);
            } else {
                deepest = std::max(deepest, visit(child, both));
            }
        }
        EXPECT_GE(children, node == 0 ? 0u : 2u);
        return deepest + std::max<std::size_t>(children, 1) - 1;
    }
    const std::vector<int>& found() const { return found_; }
    std::size_t nodes() const { return nodes_; }

private:
    void leaf(uint child, const Bounds& within) {
        EXPECT_LE(clvBvhLeafCount(child), kClvBvhMostTriangles);
        for (uint k = clvBvhLeafFirst(child); k < clvBvhLeafFirst(child) + clvBvhLeafCount(child); ++k) {
            const vec4 *rows = &bvh_.triangles[k * kClvTriangleRows];
            const uint t = uint(rows[0].w) | uint(rows[1].w) << 16;
            ASSERT_LT(t, scene_.triangles.size());
            ++found_[t];
            EXPECT_EQ(vec3(rows[0]), scene_.positions[scene_.triangles[t].x]);
            for (int corner = 0; corner < 3; ++corner) {
                const vec3& p = scene_.positions[scene_.triangles[t][corner]];
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, within.lo)) && glm::all(glm::lessThanEqual(p, within.hi))) << t;
            }
        }
    }

    const Scene& scene_;
    const Bvh& bvh_;
    std::vector<int> found_;
    std::size_t nodes_ = 0;
};

void expectWhole(const Scene& scene) {
    const Bvh bvh = buildBvh(scene);
    TreeCheck check(scene, bvh);
    const float far = std::numeric_limits<float>::infinity();
    EXPECT_LT(check.visit(0, {glm::vec3(-far), glm::vec3(far)}), kClvBvhStack);
    EXPECT_EQ(check.nodes(), bvh.children.size());
    EXPECT_EQ(bvh.boxes.size(), bvh.children.size() * kClvBvhBoxRows);
    EXPECT_EQ(std::count(check.found().begin(), check.found().end(), 1), std::ptrdiff_t(scene.triangles.size()));
}

TEST(Bvh, holdsEveryTriangleOnceInsideItsBoxes) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        SCOPED_TRACE(builtin.name);
        expectWhole(makeBuiltinScene(builtin.name));
    }
    for (const int count : {1, 2, 3, 4, 5, 17, 1000, 70000}) {
        SCOPED_TRACE(count);
        expectWhole(triangleSoup(count, 0.1f, 7));
    }
}

TEST(Bvh, staysWithinTheStackWhereSizesDifferWildly) {
    // Each triangle twice as large as the one before and at twice its distance: a tree by surface area alone becomes a list.
    std::vector<glm::vec3> corners;
    for (int i = -60; i <= 60; ++i) {
        const float size = std::ldexp(1.0f, i);
        corners.insert(corners.end(), {glm::vec3(size, 0, 0), glm::vec3(size, 0.5f * size, 0), glm::vec3(size, 0, 0.5f * size)});
    }
    expectWhole(sceneOf(corners));
}

TEST(Bvh, isTheSameFromRunToRunOnAnyNumberOfThreads) {
    for (const Scene& scene : {makeBuiltinScene("atrium"), triangleSoup(50000, 0.02f, 3)}) {
        const Bvh first = buildBvh(scene);
        for (const int threads : {1, 2, 4}) {
            Bvh again;
            tbb::task_arena(threads).execute([&] { again = buildBvh(scene); });
            EXPECT_TRUE(sameBits(first, again)) << threads;
        }
    }
}

TEST(Bvh, ofNothingIsWalkedAndMeetsNothing) {
    const Tree tree(sceneOf({}));
    EXPECT_EQ(tree.bvh.children.size(), 1u);
    for (const ClvRay& ray : randomRays(1000, 5)) EXPECT_EQ(tree.meet(ray).primitive, kClvNoPrimitive);
}

TEST(Bvh, leavesOutTrianglesThatNoRayCanMeet) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    const Tree tree(sceneOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0},
                             {0, 0, 0}, {nan, 0, 0}, {0, 1, 0},
                             {-1, -1, 0}, {1, -1, 0}, {0, 1, 0},
                             {0, 0, infinite}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(tree.bvh.triangles.size(), kClvTriangleRows);
    EXPECT_EQ(tree.meet(rayAlong({0, 0, 1}, {0, 0, -1})).primitive, 2u);
}

TEST(Bvh, ofOneTriangleIsMetFromBothSidesAtItsPlace) {
    const Tree tree(sceneOf({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}));
    for (const float side : {-1.0f, 1.0f}) {
        const ClvBvhHit hit = tree.meet(rayAlong({1, 2, 3 * side}, {0, 0, -side}));
        EXPECT_EQ(hit.primitive, 0u);
        EXPECT_EQ(hit.distance, 3.0f);
        EXPECT_EQ(hit.u, 0.25f);
        EXPECT_EQ(hit.v, 0.5f);
        EXPECT_EQ(tree.meet(rayAlong({1, 2, 3 * side}, {0, 0, side})).primitive, kClvNoPrimitive) << "behind";
        EXPECT_EQ(tree.meet(rayAlong({3, 2, 3 * side}, {0, 0, -side})).primitive, kClvNoPrimitive) << "beside";
    }
}

TEST(Bvh, raysEndAtTheirReachAndStartBeyondDistanceZero) {
    const Tree tree(sceneOf({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}));
    EXPECT_EQ(tree.meet(rayAlong({1, 1, 3}, {0, 0, -1}, 3.5f)).primitive, 0u);
    const ClvBvhHit tooFar = tree.meet(rayAlong({1, 1, 3}, {0, 0, -1}, 2.5f));
    EXPECT_EQ(tooFar.primitive, kClvNoPrimitive);
    EXPECT_EQ(tooFar.distance, 2.5f);
    EXPECT_EQ(tree.meet(rayAlong({1, 1, 0}, {0, 0, -1})).primitive, kClvNoPrimitive);
    EXPECT_EQ(tree.meet(rayAlong({1, 1, 3}, {0, 0, -1}, 0.0f)).primitive, kClvNoPrimitive);
}

TEST(Bvh, raysThatAreNotFiniteMeetNothing) {
    const Tree tree(triangleSoup(100, 0.5f, 9));
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (ClvRay ray : randomRays(100, 11)) {
                ClvRay turned = ray;
                ray.origin[axis] = bad;
                turned.direction[axis] = bad;
                EXPECT_EQ(tree.meet(ray).primitive, kClvNoPrimitive);
                EXPECT_EQ(tree.meet(turned).primitive, kClvNoPrimitive);
            }
        }
    }
}

TEST(Bvh, manyCoincidentTrianglesAreMetOnce) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 5000; ++i) corners.insert(corners.end(), {glm::vec3(0, 0, 0), glm::vec3(4, 0, 0), glm::vec3(0, 4, 0)});
    const Scene scene = sceneOf(corners);
    expectWhole(scene);
    const ClvBvhHit hit = Tree(scene).meet(rayAlong({1, 2, 3}, {0, 0, -1}));
    EXPECT_LT(hit.primitive, 5000u);
    EXPECT_EQ(hit.distance, 3.0f);
}

// Rays that end at different surfaces for the walk and for Embree; two triangles that touch are one surface.
std::size_t disagreements(const Scene& scene, const std::vector<ClvRay>& rays) {
    const EmbreeScene embree(scene);
    const Tree tree(scene);
    std::size_t different = 0, met = 0;
    for (const ClvRay& ray : rays) {
        const ClvHit expected = embree.hit(ray.origin, ray.direction, ray.maxDistance);
        const ClvBvhHit hit = tree.meet(ray);
        met += hit.primitive != kClvNoPrimitive;
        // Along a surface at a flat angle rounding shifts the place where it is met far.
        const float offPlane = std::abs(hit.distance - expected.distance) * std::abs(dot(expected.normal, ray.direction));
        different += (hit.primitive == kClvNoPrimitive) != (expected.primitive == kClvNoPrimitive) || offPlane > embree.surfaceOffset();
    }
    EXPECT_GT(met, rays.size() / 10);
    return different;
}

// The scene's bounds filled with rays in all directions, every third one along an axis or in a plane of two.
std::vector<ClvRay> raysThrough(const Bounds& bounds, std::size_t count) {
    std::vector<ClvRay> rays = randomRays(count, 17);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].origin = bounds.center() + 0.5f * bounds.extent() * rays[i].origin;
        if (i % 3 == 0) {
            rays[i].direction[int(i / 3 % 3)] = 0.0f;
            if (i % 2 == 0) rays[i].direction[int((i / 3 + 1) % 3)] = 0.0f;
            rays[i].direction = glm::normalize(rays[i].direction);
        }
    }
    return rays;
}

TEST(Bvh, walkMeetsWhatEmbreeMeetsInTheBuiltInScenes) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        const Scene scene = makeBuiltinScene(builtin.name);
        EXPECT_LE(disagreements(scene, raysThrough(scene.bounds, 50000)), 2u) << builtin.name;
    }
}

TEST(Bvh, walkMeetsWhatEmbreeMeetsAmongRandomTriangles) {
    for (const auto& [count, size] : {std::pair(1, 1.0f), std::pair(30, 0.8f), std::pair(3000, 0.2f), std::pair(40000, 0.05f)}) {
        const Scene scene = triangleSoup(count, size, 23);
        std::vector<ClvRay> rays = raysThrough(scene.bounds, 50000);
        if (count == 1) {
            // Few rays meet a single triangle unless they aim at it.
            for (ClvRay& ray : rays) {
                const glm::vec3 aim = (scene.positions[0] + scene.positions[1] + scene.positions[2]) / 3.0f + 0.3f * ray.direction;
                ray.direction = glm::normalize(aim - ray.origin);
            }
        }
        EXPECT_LE(disagreements(scene, rays), 2u) << count;
    }
}

TEST(Bvh, raysInTheFacesOfBoxesMeetWhatLiesThere) {
    // Fins that stand on a grid: their corners, and so the faces of boxes, lie on whole numbers, where the rays run.
    std::vector<glm::vec3> corners;
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y) {
            const glm::vec3 at(x, y, 0);
            corners.insert(corners.end(), {at, at + glm::vec3(1, 0, 0.25f), at + glm::vec3(0, 1, 0.5f)});
        }
    }
    const Tree tree(sceneOf(corners));
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y) {
            const ClvBvhHit down = tree.meet(rayAlong({float(x), float(y), 2.0f}, {0, 0, -1}));
            EXPECT_NE(down.primitive, kClvNoPrimitive) << x << " " << y;
            EXPECT_EQ(down.distance, 2.0f);
        }
        // Along the row in the plane of its front faces, at the height where the first fin's edge is.
        const ClvBvhHit along = tree.meet(rayAlong({float(x), -1.0f, 0.25f}, {0, 1, 0}));
        EXPECT_NE(along.primitive, kClvNoPrimitive) << x;
        EXPECT_EQ(along.distance, 1.5f);
    }
}

TEST(Bvh, closedSceneLetsHardlyARayOut) {
    // A ball of triangles that share their corners to the last bit, none of them along an axis.
    constexpr int kRings = 60, kSpokes = 90;
    std::vector<glm::vec3> corners;
    const auto point = [&](int ring, int spoke) {
        const double theta = M_PI * ring / kRings, phi = 2.0 * M_PI * (spoke % kSpokes) / kSpokes;
        return ring == 0 || ring == kRings ? glm::vec3(0, ring == 0 ? 1 : -1, 0)
                                           : glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    for (int ring = 0; ring < kRings; ++ring) {
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const glm::vec3 a = point(ring, spoke), b = point(ring + 1, spoke), c = point(ring + 1, spoke + 1), d = point(ring, spoke + 1);
            if (ring + 1 < kRings) corners.insert(corners.end(), {a, b, c});
            if (ring > 0) corners.insert(corners.end(), {a, c, d});
        }
    }
    const Tree tree(sceneOf(corners));
    std::size_t out = 0;
    constexpr std::size_t kRays = 400000;
    for (const ClvRay& ray : randomRays(kRays, 31)) {
        const ClvRay inside = rayAlong(0.5f * ray.origin, ray.direction);
        out += tree.meet(inside).primitive == kClvNoPrimitive;
    }
    EXPECT_LE(out, 2u);
}

}  // namespace
}  // namespace clv::test
