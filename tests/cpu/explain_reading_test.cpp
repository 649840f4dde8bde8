// A reading taken apart adds up to what evaluate returns, and says why cells were left out.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>

#include "clv/cpu/build_level.h"
#include "clv/cpu/explain_reading.h"
#include "clv/math/hash.h"
#include "cpu/moving_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

float random(uint i) { return clvUnitFloat(clvHash(i)); }

// A level over the hall, with the light of a few rays.
struct LitLevelOfHall {
    LitHall hall;
    DepositLayout layout;
    Level level;
    std::vector<float> deposits[2];

    explicit LitLevelOfHall(uint storage = kClvStorageCube9) {
        layout.storage = storage;
        level = buildLevel(volumeOverBounds(vec3(-10.03f, -3.02f, -7.01f), vec3(10.03f, 3.02f, 7.01f), 9, storage), hall.scene.probe(), {}, serialFor(), {.linesPerCell = 3});
        FrameRays rays({.halves = 2, .chunks = 1}, 3, 1e-4f);
        rays.draw(hall.sampler, 4000, serialFor());
        rays.trace(hall.tracer(), serialFor());
        Volume volume(level, layout, {.halves = 2, .chunks = 1});
        for (std::size_t half = 0; half < 2; ++half) inject(level, layout, kClvInjectTrackLength, rays.part(half), volume.partial(int(half), 0));
        volume.merge(4000.0, 1.0f / 2000.0f, serialFor());
        for (int half = 0; half < 2; ++half) deposits[half].assign(volume.history(half).begin(), volume.history(half).end());
    }
    Reading explain(const ClvReceiver& receiver, const LookupOptions& options = {}) const {
        return explainReading(level, layout, std::array<std::span<const float>, 2>{deposits[0], deposits[1]}, receiver, options);
    }
    Reading explainHalf(int half, const ClvReceiver& receiver, const LookupOptions& options) const {
        return explainReading(level, layout, std::array<std::span<const float>, 1>{deposits[half]}, receiver, options);
    }
    // Sum of the magnitudes of all that is added up: coefficient by coefficient, term by term.
    float magnitudeOfHalf(int half, const Reading& reading, const ClvReceiver& receiver) const {
        std::vector<float> positive = deposits[half];
        for (float& value : positive) value = std::abs(value);
        ClvCoefficients read = layout.read(receiver.normal);
        read = {abs(read.a), abs(read.b), std::abs(read.c)};
        vec3 sum(0.0f);
        for (const ReadingTerm& term : reading.terms) {
            const float share = std::abs(term.share);
            if (term.use == TermUse::read) sum += readRecords(layout, positive, {&term.slot, 1}, {&share, 1}, read);
        }
        return length(sum);
    }
    vec3 evaluateHalf(int half, const ClvReceiver& receiver, const LookupOptions& options) const {
        SlotWeights weights;
        lookupWeights(level, receiver, options, weights);
        return readIrradiance(layout, deposits[half], weights, layout.read(receiver.normal));
    }
};

// On the floor, on both sides of the thin wall, in the air, and outside.
std::vector<ClvReceiver> receivers() {
    std::vector<ClvReceiver> all;
    for (uint i = 0; i < 60; ++i) {
        const float x = 20.0f * random(4 * i) - 10.0f, z = 9.0f * random(4 * i + 1) - 7.0f;
        all.push_back({vec3(x, -3.02f, z), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
        all.push_back({vec3(1.33f, 3.0f * random(4 * i + 2) - 2.9f, z), 0.0f, vec3(-1.0f, 0.0f, 0.0f), 0.0f});
        all.push_back({vec3(1.41f, 3.0f * random(4 * i + 2) - 2.9f, z), 0.0f, vec3(1.0f, 0.0f, 0.0f), 0.0f});
        all.push_back({vec3(x, 5.0f * random(4 * i + 3) - 2.5f, z), 0.0f, normalize(vec3(random(i) - 0.5f, random(i + 1) - 0.5f, random(i + 2) - 0.4f)), 0.0f});
    }
    all.push_back({vec3(30.0f, 0.0f, 0.0f), 0.0f, vec3(-1.0f, 0.0f, 0.0f), 0.0f});
    return all;
}

vec3 sumOfTerms(const Reading& reading) {
    vec3 sum(0.0f);
    for (const ReadingTerm& term : reading.terms) sum += term.irradiance;
    return sum;
}

TEST(ExplainReading, termsAddUpToWhatEvaluateReturns) {
    for (const uint storage : {kClvStorageCube9, kClvStorageSh1}) {
        const LitLevelOfHall lit(storage);
        for (const uint lookup : {kClvLookupNearest, kClvLookupTrilinear, kClvLookupLinearFit}) {
            int bright = 0, negative = 0;
            for (const ClvReceiver& receiver : receivers()) {
                const Reading reading = lit.explainHalf(0, receiver, {.lookup = lookup});
                EXPECT_EQ(reading.irradiance, lit.evaluateHalf(0, receiver, {.lookup = lookup}));
                const float size = lit.magnitudeOfHalf(0, reading, receiver);
                const vec3 sum = sumOfTerms(reading);
                // What rounding may do to a sum of so many.
                const float rounding = float(reading.terms.size()) * std::numeric_limits<float>::epsilon() * size;
                EXPECT_LE(length(reading.irradiance - max(sum, vec3(0.0f))), rounding);
                bright += reading.irradiance.x > 0.0f ? 1 : 0;
                negative += sum.x < 0.0f ? 1 : 0;
            }
            EXPECT_GT(bright, 150);
            EXPECT_GT(negative, 0);
        }
    }
}

TEST(ExplainReading, severalEstimatesAreReadAsTheirMean) {
    const LitLevelOfHall lit;
    for (const ClvReceiver& receiver : receivers()) {
        const Reading both = lit.explain(receiver), a = lit.explainHalf(0, receiver, {}), b = lit.explainHalf(1, receiver, {});
        EXPECT_EQ(both.irradiance, 0.5f * a.irradiance + 0.5f * b.irradiance);
        ASSERT_EQ(both.terms.size(), a.terms.size());
        for (std::size_t i = 0; i < a.terms.size(); ++i) EXPECT_EQ(both.terms[i].irradiance, 0.5f * a.terms[i].irradiance + 0.5f * b.terms[i].irradiance);
    }
}

TEST(ExplainReading, everyTermSaysWhyItIsLeftOut) {
    const LitLevelOfHall lit;
    std::map<TermUse, int> seen;
    for (const uint lookup : {kClvLookupTrilinear, kClvLookupLinearFit}) {
        for (const ClvReceiver& receiver : receivers()) {
            const LookupOptions options{.lookup = lookup};
            const Reading reading = lit.explain(receiver, options);
            for (const ReadingTerm& term : reading.terms) {
                ++seen[term.use];
                if (term.use != TermUse::read) {
                    EXPECT_EQ(term.share, 0.0f);
                    EXPECT_EQ(term.irradiance, vec3(0.0f));
                }
                if (term.use == TermUse::read && !reading.hubAlone) {
                    EXPECT_GT(term.height, 0.0f);
                }
                if (term.use == TermUse::behind) {
                    EXPECT_LE(term.height, 0.0f);
                }
                if (term.use == TermUse::outside) {
                    EXPECT_EQ(term.weight, 0.0f);
                }
                EXPECT_EQ(term.use == TermUse::noSlot, term.slot == kClvNoSlot);
                if (term.slot == kClvNoSlot) continue;
                EXPECT_EQ(clvCellIndex(lit.level.volume, term.cell), lit.level.slots[term.slot].cell);
                EXPECT_EQ(term.openVolume, lit.level.slots[term.slot].openVolume);
            }
        }
    }
    for (const TermUse use : {TermUse::read, TermUse::behind, TermUse::hidden, TermUse::outside}) EXPECT_GT(seen[use], 0) << int(use);
}

TEST(ExplainReading, weightsOfATrilinearReadingAreSharesOfOne) {
    const LitLevelOfHall lit;
    for (const ClvReceiver& receiver : receivers()) {
        const Reading reading = lit.explain(receiver, {.lookup = kClvLookupTrilinear});
        double shares = 0.0;
        for (const ReadingTerm& term : reading.terms) shares += double(term.share) * double(term.openVolume);
        if (reading.hub.slot != kClvNoSlot) {
            EXPECT_NEAR(shares, 1.0, 1e-5);
        }
    }
}

TEST(ExplainReading, withoutPlaneCullingNothingIsBehind) {
    const LitLevelOfHall lit;
    int behind = 0;
    for (const ClvReceiver& receiver : receivers()) {
        for (const ReadingTerm& term : lit.explain(receiver, {.planeCulling = false, .visibility = false}).terms) {
            EXPECT_NE(term.use, TermUse::behind);
            EXPECT_NE(term.use, TermUse::hidden);
            behind += term.use == TermUse::read && term.height < 0.0f ? 1 : 0;
        }
    }
    EXPECT_GT(behind, 0);
}

}  // namespace
