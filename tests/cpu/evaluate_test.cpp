// What a receiver reads: constant and linear fields, walls, and no light from behind them.
#include "clv/cpu/evaluate.h"

#include <gtest/gtest.h>

#include "box_scene.h"
#include "clv/cpu/aligned.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/volume.h"
#include "support/chi_square.h"

using namespace clv;
using test::Box;
using test::BoxScene;

namespace {

const uint kLookups[] = {kClvLookupNearest, kClvLookupTrilinear, kClvLookupLinearFit};
const DepositLayout kLayout{kClvStorageCube, 1};

Level levelOf(const BoxScene& scene, const vec3& lo, int n, float cellSize) {
    ClvVolume volume{};
    volume.origin = lo;
    volume.resolution = ivec3(n);
    volume.cellSize = cellSize;
    BuildOptions options;
    options.linesPerCell = 6;
    return buildLevel(volume, scene.probe(), {}, serialFor(), options);
}

// Deposits such that every side of a slot has irradiance field(centroid).
template <class Field>
AlignedFloats depositsOf(const Level& level, Field&& field) {
    AlignedFloats deposits(level.slots.size() * kLayout.stride(), 0.0f);
    for (std::size_t s = 0; s < level.slots.size(); ++s) {
        for (int side = 0; side < 6; ++side) deposits[s * kLayout.stride() + side] = float(field(level.slots[s].openCentroid)) * level.slots[s].openVolume;
    }
    return deposits;
}

float read(const Level& level, const AlignedFloats& deposits, const ClvReceiver& receiver, const LookupOptions& options) {
    SlotWeights weights;
    lookupWeights(level, receiver, options, weights);
    return readIrradiance(kLayout, deposits, weights, clvReadCoefficients(kLayout.storage, receiver.normal)).x;
}

ClvReceiver receiverAt(const vec3& position, const vec3& normal) { return {position, 0.0f, normal, 0.0f}; }

LookupOptions optionsOf(uint lookup, float ridge = kClvFitRidge) {
    LookupOptions options;
    options.lookup = lookup;
    options.ridge = ridge;
    return options;
}

vec3 randomPoint(uint seed, uint i) { return vec3(test::randomUnit(seed, 3 * i), test::randomUnit(seed, 3 * i + 1), test::randomUnit(seed, 3 * i + 2)); }

TEST(Lookup, everyOneReproducesAConstantFieldOnEverySurfaceOfAScene) {
    const BoxScene scene = test::hall();
    const Level level = levelOf(scene, vec3(-11.0f, -4.1f, -8.2f), 28, 0.8f);
    const AlignedFloats deposits = depositsOf(level, [](const vec3&) { return 3.0; });
    // Receivers where rays from inside the hall meet its surfaces.
    for (uint i = 0; i < 3000; ++i) {
        const vec3 from = vec3(-8.0f, -2.0f, -6.0f) + randomPoint(1, i) * vec3(5.0f, 4.0f, 5.0f), direction = test::randomDirection(2, i);
        float nearest = 1e9f;
        vec3 normal(0.0f);
        scene.crossings(from, direction, 1e9f, [&](float t, bool, const vec3& n) {
            if (t < nearest) nearest = t, normal = dot(n, direction) < 0.0f ? n : -n;
        });
        for (uint lookup : kLookups) {
            ASSERT_NEAR(read(level, deposits, receiverAt(from + direction * nearest, normal), optionsOf(lookup)), 3.0f, 2e-3f) << lookup << " " << i;
        }
    }
}

TEST(Lookup, theLinearFitReproducesALinearFieldOnTheSurfaceAsTheRidgeGoes) {
    // A floor at a place of its own in the cells; the other lookups read the field about half a cell above.
    const BoxScene scene{{{vec3(0.0f, -5.03f, 0.0f), vec3(20.0f, 5.0f, 20.0f)}}};
    const Level level = levelOf(scene, vec3(-2.0f), 16, 0.25f);
    auto field = [](const vec3& p) { return 2.0 + 0.2 * p.x - 0.1 * p.z + 0.3 * p.y; };
    const AlignedFloats deposits = depositsOf(level, field);
    for (uint i = 0; i < 500; ++i) {
        const vec3 p((test::randomUnit(1, i) - 0.5f) * 3.0f, -0.03f, (test::randomUnit(2, i) - 0.5f) * 3.0f);
        const ClvReceiver receiver = receiverAt(p, vec3(0.0f, 1.0f, 0.0f));
        ASSERT_NEAR(read(level, deposits, receiver, optionsOf(kClvLookupLinearFit, 1e-5f)), field(p), 1e-3) << i;
        ASSERT_NEAR(read(level, deposits, receiver, optionsOf(kClvLookupLinearFit)), field(p), 0.02) << i;
    }
}

TEST(Lookup, slotsBehindTheReceiversPlaneAreLeftOut) {
    const Level level = levelOf(BoxScene{}, vec3(-2.0f), 16, 0.25f);
    const AlignedFloats deposits = depositsOf(level, [](const vec3& p) { return p.y > 0.01f ? 1.0 : 1000.0; });
    LookupOptions options = optionsOf(kClvLookupTrilinear);
    const ClvReceiver receiver = receiverAt(vec3(0.1f, 0.01f, 0.07f), vec3(0.0f, 1.0f, 0.0f));
    SlotWeights weights;
    for (uint lookup : {kClvLookupTrilinear, kClvLookupLinearFit}) {
        options.lookup = lookup;
        options.planeCulling = true;
        EXPECT_NEAR(read(level, deposits, receiver, options), 1.0f, 1e-4f);
        lookupWeights(level, receiver, options, weights);
        for (int k = 0; k < weights.count; ++k) EXPECT_GT(level.slots[weights.slot[k]].openCentroid.y, 0.01f);
        options.planeCulling = false;
        lookupWeights(level, receiver, options, weights);
        bool behind = false;
        for (int k = 0; k < weights.count; ++k) behind = behind || level.slots[weights.slot[k]].openCentroid.y < 0.01f;
        EXPECT_EQ(behind, lookup == kClvLookupLinearFit);  // the 8 cells around the point in front all lie before the plane
    }
}

TEST(Lookup, weightsTimesVolumesAddUpToOne) {
    const BoxScene scene{{{vec3(0.0f), vec3(0.7f, 0.6f, 0.5f), false, test::turned(0.3f)}}};
    const Level level = levelOf(scene, vec3(-1.6f), 13, 0.25f);
    SlotWeights weights;
    for (uint i = 0; i < 2000; ++i) {
        const ClvReceiver receiver = receiverAt((randomPoint(1, i) - 0.5f) * 3.0f, test::randomDirection(2, i));
        for (uint lookup : kLookups) {
            lookupWeights(level, receiver, optionsOf(lookup), weights);
            double sum = 0.0;
            for (int k = 0; k < weights.count; ++k) sum += double(weights.weight[k]) * level.slots[weights.slot[k]].openVolume;
            if (weights.count > 0) {
                ASSERT_NEAR(sum, 1.0, 1e-4) << lookup << " " << i;
            }
        }
    }
}

TEST(Lookup, aReceiverOnAWallAtACellFaceReadsTheCellsInFront) {
    // The wall's face lies exactly on a cell face, and a hair to either side of it.
    for (float shift : {0.0f, 1e-5f, -1e-5f}) {
        const BoxScene scene{{{vec3(0.0f, -0.5f + shift, 0.0f), vec3(5.0f, 0.5f, 5.0f)}}};
        const Level level = levelOf(scene, vec3(-1.0f), 8, 0.25f);
        const AlignedFloats deposits = depositsOf(level, [](const vec3& p) { return p.y > 0.0f ? 2.0 : 500.0; });
        for (uint lookup : kLookups) {
            for (const vec3& p : {vec3(0.1f, shift, 0.1f), vec3(0.0f, shift, 0.0f), vec3(0.25f, shift, -0.5f)}) {
                EXPECT_NEAR(read(level, deposits, receiverAt(p, vec3(0.0f, 1.0f, 0.0f)), optionsOf(lookup)), 2.0f, 1e-3f) << lookup << " " << shift;
            }
        }
    }
}

TEST(Lookup, noLightComesThroughAThinWallForAnyPlaceAndTurnOfTheGrid) {
    // A wall of a tenth of a cell with all the light on one side: its dark face reads nothing, its bright face reads all.
    const float h = 0.25f, half = 0.05f * h;
    for (uint i = 0; i < 60; ++i) {
        const float angle = i % 3 == 0 ? 0.0f : 1.2f * test::randomUnit(9, i);
        Box wall{vec3(0.0f), vec3(half, 3.0f, 3.0f), false, test::turned(angle)};
        const BoxScene scene{{wall}};
        const Level level = levelOf(scene, vec3(-1.25f) + h * randomPoint(8, i), 9, h);
        const vec3 normal = wall.axes[0];
        const AlignedFloats deposits = depositsOf(level, [&](const vec3& p) { return dot(p, normal) > 0.0f ? 1.0 : 0.0; });
        double dark = 0.0, bright = 0.0;
        const int receivers = 100;
        for (uint k = 0; k < receivers; ++k) {
            const vec3 along = wall.axes[1] * (1.2f * test::randomUnit(10, k) - 0.6f) + wall.axes[2] * (1.2f * test::randomUnit(11, k) - 0.6f);
            for (uint lookup : kLookups) {
                dark += read(level, deposits, receiverAt(along - normal * half, -normal), optionsOf(lookup)) / 3.0 / receivers;
                bright += read(level, deposits, receiverAt(along + normal * half, normal), optionsOf(lookup)) / 3.0 / receivers;
            }
        }
        EXPECT_LE(dark, 1e-4 * bright) << "grid " << i << " turned by " << angle;
        EXPECT_NEAR(bright, 1.0, 1e-3) << "grid " << i << " turned by " << angle;
    }
}

TEST(Lookup, noLightComesRoundACornerFromTheRoomNextDoor) {
    // A floor and a thin wall on it, all the light on one side: cells behind the wall lie before the floor's plane, only visibility
    // keeps them out. Receivers keep a sixth of a cell off the wall: a thinner sliver between it and a cell face may have no slot.
    const float h = 0.25f;
    double without = 0.0;
    for (uint i = 0; i < 30; ++i) {
        const BoxScene scene{{{vec3(0.0f, -0.5f, 0.0f), vec3(2.0f, 0.5f, 2.0f)}, {vec3(0.0f, 0.9f, 0.0f), vec3(0.012f, 1.0f, 2.0f)}}};
        const Level level = levelOf(scene, vec3(-1.0f) + h * randomPoint(8, i), 8, h);
        const AlignedFloats deposits = depositsOf(level, [](const vec3& p) { return p.x > 0.0f ? 1.0 : 0.0; });
        for (uint k = 0; k < 40; ++k) {
            const ClvReceiver receiver = receiverAt(vec3(-0.05f - 0.2f * test::randomUnit(1, k), 0.0f, 0.8f * test::randomUnit(2, k) - 0.4f), vec3(0.0f, 1.0f, 0.0f));
            for (uint lookup : kLookups) {
                LookupOptions options = optionsOf(lookup);
                EXPECT_LE(read(level, deposits, receiver, options), 1e-4f) << lookup << " grid " << i << " x " << receiver.position.x;
                options.visibility = false;
                without += read(level, deposits, receiver, options);
            }
        }
    }
    EXPECT_GT(without / (30 * 40 * 3), 0.05);
}

TEST(Lookup, whereNothingIsOpenNothingIsRead) {
    const BoxScene scene{{{vec3(0.0f), vec3(1.2f)}}};
    const Level level = levelOf(scene, vec3(-0.5f), 4, 0.25f);
    SlotWeights weights;
    for (uint lookup : kLookups) {
        lookupWeights(level, receiverAt(vec3(0.0f), vec3(0.0f, 1.0f, 0.0f)), optionsOf(lookup), weights);
        EXPECT_EQ(weights.count, 0);
        EXPECT_EQ(readIrradiance(kLayout, {}, weights, clvReadCoefficients(kLayout.storage, vec3(0.0f, 1.0f, 0.0f))), vec3(0.0f));
    }
}

TEST(Lookup, negativeReadingsAreClampedAndGreyRecordsGiveThreeEqualChannels) {
    SlotWeights weights;
    weights.count = 1;
    weights.slot[0] = 0;
    weights.weight[0] = 2.0f;
    const AlignedFloats deposits{1.0f, 3.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const vec3 x(1.0f, 0.0f, 0.0f);
    EXPECT_EQ(readIrradiance(kLayout, deposits, weights, clvReadCoefficients(kClvStorageCube, x)), vec3(2.0f));
    EXPECT_EQ(readIrradiance(kLayout, deposits, weights, clvReadCoefficients(kClvStorageCube, -x)), vec3(6.0f));
    const AlignedFloats below{-1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    EXPECT_EQ(readIrradiance(kLayout, below, weights, clvReadCoefficients(kClvStorageCube, x)), vec3(0.0f));
}

TEST(Lookup, theMeanOfTwoHalvesReadsAsTheyDoTogether) {
    const AlignedFloats a(70000, 3.0f), b(70000, -1.0f);
    AlignedFloats mean;
    averageHalves(a, b, serialFor(), mean);
    EXPECT_EQ(mean, AlignedFloats(70000, 1.0f));
}

}  // namespace
