// What a baked volume says at a point and in a cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/hall_volume.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(BakedVolume, mixesCascadesAtTheEdgeOfTheFinerOne) {
    const BakedVolume volume = hallVolume();
    const ClvCascades cascades = cascadesOf(volume);
    BakedVolume fine = volume, coarse = volume;
    fine.cascades.pop_back();
    coarse.cascades.erase(coarse.cascades.begin());
    bool inside = false, between = false, outside = false;
    for (float x = -1.0f; x < 3.8f; x += 0.1f) {
        const ClvReceiver receiver{vec3(x, -1.0f, -2.3f), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f};
        const uint cascade = clvCascadeFromPosition(cascades, receiver.position);
        const float weight = clvCascadeWeight(cascades, cascade, receiver.position);
        const vec3 expected = cascade == 1 ? irradianceAt(coarse, receiver) : mix(irradianceAt(coarse, receiver), irradianceAt(fine, receiver), weight);
        EXPECT_LE(glm::length(irradianceAt(volume, receiver) - expected), 1e-6f * glm::length(expected)) << x;
        (cascade == 1 ? outside : weight == 1.0f ? inside : between) = true;
    }
    EXPECT_TRUE(inside && between && outside);
}

TEST(BakedVolume, beyondTheLastCascadeTheLightIsThatOfItsEdge) {
    const BakedVolume volume = hallVolume();
    const ClvVolume& grid = volume.cascades[1].level.volume;
    const vec3 edge = grid.origin + vec3(0.0f, 3.0f, 3.0f);
    const vec3 normal(1.0f, 0.0f, 0.0f);
    EXPECT_EQ(irradianceAt(volume, {edge - vec3(50.0f, 0.0f, 0.0f), 0.0f, normal, 0.0f}), irradianceAt(volume, {edge, 0.0f, normal, 0.0f}));
}

// A file may hold any float.
TEST(BakedVolume, theBrightestDepositsAreReadAsNumbers) {
    BakedVolume volume = hallVolume(2, true, kClvStorageCube9);
    for (BakedCascade& cascade : volume.cascades) {
        for (std::size_t k = 0; k < cascade.estimates[0].size(); ++k) cascade.estimates[0][k] = k % 3 == 0 ? -3.4e38f : 3.4e38f;
        std::ranges::fill(cascade.estimates[1], 0.0f);
    }
    const vec3 e = irradianceAt(volume, {vec3(0.0f, -1.0f, -2.3f), 0.0f, vec3(0.6f, 0.0f, 0.8f), 0.0f});
    EXPECT_TRUE(std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z));
    for (std::size_t cell = 0; cell < volume.cascades[0].level.cellCount(); ++cell) {
        const CellLight light = cellLight(volume, volume.cascades[0], cell);
        for (std::size_t side = 0; side < kSides; ++side) ASSERT_TRUE(std::isfinite(light.variance[side]) && std::isfinite(light.irradiance[side].y)) << cell;
    }
}

TEST(BakedVolume, theSidesOfACellAreItsDepositsOverItsOpenVolume) {
    for (const uint storage : {kClvStorageCube, kClvStorageCube9}) {
        const BakedVolume volume = hallVolume(1, true, storage);
        const BakedCascade& cascade = volume.cascades[0];
        int split = 0;
        for (std::size_t cell = 0; cell < cascade.level.cellCount(); ++cell) {
            const uint entry = cascade.level.table[cell];
            if (entry == kClvNoSlot) continue;
            const CellSlots slots = slotsOfCell(cascade.level, entry);
            split += slots.count > 1 ? 1 : 0;
            const CellLight light = cellLight(volume, cascade, cell);
            EXPECT_EQ(light.slots, slots.count);
            double volumes = 0.0, deposits = 0.0, dynamicity = 0.0;
            for (uint s = slots.first; s < slots.first + slots.count; ++s) {
                volumes += double(cascade.level.slots[s].openVolume);
                deposits += double(cascade.estimates[0][s * std::size_t(volume.layout.stride()) + 3 * 4 + 1]);  // side +z, green
                dynamicity = std::max(dynamicity, double(cascade.dynamicity[s * kSides + 4]));
            }
            EXPECT_NEAR(light.irradiance[4].y, deposits / volumes, 1e-5 * deposits / volumes);
            EXPECT_NEAR(light.openVolume, volumes, 1e-6 * volumes);
            EXPECT_EQ(light.dynamicity[4], float(dynamicity));
            for (const float variance : light.variance) EXPECT_EQ(variance, 0.0f);
            double ofRegions = 0.0;
            for (uint s = slots.first; s < slots.first + slots.count; ++s) {
                const CellLight region = regionLight(volume, cascade, s);
                EXPECT_EQ(region.slots, 1u);
                ofRegions += double(region.openVolume) * double(region.irradiance[4].y);
            }
            EXPECT_NEAR(ofRegions, deposits, 1e-5 * deposits);
        }
        EXPECT_GT(split, 0);
    }
}

TEST(BakedVolume, theVarianceOfASideIsThatOfTheMeanOfItsTwoEstimates) {
    const BakedVolume volume = hallVolume();
    BakedVolume one = volume, other = volume;
    one.cascades[0].estimates.pop_back();
    other.cascades[0].estimates.erase(other.cascades[0].estimates.begin());
    for (std::size_t cell = 0; cell < volume.cascades[0].level.cellCount(); ++cell) {
        const CellLight both = cellLight(volume, volume.cascades[0], cell), a = cellLight(one, one.cascades[0], cell), b = cellLight(other, other.cascades[0], cell);
        if (both.slots == 0) continue;
        for (std::size_t side = 0; side < kSides; ++side) {
            double squares = 0.0;
            for (int c = 0; c < 3; ++c) {
                const double mean = 0.5 * (double(a.irradiance[side][c]) + double(b.irradiance[side][c]));
                EXPECT_NEAR(both.irradiance[side][c], mean, 1e-6 * mean);
                // Of two values, the unbiased variance of one is (a - b)^2 / 2; of their mean, half of that.
                squares += std::pow(double(a.irradiance[side][c]) - double(b.irradiance[side][c]), 2.0) / 4.0;
            }
            EXPECT_NEAR(both.variance[side], squares / 3.0, 1e-5 * squares + 1e-9);
        }
    }
}

}  // namespace
