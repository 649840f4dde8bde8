#include "clv/cpu/texel_sampler.h"

#include <gtest/gtest.h>

#include <functional>

#include "clv/math/sobol.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

// The largest number below 1 that a sample takes.
const float kLast = 1.0f - 1.0f / 16777216.0f;

struct Picked {
    int item;
    float probability;
};

Picked pick(const DiscreteRows& rows, int row, float u) {
    Picked picked{};
    rows.sample(1, &row, &u, &picked.item, &picked.probability);
    return picked;
}

DiscreteRows oneRow(const std::vector<double>& weights) {
    DiscreteRows rows;
    rows.resize(1, int(weights.size()));
    rows.build(0, [&](int i) { return weights[i]; });
    rows.finish();
    return rows;
}

// Smooth, spiky, sparse and lopsided weights: what guide tables find hard.
std::vector<std::vector<double>> awkwardWeights() {
    std::vector<std::vector<double>> all;
    auto add = [&](int n, const std::function<double(int)>& weight) {
        std::vector<double> w(n);
        for (int i = 0; i < n; ++i) w[i] = weight(i);
        all.push_back(w);
    };
    add(1, [](int) { return 3.0; });
    add(3, [](int i) { return double(i == 1); });
    add(256, [](int) { return 1.0; });
    add(255, [](int i) { return 1.0 + i % 7; });
    add(301, [](int i) { return i == 170 ? 1e6 : 1e-3; });
    add(512, [](int i) { return i % 5 ? 0.0 : 1.0 + i; });
    add(128, [](int i) { return std::pow(0.5, i); });
    add(200, [](int i) { return i < 150 ? 0.0 : 1.0; });
    add(200, [](int i) { return i < 50 ? 1.0 : 0.0; });
    add(64, [](int i) { return i == 0 || i == 63 ? 1.0 : 0.0; });
    return all;
}

TEST(DiscreteRows, invertTheCumulativeSumAsASearchFromTheFirstItemWould) {
    for (const std::vector<double>& weights : awkwardWeights()) {
        const DiscreteRows rows = oneRow(weights);
        double total = 0.0;
        for (double w : weights) total += w;
        std::vector<float> sums(1, 0.0f);
        double sum = 0.0;
        for (double w : weights) sums.push_back(float((sum += w) / total));
        std::vector<float> us{0.0f, kLast, 0.5f};
        for (float s : sums) {
            if (s < 1.0f) us.push_back(s);
            if (s > 0.0f) us.push_back(std::nextafter(s, 0.0f));
        }
        for (uint i = 0; i < 5000; ++i) us.push_back(clvSobolUnit(i, 0u, 3u));
        for (float u : us) {
            std::size_t expected = 0;
            while (sums[expected + 1] <= u) ++expected;
            const Picked picked = pick(rows, 0, u);
            ASSERT_EQ(picked.item, int(expected)) << "u " << u << " of " << weights.size();
            ASSERT_EQ(picked.probability, sums[expected + 1] - sums[expected]);
            ASSERT_GT(weights[expected], 0.0);
        }
    }
}

TEST(DiscreteRows, aRowWithoutWeightGivesProbabilityZero) {
    const DiscreteRows rows = oneRow(std::vector<double>(100, 0.0));
    for (float u : {0.0f, 0.3f, kLast}) {
        const Picked picked = pick(rows, 0, u);
        EXPECT_EQ(picked.probability, 0.0f);
        EXPECT_GE(picked.item, 0);
        EXPECT_LT(picked.item, 100);
    }
}

TEST(DiscreteRows, rowsDoNotDisturbEachOther) {
    // The spiky row needs more steps than the others: they must come out as they do alone.
    const int n = 64;
    auto weight = [](int row, int i) { return row == 1 ? (i == 40 ? 1e5 : 1e-2) : row == 2 ? 0.0 : 1.0 + (i * 7 + row) % 5; };
    DiscreteRows together;
    together.resize(4, n);
    for (int row = 0; row < 4; ++row) together.build(row, [&](int i) { return weight(row, i); });
    together.finish();
    for (int row = 0; row < 4; ++row) {
        std::vector<double> weights(n);
        for (int i = 0; i < n; ++i) weights[i] = weight(row, i);
        const DiscreteRows alone = oneRow(weights);
        for (uint i = 0; i < 2000; ++i) {
            const float u = clvSobolUnit(i, 1u, 5u);
            ASSERT_EQ(pick(together, row, u).probability, pick(alone, 0, u).probability);
            if (row != 2) {
                ASSERT_EQ(pick(together, row, u).item, pick(alone, 0, u).item);
            }
        }
    }
}

// Texel i is recognised by its position.
std::vector<ClvRsmTexel> texelsOf(int width, int height, const std::function<vec3(int, int)>& flux) {
    std::vector<ClvRsmTexel> texels(std::size_t(width) * height);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = {};
        texels[i].valid = 1u;
        texels[i].position.x = float(i);
        texels[i].flux = flux(int(i) % width, int(i) / width);
    }
    return texels;
}

TEST(TexelSampler, picksTexelsInProportionToTheirFlux) {
    const int width = 15, height = 17;
    auto texels = texelsOf(width, height, [](int x, int y) { return vec3(1.0f + float(x), 0.5f * float(y), 1.0f); });
    TexelSampler sampler;
    sampler.build(texels, width, serialFor());
    double total = 0.0;
    for (const ClvRsmTexel& t : texels) total += double(t.flux.x) + t.flux.y + t.flux.z;
    EXPECT_NEAR(sampler.totalFlux(), total, 1e-9 * total);
    const int blocks = 400, count = TexelSampler::kBlock;
    std::vector<double> counts(texels.size(), 0.0), expected(texels.size());
    std::vector<ClvRsmTexel> picked(count);
    std::vector<float> u(count), v(count), probability(count);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        expected[i] = (double(texels[i].flux.x) + texels[i].flux.y + texels[i].flux.z) / total * blocks * count;
    }
    for (int block = 0; block < blocks; ++block) {
        for (int k = 0; k < count; ++k) {
            u[k] = test::randomUnit(1u, uint(block * count + k));
            v[k] = test::randomUnit(2u, uint(block * count + k));
        }
        sampler.sample(count, u.data(), v.data(), picked.data(), probability.data());
        for (int k = 0; k < count; ++k) {
            const std::size_t i = std::size_t(picked[k].position.x);
            counts[i] += 1.0;
            ASSERT_NEAR(probability[k] * blocks * count / expected[i], 1.0, 1e-4);
        }
    }
    EXPECT_GT(test::chiSquareChance(counts, expected), 1e-4);
}

TEST(TexelSampler, neverPicksATexelWithoutAFiniteFluxOrASurface) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    auto texels = texelsOf(8, 4, [](int, int) { return vec3(1.0f); });
    texels[3].flux.x = nan;
    texels[9].flux.y = infinity;
    texels[12].flux = vec3(-2.0f);
    texels[17].valid = 0u;
    texels[31].flux = vec3(0.0f);
    TexelSampler sampler;
    sampler.build(texels, 8, serialFor());
    EXPECT_DOUBLE_EQ(sampler.totalFlux(), 3.0 * (32 - 5));
    ClvRsmTexel picked;
    for (uint i = 0; i < 20000; ++i) {
        const float u = clvSobolUnit(i, 0u, 1u), v = clvSobolUnit(i, 1u, 1u);
        float probability = 0.0f;
        sampler.sample(1, &u, &v, &picked, &probability);
        ASSERT_GT(probability, 0.0f);
        for (int bad : {3, 9, 12, 17, 31}) ASSERT_NE(picked.position.x, float(bad));
    }
}

TEST(TexelSampler, isEmptyWithoutLight) {
    auto dark = texelsOf(4, 4, [](int, int) { return vec3(0.0f); });
    TexelSampler sampler;
    sampler.build(dark, 4, serialFor());
    EXPECT_TRUE(sampler.empty());
    auto lit = texelsOf(4, 4, [](int x, int y) { return vec3(x == 2 && y == 3 ? 1.0f : 0.0f); });
    sampler.build(lit, 4, serialFor());
    EXPECT_FALSE(sampler.empty());
}

}  // namespace
