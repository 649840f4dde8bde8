#include "clv/cpu/inject.h"

#include <gtest/gtest.h>

#include <limits>

#include "clv/cpu/aligned.h"
#include "clv/cpu/evaluate.h"
#include "support/chi_square.h"
#include "support/rotation.h"
#include "support/z_test.h"

using namespace clv;

namespace {

const uint kStorages[] = {kClvStorageCube, kClvStorageCube9, kClvStorageSh1, kClvStorageSh2};

// A grid over the unit cube, every cell open, slots in a shuffled order.
Level openLevel(int n) {
    Level level;
    level.volume = {};
    level.volume.resolution = ivec3(n);
    level.volume.scroll = ivec3(1 % n, 0, n - 1);
    level.volume.cellSize = 1.0f / float(n);
    const float h = level.volume.cellSize;
    const uint cells = uint(n * n * n);
    level.table.resize(cells);
    level.slots.resize(cells);
    for (uint i = 0; i < cells; ++i) {
        const uint slot = (i * 7919u) % cells;
        level.table[i] = slot;
        level.slots[slot] = {clvCellCenter(level.volume, clvCellFromIndex(level.volume, i)), h * h * h, uvec4(~0u), i, 0, 0, 0};
    }
    return level;
}

ClvRay rayOf(const vec3& origin, const vec3& direction, float distance, const vec3& flux) {
    ClvRay ray{};
    ray.origin = origin;
    ray.direction = direction;
    ray.maxDistance = distance;
    ray.flux = flux;
    return ray;
}

std::vector<ClvRay> someRays(int count) {
    std::vector<ClvRay> rays;
    for (uint i = 0; i < uint(count); ++i) {
        const vec3 origin(test::randomUnit(1, i), test::randomUnit(2, i), test::randomUnit(3, i));
        rays.push_back(rayOf(origin, test::randomDirection(4, i), test::randomUnit(5, i), vec3(1.0f, 2.0f, 0.5f) * test::randomUnit(6, i)));
        rays.back().dynamicity = test::randomUnit(7, i);
    }
    return rays;
}

AlignedFloats injected(const Level& level, const DepositLayout& layout, std::span<const ClvRay> rays, uint rule = kClvInjectTrackLength) {
    AlignedFloats deposits(level.slots.size() * layout.stride(), 0.0f);
    inject(level, layout, rule, rays, {deposits, {}});
    return deposits;
}

vec3 readCell(const Level& level, const DepositLayout& layout, const AlignedFloats& deposits, const ivec3& cell, const vec3& normal) {
    SlotWeights weights;
    weights.count = 1;
    weights.slot[0] = level.table[clvCellIndex(level.volume, cell)];
    weights.weight[0] = 1.0f / level.slots[weights.slot[0]].openVolume;
    return readIrradiance(layout, deposits, weights, layout.read(normal));
}

TEST(Inject, aParallelBeamGivesEveryCellItCrossesFluxOverAreaTimesTheCosine) {
    // 8 x 8 rays through each face cell, together flux / area = 3 W/m^2 on a plane across the beam.
    const int n = 8, perCell = 8, across = n * perCell;
    const Level level = openLevel(n);
    const float density = 3.0f;
    for (const vec3& d : {vec3(0.0f, -1.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f), normalize(vec3(1.0f, -2.0f, 0.0f)),
                          normalize(vec3(0.5f, -1.0f, 2.0f))}) {
        // Rays start on a lattice in a plane far outside, wide enough for every cell.
        vec3 tangent, bitangent;
        clvBasis(d, tangent, bitangent);
        const float spacing = 1.0f / float(across), flux = density * spacing * spacing;
        std::vector<ClvRay> rays;
        for (int j = -across; j < across; ++j) {
            for (int i = -across; i < across; ++i) {
                const vec3 start = vec3(0.5f) - d * 3.0f + tangent * ((float(i) + 0.5f) * spacing) + bitangent * ((float(j) + 0.5f) * spacing);
                rays.push_back(rayOf(start, d, 10.0f, vec3(flux)));
            }
        }
        // Square to the axes the lattice measures volumes exactly, else by a few rays' worth.
        const bool square = std::max(std::abs(d.x), std::max(std::abs(d.y), std::abs(d.z))) > 0.9999f;
        const float tolerance = (square ? 1e-4f : 0.04f) * density;
        for (uint storage : kStorages) {
            const DepositLayout layout{storage, 3};
            const AlignedFloats deposits = injected(level, layout, rays);
            for (const ivec3& cell : {ivec3(0), ivec3(3, 4, 5), ivec3(7, 0, 7)}) {
                for (const vec3& normal : {vec3(0, 1, 0), vec3(-1, 0, 0), vec3(0, 0, -1), vec3(0, -1, 0), vec3(-0.6f, 0.8f, 0.0f)}) {
                    const float cosine = -dot(d, normal);
                    const float lobe = std::max(0.0f, 0.25f + 0.5f * cosine + (storage == kClvStorageSh2 ? 0.15625f * (3.0f * cosine * cosine - 1.0f) : 0.0f));
                    const bool cube = storage == kClvStorageCube || storage == kClvStorageCube9;
                    const bool onAxis = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z) < 1.001f;
                    if (cube && !onAxis) continue;
                    const float expected = density * (cube ? std::max(0.0f, cosine) : lobe);
                    ASSERT_NEAR(readCell(level, layout, deposits, cell, normal).y, expected, tolerance) << "storage " << storage;
                }
            }
        }
    }
}

TEST(Inject, aFrameSquareToAWallReadsNothingOfWhatTheWallSendsOut) {
    const Level level = openLevel(4);
    const mat3 frame = test::turned(0.7f, vec3(0.3f, -0.5f, 0.8f));
    const vec3 wall = vec3(1.0f, 0.0f, 0.0f) * frame;  // axis 0, in the volume's space
    std::vector<ClvRay> away;
    float received = 0.0f;
    for (const ClvRay& ray : someRays(200)) {
        away.push_back(ray);
        if (dot(away.back().direction, wall) < 0.0f) away.back().direction = -away.back().direction;
    }
    for (const bool turned : {false, true}) {
        DepositLayout layout{kClvStorageCube9, 3};
        if (turned) layout.frame = frame;
        const AlignedFloats deposits = injected(level, layout, away);
        float read = 0.0f, sent = 0.0f;
        for (uint cell = 0; cell < level.slots.size(); ++cell) {
            const ivec3 at = clvCellFromIndex(level.volume, cell);
            read += readCell(level, layout, deposits, at, wall).y;
            sent += readCell(level, layout, deposits, at, -wall).y;
        }
        ASSERT_GT(sent, 0.0f);
        if (turned) EXPECT_LT(read, 1e-5f * sent);
        else EXPECT_GT(read, 1e-3f * sent);
        if (turned) received = sent;
    }
    // Flux * cosine * length over the volume of a cell, which is exact along the axes of the frame.
    double expected = 0.0;
    for (ClvRay& ray : away) {
        double inside = ray.maxDistance;
        for (int axis = 0; axis < 3; ++axis) inside = std::min(inside, ((ray.direction[axis] > 0.0f ? 1.0 : 0.0) - ray.origin[axis]) / ray.direction[axis]);
        expected += ray.flux.y * inside * dot(ray.direction, wall);
    }
    EXPECT_NEAR(received, expected * double(level.slots.size()), 1e-4 * received);
}

TEST(Inject, everyCellOfAnIsotropicFieldHasTheSameIrradiance) {
    // Rays across the unit cube from its walls, cosine-weighted and uniform over them, as inside a furnace: radiance 1 W/(m^2 sr),
    // irradiance pi in every cell and on every side.
    const int n = 6, batches = 24, perBatch = 20000;
    const Level level = openLevel(n);
    const DepositLayout layout{kClvStorageCube9, 1};
    const float flux = 6.0f * kClvPi / float(perBatch);  // W a ray: area times pi
    std::vector<test::MeanOf> means(std::size_t(n) * n * n * 6);
    for (uint batch = 0; batch < batches; ++batch) {
        std::vector<ClvRay> rays;
        for (uint i = 0; i < perBatch; ++i) {
            const uint number = batch * perBatch + i, face = number % 6;
            vec3 normal(0.0f), origin(test::randomUnit(1, number), test::randomUnit(2, number), test::randomUnit(3, number));
            normal[int(face / 2)] = face % 2 ? 1.0f : -1.0f;
            origin[int(face / 2)] = face % 2 ? 0.0f : 1.0f;
            rays.push_back(rayOf(origin, clvCosineFromSquare(vec2(test::randomUnit(4, number), test::randomUnit(5, number)), normal), 10.0f, vec3(flux)));
        }
        const AlignedFloats deposits = injected(level, layout, rays);
        for (std::size_t slot = 0; slot < level.slots.size(); ++slot) {
            for (int side = 0; side < 6; ++side) means[slot * 6 + side].add(deposits[slot * layout.stride() + side] / level.slots[slot].openVolume);
        }
    }
    test::ZTest z;
    for (std::size_t i = 0; i < means.size(); ++i) z.add("slot " + std::to_string(i / 6) + " side " + std::to_string(i % 6), means[i], kClvPi);
    EXPECT_TRUE(z.agrees());
}

TEST(Inject, sidesAddUpToFluxTimesLength) {
    // Over the whole grid, sum of side values = flux * (|dx| + |dy| + |dz|) * length inside.
    const Level level = openLevel(16);
    const DepositLayout layout{kClvStorageCube, 3};
    const auto rays = someRays(20000);
    double expected = 0.0, sum = 0.0;
    for (const ClvRay& ray : rays) {
        double inside = ray.maxDistance;
        for (int axis = 0; axis < 3; ++axis) inside = std::min(inside, ((ray.direction[axis] > 0.0f ? 1.0 : 0.0) - ray.origin[axis]) / ray.direction[axis]);
        expected += ray.flux.y * inside * (std::abs(ray.direction.x) + std::abs(ray.direction.y) + std::abs(ray.direction.z));
    }
    const AlignedFloats deposits = injected(level, layout, rays);
    for (std::size_t slot = 0; slot < level.slots.size(); ++slot) {
        for (int side = 0; side < 6; ++side) sum += deposits[slot * layout.stride() + 3 * side + 1];
    }
    EXPECT_NEAR(sum / expected, 1.0, 1e-5);
}

TEST(Inject, isLinearInTheFlux) {
    const Level level = openLevel(12);
    for (uint storage : kStorages) {
        const DepositLayout layout{storage, 3};
        auto rays = someRays(3000);
        const AlignedFloats once = injected(level, layout, rays);
        for (ClvRay& ray : rays) ray.flux *= 4.0f;
        const AlignedFloats four = injected(level, layout, rays);
        for (std::size_t i = 0; i < once.size(); ++i) ASSERT_EQ(four[i], 4.0f * once[i]) << i;  // powers of two do not round
    }
}

TEST(Inject, aGreyLayoutHoldsTheMeanOfTheChannels) {
    const Level level = openLevel(12);
    for (uint storage : kStorages) {
        const DepositLayout colour{storage, 3}, grey{storage, 1};
        const auto rays = someRays(3000);
        const AlignedFloats rgb = injected(level, colour, rays), one = injected(level, grey, rays);
        for (std::size_t slot = 0; slot < level.slots.size(); ++slot) {
            for (uint k = 0; k < clvCoefficientCount(storage); ++k) {
                const float* c = rgb.data() + slot * colour.stride() + 3 * k;
                ASSERT_NEAR(one[slot * grey.stride() + k], (c[0] + c[1] + c[2]) / 3.0f, 2e-5f);
            }
        }
    }
}

TEST(Inject, paddingStaysZero) {
    const Level level = openLevel(4);
    for (uint storage : kStorages) {
        for (int channels : {1, 3}) {
            const DepositLayout layout{storage, channels};
            const AlignedFloats deposits = injected(level, layout, someRays(500));
            for (std::size_t i = 0; i < deposits.size(); ++i) {
                if (int(i % layout.stride()) >= layout.values()) {
                    ASSERT_EQ(deposits[i], 0.0f);
                }
            }
        }
    }
}

TEST(Inject, whatIsNotFiniteAddsNothingAndHarmsNoOther) {
    const Level level = openLevel(8);
    const DepositLayout layout{kClvStorageCube9, 3};
    const auto good = someRays(64);
    // Every other ray is bad, so that good ones share packets with bad ones.
    std::vector<ClvRay> mixed, dead;
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (uint i = 0; i < good.size(); ++i) {
        ClvRay ray = good[i];
        float* values[] = {&ray.origin.x, &ray.direction.y, &ray.flux.x, &ray.flux.z};
        *values[i % 4] = bad[i % 3];
        mixed.push_back(ray);
        mixed.push_back(good[i]);
        dead.push_back(rayOf(vec3(0.0f), vec3(0.0f, 1.0f, 0.0f), 0.0f, vec3(0.0f)));
        dead.push_back(good[i]);
    }
    EXPECT_EQ(injected(level, layout, mixed), injected(level, layout, dead));
}

// Rays as bright as floats are, along a grid, a thousand a cell: sums stay numbers, whatever the storage.
TEST(Inject, theBrightestRaysAddUpToNumbers) {
    Level level = openLevel(8);
    std::vector<ClvRay> rays = someRays(4000);
    for (uint i = 0; i < rays.size(); ++i) rays[i].flux = vec3(i % 5 == 0 ? -3e38f : 3e38f), rays[i].maxDistance = 1e30f;
    for (uint storage : kStorages) {
        for (float cellSize : {1e-9f, 1.0f, 1e5f}) {
            const float scale = cellSize / level.volume.cellSize;
            level.volume.origin *= scale, level.volume.cellSize = cellSize;
            for (ClvRay& ray : rays) ray.origin *= scale;
            for (float value : injected(level, {storage, 3}, rays)) ASSERT_TRUE(std::isfinite(value)) << storage << ", " << cellSize;
        }
    }
}

// A float stops growing at 2^24 times what is added to it.
TEST(Inject, twentyMillionRaysThroughOneCellAreAllCounted) {
    Level level = openLevel(1);
    const DepositLayout layout{kClvStorageCube, 1};
    const std::vector<ClvRay> rays(20'000'000, rayOf(vec3(0.1f, 0.5f, 0.5f), vec3(1.0f, 0.0f, 0.0f), 0.5f, vec3(1.0f)));
    AlignedFloats deposits(level.slots.size() * layout.stride(), 0.0f);
    inject(level, layout, kClvInjectTrackLength, rays, {deposits, {}});
    EXPECT_NEAR(deposits[1], 1e7, 1e3);
}

TEST(Inject, whatHasNoDirectionAddsNothing) {
    const Level level = openLevel(4);
    for (uint storage : kStorages) {
        for (const vec3& direction : {vec3(0.0f), vec3(1e-30f, 0.0f, 0.0f), vec3(1e30f), vec3(-0.0f, 3e-45f, 0.0f)}) {
            const std::vector<ClvRay> rays{rayOf(vec3(0.2f, 0.1f, 0.6f), direction, 1e30f, vec3(1.0f))};
            for (float value : injected(level, {storage, 3}, rays)) ASSERT_EQ(value, 0.0f) << storage << ", " << direction.x;
        }
    }
}

TEST(Inject, dynamicityOfASideIsTheLargestAmongTheRaysThatLightIt) {
    const Level level = openLevel(4);
    const DepositLayout layout{kClvStorageCube9, 3};
    AlignedFloats deposits(level.slots.size() * layout.stride(), 0.0f);
    std::vector<float> dynamicity(level.slots.size() * 6, 0.0f);
    // Both travel along +x and light the side -x; one of them along -y too, which lights the side +y.
    std::vector<ClvRay> rays{rayOf(vec3(0.1f, 0.6f, 0.6f), vec3(1.0f, 0.0f, 0.0f), 0.8f, vec3(1.0f)),
                             rayOf(vec3(0.55f, 0.7f, 0.6f), normalize(vec3(1.0f, -1.0f, 0.0f)), 0.1f, vec3(1.0f))};
    rays[0].dynamicity = 0.7f;
    rays[1].dynamicity = 0.4f;
    inject(level, layout, kClvInjectTrackLength, rays, {deposits, dynamicity});
    auto side = [&](const ivec3& cell, int k) { return dynamicity[level.table[clvCellIndex(level.volume, cell)] * 6 + k]; };
    EXPECT_EQ(side(ivec3(2, 2, 2), 1), 0.7f);
    EXPECT_EQ(side(ivec3(2, 2, 2), 2), 0.4f);
    EXPECT_EQ(side(ivec3(2, 2, 2), 0), 0.0f);
    EXPECT_EQ(side(ivec3(0, 2, 2), 1), 0.7f);
    EXPECT_EQ(side(ivec3(0, 2, 2), 2), 0.0f);
    EXPECT_EQ(side(ivec3(0, 0, 0), 1), 0.0f);
}

TEST(Inject, aSplitCellGetsEachPieceOnItsMiddlesSide) {
    Level level = openLevel(1);
    level.volume.scroll = ivec3(0);
    level.slots.push_back(level.slots[0]);
    level.splits.push_back({vec4(1.0f, 0.0f, 0.0f, 0.5f), 0u, 1u, 0u, 2u});
    level.table[0] = kClvSplitBit;
    const DepositLayout layout{kClvStorageCube, 1};
    const std::vector<ClvRay> rays{rayOf(vec3(0.2f, 0.1f, 0.5f), vec3(0.0f, 1.0f, 0.0f), 0.5f, vec3(1.0f)),
                                   rayOf(vec3(0.8f, 0.1f, 0.5f), vec3(0.0f, 1.0f, 0.0f), 0.25f, vec3(2.0f))};
    const AlignedFloats deposits = injected(level, layout, rays);
    EXPECT_FLOAT_EQ(deposits[layout.stride() + 3], 0.5f);
    EXPECT_FLOAT_EQ(deposits[3], 0.5f);
}

TEST(Inject, theThesisRuleSkipsTheCellThatTheRayStartsInAndIgnoresLengths) {
    const Level level = openLevel(4);
    const DepositLayout layout{kClvStorageCube, 1};
    const std::vector<ClvRay> rays{rayOf(vec3(0.2f, 0.1f, 0.6f), vec3(1.0f, 0.0f, 0.0f), 0.4f, vec3(5.0f))};
    const AlignedFloats deposits = injected(level, layout, rays, kClvInjectThesis);
    for (int x = 0; x < 4; ++x) {
        const float value = deposits[level.table[clvCellIndex(level.volume, ivec3(x, 0, 2))] * layout.stride() + 1];
        EXPECT_EQ(value, x == 1 || x == 2 ? 5.0f : 0.0f) << x;
    }
}

}  // namespace
