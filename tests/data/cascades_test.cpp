#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <tuple>

#include "clv/plan/cascade_placement.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

const glm::dvec3 kFar(1.0e6, -1.0e6, 1.0e6);  // m: 1,000 km along each axis

CascadeDesc smallDesc() { return {.count = 3, .resolution = ivec3(16, 12, 20), .finestCellSize = 0.3, .marginCells = 2}; }

CameraView viewAt(const glm::dvec3& position) { return {.position = position}; }

double signedUnit(uint seed, uint index) { return 2.0 * test::randomUnit(seed, index) - 1.0; }

// Camera with a random axis and field of view.
CameraView randomView(uint i) {
    CameraView view;
    view.position = 50.0 * glm::dvec3(signedUnit(1u, i), signedUnit(2u, i), signedUnit(3u, i));
    view.forward = glm::normalize(glm::dvec3(test::randomDirection(4u, i)));
    view.yfov = 0.2 + 1.8 * test::randomUnit(5u, i);
    view.aspect = 0.5 + 2.0 * test::randomUnit(6u, i);
    return view;
}

bool holds(const PlacedCascade& placed, const glm::dvec3& position, double marginCells) {
    for (int axis = 0; axis < 3; ++axis) {
        double cell = position[axis] / placed.cellSize - double(placed.lowest[axis]);
        if (cell < marginCells - 1e-9 || cell > placed.resolution[axis] - marginCells + 1e-9) return false;
    }
    return true;
}

std::map<std::tuple<int, int, int>, int> visitExposed(const ivec3& resolution, const ivec3& moved) {
    std::map<std::tuple<int, int, int>, int> visits;
    for (const CellBox& box : exposedCells(resolution, moved)) {
        for (int z = box.lo.z; z < box.hi.z; ++z) {
            for (int y = box.lo.y; y < box.hi.y; ++y) {
                for (int x = box.lo.x; x < box.hi.x; ++x) ++visits[{x, y, z}];
            }
        }
    }
    return visits;
}


TEST(CascadePlacement, cellsGrowByTheFactor) {
    CascadeDesc desc = smallDesc();
    EXPECT_DOUBLE_EQ(placeCascade(desc, {}, 0).cellSize, 0.3);
    EXPECT_DOUBLE_EQ(placeCascade(desc, {}, 2).cellSize, 1.2);
    desc.growth = 3.0;
    EXPECT_DOUBLE_EQ(placeCascade(desc, {}, 2).cellSize, 2.7);
}

TEST(CascadePlacement, theCameraStaysWithinHalfACellOfTheCentre) {
    CascadeDesc desc = smallDesc();
    for (uint i = 0; i < 2000; ++i) {
        CameraView view = randomView(i);
        for (int level = 0; level < desc.count; ++level) {
            PlacedCascade placed = placeCascade(desc, view, level);
            for (int axis = 0; axis < 3; ++axis) {
                double centre = (double(placed.lowest[axis]) + desc.resolution[axis] / 2) * placed.cellSize;
                ASSERT_LE(std::abs(centre - view.position[axis]), 0.5 * placed.cellSize * (1.0 + 1e-9));
            }
        }
    }
}

TEST(CascadePlacement, snappingIsExactAThousandKilometresFromTheOrigin) {
    CascadeDesc desc = smallDesc();
    // Steps of a thousandth of a cell: the lattice coordinate changes once a cell, by one, and never back.
    const double cell = desc.finestCellSize;
    std::int64_t first = placeCascade(desc, viewAt(kFar), 0).lowest.x, last = first;
    for (int i = 0; i <= 30000; ++i) {
        std::int64_t now = placeCascade(desc, viewAt(kFar + glm::dvec3(i * cell * 1e-3, 0.0, 0.0)), 0).lowest.x;
        ASSERT_TRUE(now == last || now == last + 1);
        last = now;
    }
    EXPECT_EQ(last - first, 30);
}

TEST(CascadePlacement, volumesFarAwayHaveTheCornersOfVolumesAtTheOrigin) {
    CascadeDesc desc = smallDesc();
    desc.finestCellSize = 0.25;
    for (int level = 0; level < desc.count; ++level) {
        // 0.3 m off a lattice point, once near the origin and once 4,000,000 of the finest cells away.
        glm::dvec3 offset(0.3, 0.4, -7.3);
        auto corner = [&](const glm::dvec3& base) {
            CameraView view = viewAt(base + offset);
            return volumeFromCascade(placeCascade(desc, view, level), anchorNear(desc, view), 0u).origin;
        };
        EXPECT_EQ(corner(kFar), corner(glm::dvec3(0.0)));
    }
}

TEST(CascadePlacement, anchorLiesOnTheCoarsestLatticeNearTheCamera) {
    CascadeDesc desc = smallDesc();
    CameraView view = viewAt(kFar);
    glm::dvec3 anchor = anchorNear(desc, view);
    double step = cascadeCellSize(desc, desc.count - 1);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(std::abs(anchor[axis] - view.position[axis]), 0.5 * step);
        EXPECT_EQ(anchor[axis], std::round(anchor[axis] / step) * step);
    }
}


TEST(FrustumFit, eachCascadeEnclosesItsSliceWithTheMarginHoweverTheCameraTurns) {
    CascadeDesc desc = smallDesc();
    desc.fit = CascadeFit::frustum;
    for (uint i = 0; i < 2000; ++i) {
        CameraView view = randomView(i);
        glm::dvec3 right = glm::normalize(glm::cross(view.forward, glm::dvec3(0.3, 1.0, 0.2))), up = glm::cross(right, view.forward);
        double vertical = std::tan(0.5 * view.yfov), horizontal = vertical * view.aspect;
        for (int level = 0; level < desc.count; ++level) {
            PlacedCascade placed = placeCascade(desc, view, level);
            double farthest = sliceOfRadius(heldRadius(desc, level), frustumSlope(view)).farthest;
            ASSERT_GT(farthest, 0.0);
            ASSERT_TRUE(holds(placed, view.position, desc.marginCells));
            for (int corner = 0; corner < 4; ++corner) {
                glm::dvec3 offset = right * (corner & 1 ? horizontal : -horizontal) + up * (corner & 2 ? vertical : -vertical);
                ASSERT_TRUE(holds(placed, view.position + farthest * (view.forward + offset), desc.marginCells)) << i;
            }
        }
    }
}

TEST(FrustumFit, theSliceCannotBeLonger) {
    // The far corners lie on the sphere, and its centre is where the sphere of a longer slice would have to be larger.
    for (double slope : {0.2, 0.7, 1.0, 1.7}) {
        auto [farthest, centre] = sliceOfRadius(5.0, slope);
        EXPECT_NEAR(std::hypot(farthest - centre, farthest * slope), 5.0, 1e-12);
        EXPECT_LE(centre, 5.0);
        double longer = 1.01 * farthest, smallest = 1e9;
        for (double c = 0.0; c < 2.0 * longer; c += 0.001) {
            smallest = std::min(smallest, std::max(c, std::hypot(longer - c, longer * slope)));
        }
        EXPECT_GT(smallest, 5.0);
    }
}

TEST(FrustumFit, coarserCascadesHoldFinerOnes) {
    CascadeDesc desc{.count = 4, .fit = CascadeFit::frustum};
    for (uint i = 0; i < 2000; ++i) {
        CameraView view = randomView(i);
        for (int level = 0; level + 1 < desc.count; ++level) {
            PlacedCascade fine = placeCascade(desc, view, level), coarse = placeCascade(desc, view, level + 1);
            glm::dvec3 lo = glm::dvec3(fine.lowest) * fine.cellSize;
            // Half a coarse cell of snapping may stick out at either side.
            ASSERT_TRUE(holds(coarse, lo, -1.0)) << i;
            ASSERT_TRUE(holds(coarse, lo + glm::dvec3(fine.resolution) * fine.cellSize, -1.0)) << i;
        }
    }
}


TEST(Scroll, tellsHowManyCellsTheVolumeMoved) {
    CascadeDesc desc = smallDesc();
    PlacedCascade before = placeCascade(desc, viewAt(kFar), 0);
    PlacedCascade after = placeCascade(desc, viewAt(kFar + 0.3 * glm::dvec3(1.0, -2.0, 0.0)), 0);
    EXPECT_EQ(cascadeScroll(before, after), ivec3(1, -2, 0));
    EXPECT_EQ(cascadeScroll(before, before), ivec3(0));
}

TEST(Scroll, aJumpOfAMillionCellsMakesAllCellsNew) {
    CascadeDesc desc = smallDesc();
    PlacedCascade before = placeCascade(desc, viewAt(glm::dvec3(0.0)), 0);
    PlacedCascade after = placeCascade(desc, viewAt(0.3e6 * glm::dvec3(0.0, -1.0, 0.0)), 0);
    EXPECT_EQ(after.lowest.y - before.lowest.y, -1000000);
    ivec3 moved = cascadeScroll(before, after);
    EXPECT_EQ(moved, ivec3(0, -12, 0));
    EXPECT_EQ(visitExposed(desc.resolution, moved).size(), 16u * 12u * 20u);
}

TEST(Scroll, anotherCellSizeMakesAllCellsNew) {
    CascadeDesc desc = smallDesc();
    PlacedCascade fine = placeCascade(desc, {}, 0), coarse = placeCascade(desc, {}, 1);
    EXPECT_EQ(visitExposed(desc.resolution, cascadeScroll(fine, coarse)).size(), 16u * 12u * 20u);
}

TEST(Scroll, exposedCellsAreThoseThatTheVolumeDidNotHoldEachOnce) {
    const ivec3 n(5, 4, 6);
    for (int x = -n.x; x <= n.x; ++x) {
        for (int y = -n.y; y <= n.y; ++y) {
            for (int z = -n.z; z <= n.z; ++z) {
                auto visits = visitExposed(n, ivec3(x, y, z));
                int held = (n.x - std::abs(x)) * (n.y - std::abs(y)) * (n.z - std::abs(z));
                ASSERT_EQ(int(visits.size()), n.x * n.y * n.z - held);
                for (auto& [cell, count] : visits) {
                    auto [cx, cy, cz] = cell;
                    ivec3 old = ivec3(cx, cy, cz) + ivec3(x, y, z);
                    bool wasHeld = old.x >= 0 && old.x < n.x && old.y >= 0 && old.y < n.y && old.z >= 0 && old.z < n.z;
                    ASSERT_EQ(count, 1);
                    ASSERT_FALSE(wasHeld);
                }
            }
        }
    }
}


TEST(Toroidal, wrapIsTheRemainderThatIsNotNegative) {
    for (int x = -50; x <= 50; ++x) {
        int r = clvWrap(x, 7);
        EXPECT_TRUE(r >= 0 && r < 7);
        EXPECT_EQ((x - r) % 7, 0);
    }
}

TEST(Toroidal, aCellKeepsItsPlaceInMemoryWhileTheVolumeHoldsIt) {
    CascadeDesc desc = smallDesc();
    for (const glm::dvec3& base : {glm::dvec3(0.0), kFar, -kFar}) {
        PlacedCascade before = placeCascade(desc, viewAt(base), 0);
        PlacedCascade after = placeCascade(desc, viewAt(base + glm::dvec3(-1.0, 0.7, 2.0)), 0);
        ClvVolume oldVolume = volumeFromCascade(before, base, 0u), newVolume = volumeFromCascade(after, base, 0u);
        ivec3 moved = cascadeScroll(before, after);
        ASSERT_NE(moved, ivec3(0));
        int kept = 0;
        for (uint i = 0; i < 16u * 12u * 20u; ++i) {
            ivec3 cell = clvCellFromIndex(newVolume, i), old = cell + moved;
            ASSERT_EQ(clvCellIndex(newVolume, cell), i);
            if (clvCellInside(oldVolume, old) == 0) continue;
            ++kept;
            ASSERT_EQ(clvCellIndex(oldVolume, old), i);
        }
        EXPECT_EQ(kept, (16 - std::abs(moved.x)) * (12 - std::abs(moved.y)) * (20 - std::abs(moved.z)));
    }
}

TEST(Toroidal, latticeAndStorageAreInversesForNegativeCoordinatesToo) {
    CascadeDesc desc = smallDesc();
    for (const glm::dvec3& base : {glm::dvec3(-3.7, 0.1, 4.0), kFar, -kFar}) {
        PlacedCascade placed = placeCascade(desc, viewAt(base), 1);
        for (int x = 0; x < 16; ++x) {
            for (int y = 0; y < 12; ++y) {
                LatticeCell cell = placed.lowest + LatticeCell(x, y, 5);
                ivec3 stored = storageFromLattice(cell, desc.resolution);
                ASSERT_TRUE(stored.x >= 0 && stored.x < 16 && stored.y >= 0 && stored.y < 12);
                ASSERT_EQ(latticeFromStorage(placed, stored), cell);
            }
        }
    }
}


ClvCascades cascadesAtOrigin() {
    CascadeDesc desc{.count = 3, .resolution = ivec3(16), .finestCellSize = 1.0, .marginCells = 2};
    return placeCascades(desc, {}, glm::dvec3(0.0), 1u, 3.0f);
}

TEST(Cascades, theFinestThatHoldsThePositionWithItsMarginLightsIt) {
    ClvCascades cascades = cascadesAtOrigin();  // half sizes 8, 16 and 32 m; margins 2, 4 and 8 m
    EXPECT_EQ(cascades.count, 3u);
    EXPECT_EQ(cascades.volumes[2].storage, 1u);
    EXPECT_EQ(clvCascadeFromPosition(cascades, vec3(0.0f)), 0u);
    EXPECT_EQ(clvCascadeFromPosition(cascades, vec3(5.9f, 0.0f, 0.0f)), 0u);
    EXPECT_EQ(clvCascadeFromPosition(cascades, vec3(6.1f, 0.0f, 0.0f)), 1u);
    EXPECT_EQ(clvCascadeFromPosition(cascades, vec3(0.0f, -11.9f, 0.0f)), 1u);
    EXPECT_EQ(clvCascadeFromPosition(cascades, vec3(0.0f, 0.0f, 12.1f)), 2u);
    EXPECT_EQ(clvCascadeFromPosition(cascades, vec3(1e9f, 0.0f, 0.0f)), 2u);
}

TEST(Cascades, weightFallsToZeroAtTheMarginWithoutAJump) {
    ClvCascades cascades = cascadesAtOrigin();
    EXPECT_EQ(clvCascadeWeight(cascades, 0u, vec3(0.0f)), 1.0f);
    EXPECT_EQ(clvCascadeWeight(cascades, 0u, vec3(3.0f, 0.0f, 0.0f)), 1.0f);
    EXPECT_FLOAT_EQ(clvCascadeWeight(cascades, 0u, vec3(4.5f, 0.0f, 0.0f)), 0.5f);
    EXPECT_EQ(clvCascadeWeight(cascades, 0u, vec3(6.0f, 0.0f, 0.0f)), 0.0f);
    EXPECT_EQ(clvCascadeWeight(cascades, 2u, vec3(1e9f, 0.0f, 0.0f)), 1.0f);
    // Along a path out of all cascades the mix of the cascades' indices, a stand-in for their light, has no jump.
    float last = 0.0f;
    for (float x = 0.0f; x < 40.0f; x += 0.01f) {
        uint i = clvCascadeFromPosition(cascades, vec3(x, 0.5f, -0.25f));
        float w = clvCascadeWeight(cascades, i, vec3(x, 0.5f, -0.25f)), mixed = float(i) * w + float(i + 1u) * (1.0f - w);
        ASSERT_NEAR(mixed, last, 0.01f);
        last = mixed;
    }
    EXPECT_EQ(last, 2.0f);
}

TEST(Cascades, withoutABlendZoneTheFinerOneCountsUpToTheMargin) {
    ClvCascades cascades = cascadesAtOrigin();
    cascades.blendCells = 0.0f;
    EXPECT_EQ(clvCascadeWeight(cascades, 0u, vec3(5.9f, 0.0f, 0.0f)), 1.0f);
}

TEST(Cascades, positionsBeyondTheLastOneAreClampedToIt) {
    ClvVolume last = cascadesAtOrigin().volumes[2];
    EXPECT_EQ(clvClampToVolume(last, vec3(100.0f, -200.0f, 3.0f)), vec3(32.0f, -32.0f, 3.0f));
    EXPECT_EQ(clvClampToVolume(last, vec3(1.0f, 2.0f, 3.0f)), vec3(1.0f, 2.0f, 3.0f));
    EXPECT_GE(clvCellsToEdge(last, clvClampToVolume(last, vec3(1e9f, 1e9f, -1e9f))), 0.0f);
}


TEST(CascadeValidation, acceptsTheDefaultsAndTheFarOrigin) {
    EXPECT_EQ(validate(CascadeDesc{}, CameraView{}), "");
    EXPECT_EQ(validate(CascadeDesc{}, viewAt(kFar)), "");
}

TEST(CascadeValidation, saysWhatIsWrongWithTheCamera) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(validate(CascadeDesc{}, viewAt(glm::dvec3(0.0, nan, 0.0))), "camera: position must be finite");
    EXPECT_EQ(validate(CascadeDesc{}, viewAt(glm::dvec3(1e300, 0.0, 0.0))),
              "camera: position is more than 2^52 of the finest cells away from the origin");
    EXPECT_EQ(validate(CascadeDesc{}, CameraView{.forward = glm::dvec3(nan)}), "camera: forward must be of unit length");
    EXPECT_EQ(validate(CascadeDesc{}, CameraView{.forward = glm::dvec3(0.0, 0.0, -2.0)}), "camera: forward must be of unit length");
    EXPECT_EQ(validate(CascadeDesc{}, CameraView{.yfov = nan}), "camera: yfov must lie in (0, pi)");
    EXPECT_EQ(validate(CascadeDesc{}, CameraView{.aspect = 0.0}), "camera: aspect must be above 0");
}

TEST(CascadeValidation, saysWhatIsWrongWithTheCascades) {
    EXPECT_EQ(validate(CascadeDesc{.count = 0}), "cascades: count must lie in [1, 8], not 0");
    EXPECT_EQ(validate(CascadeDesc{.count = 9}), "cascades: count must lie in [1, 8], not 9");
    EXPECT_EQ(validate(CascadeDesc{.resolution = ivec3(7)}), "cascades: resolution must exceed 2 * marginCells + 3");
    EXPECT_EQ(validate(CascadeDesc{.resolution = ivec3(8)}), "");
    EXPECT_EQ(validate(CascadeDesc{.resolution = ivec3(32, 1000000, 32)}), "cascades: resolution must be at most 1024");
    for (double bad : {0.0, -1.0, 1e-60, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_EQ(validate(CascadeDesc{.finestCellSize = bad}), "cascades: finestCellSize must be at least 1e-12 m");
    }
    for (double bad : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_EQ(validate(CascadeDesc{.growth = bad}), "cascades: growth must be at least 1");
    }
    EXPECT_EQ(validate(CascadeDesc{.growth = 1e200}), "cascades: the coarsest cells must be at most 1e12 m");
    EXPECT_EQ(validate(CascadeDesc{.marginCells = -1}), "cascades: marginCells must not be negative");
}

}  // namespace
