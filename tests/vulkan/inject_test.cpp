// Every way to inject adds up what the CPU adds up, slot by slot.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "clv/cpu/aligned.h"
#include "clv/cpu/inject.h"
#include "support/rotation.h"
#include "vulkan/level_scene.h"

using namespace clv;
using namespace clv::test;

namespace inject_test {

constexpr std::uint32_t kRays = 4096;  // a power of two: history times rays is the sum of deposits without another rounding
constexpr float kLargestFlux = 1.5f;
constexpr double kUnit = 0x1p-24;      // rounding of a float

LightFrameSettings settingsFor(InjectWay way, const DepositLayout& layout) {
    LightFrameSettings settings;
    settings.rays = kRays, settings.halves = 2, settings.inject = way;
    settings.storage = layout.storage, settings.channels = std::uint32_t(layout.channels), settings.turned = layout.frame != mat3(1.0f);
    return settings;
}

// What each half's slots hold after one frame, times the number of its rays: the sums of its deposits.
std::vector<float> depositsOf(VulkanDevice& device, ShaderLanguage language, LightFrameSettings settings, const Level& level, std::span<const ClvRay> rays,
                              const mat3& axes = mat3(1.0f), float largestFlux = kLargestFlux) {
    const BrickSlots bricks = brickSlots(level);
    settings.levels = {describeLevel(level, bricks)};
    VulkanFrame frame(device, lightFrame(settings), language);
    ClvFrame constants{};
    constants.rayCount = kRays, constants.halves = settings.halves;
    keepDirectionsAlong(axes, constants);
    frame.upload("frame", constants);
    frame.upload("rays", rays);
    frame.upload("level 0", levelConstants(level, bricks, settings, 1.0f, largestFlux));
    uploadLevel(frame, settings, 0, level, bricks);
    frame.run("light");
    std::vector<float> sums(settings.halves * level.slots.size() * frameStride(settings));
    frame.download("history 0", std::span(sums));
    for (float& sum : sums) sum *= float(kRays / settings.halves);
    return sums;
}

// Sums in double precision, and how far any order of float additions can be from them.
struct Expected {
    std::vector<double> sum, bound;
};

Expected expectedDeposits(const Level& level, const DepositLayout& layout, std::uint32_t rule, std::span<const ClvRay> rays) {
    const std::size_t stride = std::size_t(layout.stride()), half = level.slots.size() * stride;
    Expected expected{std::vector<double>(2 * half), std::vector<double>(2 * half)};
    std::vector<double> magnitude(2 * half);
    std::vector<int> terms(2 * level.slots.size());
    const double diagonal = glm::length(vec3(level.volume.resolution)) * double(level.volume.cellSize);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ClvRecord record = clvRecordOfRay(layout.storage, uint(layout.channels), rays[i], layout.frame * rays[i].direction, clvMostFlux(rule, level.volume.cellSize));
        ClvWalk walk = clvWalkBegin(level.volume, rays[i]);
        while (walk.running == 1) {
            const ClvCrossing crossing = clvWalkStep(walk, rays[i].direction);
            const double weight = clvCrossingWeight(rule, crossing, level.volume.cellSize);
            const float middle = 0.5f * (crossing.tBegin + crossing.tEnd) * level.volume.cellSize;
            const uint entry = level.table[clvCellIndex(level.volume, crossing.cell)];
            const uint slot = slotAtPosition(level, entry, rays[i].origin + rays[i].direction * middle);
            if (slot == kClvNoSlot) continue;
            const std::size_t number = i / (rays.size() / 2) * level.slots.size() + slot;
            ++terms[number];
            for (int k = 0; k < layout.values(); ++k) {
                const double value = clvRecordValue(record, uint(layout.channels), uint(k)) * weight;
                expected.sum[number * stride + std::size_t(k)] += value;
                magnitude[number * stride + std::size_t(k)] += std::abs(value);
            }
        }
    }
    for (std::size_t k = 0; k < 2 * half; ++k) {
        // n additions, three roundings of each term; and lengths that are rounded by the distances which they are the difference of.
        const double n = terms[k / stride];
        expected.bound[k] = (n + 3.0) * kUnit * magnitude[k] + (n + 1.0) * 4.0 * kUnit * kLargestFlux * diagonal;
    }
    return expected;
}

double total(std::span<const float> values) {
    double sum = 0.0;
    for (float value : values) sum += value;
    return sum;
}

class VulkanInject : public testing::Test {
protected:
    void expectDeposits(InjectWay way, ShaderLanguage language, const Level& level, const DepositLayout& layout, std::uint32_t rule = kClvInjectTrackLength) {
        const std::vector<ClvRay> rays = testRays(level.volume, kRays);
        const Expected expected = expectedDeposits(level, layout, rule, rays);
        LightFrameSettings settings = settingsFor(way, layout);
        settings.rule = rule;
        const std::vector<float> sums = depositsOf(device, language, settings, level, rays, layout.frame);
        ASSERT_EQ(sums.size(), expected.sum.size());
        // Half a unit for each term of a fixed-point sum, and the conversion of the sum to a float.
        const double unit = way == InjectWay::fixedPoint ? 1.0 / clvFixedScale(kLargestFlux, kRays / 2, clvLargestDeposit(rule, settings.turned ? 1u : 0u, level.volume.cellSize)) : 0.0;
        double exact = 0.0, largest = 0.0;
        std::size_t lit = 0;
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const double bound = expected.bound[k] + unit * 0.5 * kRays + kUnit * std::abs(expected.sum[k]);
            ASSERT_NEAR(sums[k], expected.sum[k], bound) << "number " << k % std::size_t(layout.stride()) << " of record " << k / std::size_t(layout.stride());
            exact += expected.sum[k];
            largest = std::max(largest, std::abs(expected.sum[k]));
            lit += expected.sum[k] != 0.0;
        }
        EXPECT_NEAR(total(sums), exact, 2e-6 * std::abs(exact)) << "energy was lost or made";
        EXPECT_GT(largest, 0.0);
        EXPECT_GT(lit, sums.size() / 10) << "the test says little";
        EXPECT_EQ(device.messages(), std::vector<std::string>());
    }

    VulkanDevice device{{.floatAtomics = true, .validate = true}};
    const Scene rooms = makeTwoRooms();
    const EmbreeScene embree{rooms};
};

constexpr InjectWay kWays[] = {InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics, InjectWay::fixedPoint};
constexpr ShaderLanguage kLanguages[] = {ShaderLanguage::glsl, ShaderLanguage::hlsl};

TEST_F(VulkanInject, fillsSlotsAsTheCpuDoesInEveryStorage) {
    const Level level = openLevel();
    for (const InjectWay way : kWays) {
        for (const std::uint32_t storage : {kClvStorageCube9, kClvStorageCube, kClvStorageSh1, kClvStorageSh2}) {
            for (const int channels : {1, 3}) {
                for (const ShaderLanguage language : kLanguages) {
                    SCOPED_TRACE(testing::Message() << "way " << int(way) << ", storage " << storage << ", channels " << channels << ", language " << int(language));
                    expectDeposits(way, language, level, {storage, channels});
                }
            }
        }
    }
}

TEST_F(VulkanInject, findsTheSidesOfCellsThatWallsCut) {
    for (const int n : {16, 32}) {
        const Level level = twoRoomsLevel(embree, n);
        const BrickSlots bricks = brickSlots(level);
        ASSERT_GT(bricks.groupCount(), bricks.groupEnds[1]) << "no cell with two splits";
        ASSERT_GT(bricks.groupEnds[1], bricks.groupEnds[0]) << "no cell with one split";
        for (const InjectWay way : kWays) {
            for (const ShaderLanguage language : kLanguages) {
                SCOPED_TRACE(testing::Message() << n << ", way " << int(way) << ", language " << int(language));
                expectDeposits(way, language, level, {kClvStorageCube9, n == 16 ? 3 : 1});
            }
        }
    }
}

TEST_F(VulkanInject, keepsDirectionsAlongTurnedAxes) {
    const Level level = twoRoomsLevel(embree, 16);
    for (const InjectWay way : kWays) {
        for (const ShaderLanguage language : kLanguages) {
            SCOPED_TRACE(testing::Message() << "way " << int(way) << ", language " << int(language));
            expectDeposits(way, language, level, {kClvStorageCube9, 3, turned(0.6f, vec3(1.0f, 2.0f, 3.0f))});
        }
    }
}

TEST_F(VulkanInject, followsTheRuleOfTheThesis) {
    const Level level = openLevel();
    for (const InjectWay way : {InjectWay::floatAtomics, InjectWay::fixedPoint}) {
        for (const ShaderLanguage language : kLanguages) {
            SCOPED_TRACE(testing::Message() << "way " << int(way) << ", language " << int(language));
            expectDeposits(way, language, level, {kClvStorageCube, 3}, kClvInjectThesis);
        }
    }
}

TEST_F(VulkanInject, addsWhatTheCpusInjectAdds) {
    const Level level = twoRoomsLevel(embree, 16);
    const DepositLayout layout{kClvStorageCube9, 3};
    const std::vector<ClvRay> rays = testRays(level.volume, kRays);
    const Expected expected = expectedDeposits(level, layout, kClvInjectTrackLength, rays);
    const std::size_t half = level.slots.size() * std::size_t(layout.stride());
    for (std::size_t h = 0; h < 2; ++h) {
        AlignedFloats deposits(half);
        inject(level, layout, kClvInjectTrackLength, std::span(rays).subspan(h * kRays / 2, kRays / 2), {deposits, {}});
        for (std::size_t k = 0; k < half; ++k) ASSERT_NEAR(deposits[k], expected.sum[h * half + k], expected.bound[h * half + k]) << k;
    }
}

TEST_F(VulkanInject, isTheSameToTheLastBitInFixedPoint) {
    const Level level = twoRoomsLevel(embree, 16);
    const LightFrameSettings settings = settingsFor(InjectWay::fixedPoint, {kClvStorageCube9, 3});
    const std::vector<ClvRay> rays = testRays(level.volume, kRays);
    const std::vector<float> first = depositsOf(device, ShaderLanguage::glsl, settings, level, rays);
    EXPECT_EQ(depositsOf(device, ShaderLanguage::glsl, settings, level, rays), first);
    EXPECT_EQ(depositsOf(device, ShaderLanguage::hlsl, settings, level, rays), first);
    EXPECT_GT(total(first), 0.0);
}

// As many rays of a half as no loop of one round a ray would live through on every driver.
TEST_F(VulkanInject, losesNothingWhereAllRaysCrossOneBrick) {
    const Level level = openLevel();
    const BrickSlots bricks = brickSlots(level);
    ClvRay ray{};
    ray.origin = level.volume.origin + vec3(0.1f, 0.25f, 0.25f) * level.volume.cellSize;
    ray.direction = vec3(1.0f, 0.0f, 0.0f), ray.maxDistance = 0.8f * level.volume.cellSize, ray.flux = vec3(1.0f);
    const std::vector<ClvRay> rays(100000, ray);
    for (const InjectWay way : {InjectWay::bricks, InjectWay::bricksPlain}) {
        LightFrameSettings settings = settingsFor(way, {kClvStorageCube, 1});
        settings.rays = rays.size(), settings.halves = 1, settings.levels = {describeLevel(level, bricks)};
        VulkanFrame frame(device, lightFrame(settings));
        ClvFrame constants{};
        constants.rayCount = std::uint32_t(rays.size()), constants.halves = 1;
        frame.upload("frame", constants);
        frame.upload("rays", std::span(rays));
        frame.upload("level 0", levelConstants(level, bricks, settings, 1.0f, 1.0f));
        uploadLevel(frame, settings, 0, level, bricks);
        frame.run("light");
        std::vector<float> history(level.slots.size() * frameStride(settings));
        frame.download("history 0", std::span(history));
        // Light that travels along +x lights the side -x. Each of the additions rounds its sum.
        const double expected = 0.8 * level.volume.cellSize;
        EXPECT_NEAR(history[level.table[clvCellIndex(level.volume, ivec3(0))] * frameStride(settings) + 1], expected, double(rays.size()) * kUnit * expected) << int(way);
    }
}

// Two frames of other rays, the second with a weight of a half: the history is the mean of both.
TEST_F(VulkanInject, gathersIntoTheHistory) {
    const Level level = openLevel();
    const DepositLayout layout{kClvStorageCube9, 3};
    const BrickSlots bricks = brickSlots(level);
    std::vector<ClvRay> rays = testRays(level.volume, kRays);
    const Expected first = expectedDeposits(level, layout, kClvInjectTrackLength, rays);
    std::vector<ClvRay> reversed(rays.rbegin(), rays.rend());
    const Expected second = expectedDeposits(level, layout, kClvInjectTrackLength, reversed);
    for (const InjectWay way : {InjectWay::bricks, InjectWay::bricksPlain}) {
        for (const ShaderLanguage language : kLanguages) {
            LightFrameSettings settings = settingsFor(way, layout);
            settings.levels = {describeLevel(level, bricks)};
            VulkanFrame frame(device, lightFrame(settings), language);
            ClvFrame constants{};
            constants.rayCount = kRays, constants.halves = 2;
            frame.upload("frame", constants);
            uploadLevel(frame, settings, 0, level, bricks);
            frame.upload("rays", std::span<const ClvRay>(rays));
            frame.upload("level 0", levelConstants(level, bricks, settings, 1.0f, kLargestFlux));
            frame.run("light");
            frame.upload("rays", std::span<const ClvRay>(reversed));
            frame.upload("level 0", levelConstants(level, bricks, settings, 0.5f, kLargestFlux));
            frame.run("light");
            std::vector<float> history(first.sum.size());
            frame.download("history 0", std::span(history));
            for (std::size_t k = 0; k < history.size(); ++k) {
                const double mean = 0.5 * (first.sum[k] + second.sum[k]), bound = first.bound[k] + second.bound[k] + 4.0 * kUnit * (std::abs(first.sum[k]) + std::abs(second.sum[k]));
                ASSERT_NEAR(history[k] * (kRays / 2), mean, bound) << k;
            }
        }
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

// All rays of a half through the same cell from side to side, with the largest flux: the most that a sum can be.
TEST_F(VulkanInject, doesNotOverflowInFixedPoint) {
    const Level level = openLevel();
    const DepositLayout layout{kClvStorageCube, 3};
    const vec3 direction = normalize(vec3(1.0f, 1e-3f, 1e-3f));
    ClvRay ray{};
    ray.origin = level.volume.origin + vec3(0.0f, 0.25f, 0.25f) * level.volume.cellSize;
    ray.direction = -direction, ray.origin += direction * level.volume.cellSize;
    ray.maxDistance = level.volume.cellSize, ray.flux = vec3(kLargestFlux);
    const std::vector<ClvRay> rays(kRays, ray);
    const std::vector<float> sums = depositsOf(device, ShaderLanguage::glsl, settingsFor(InjectWay::fixedPoint, layout), level, rays);
    const double expected = double(kLargestFlux) * level.volume.cellSize * direction.x * (kRays / 2);
    const std::size_t first = std::size_t(level.table[clvCellIndex(level.volume, ivec3(0))]) * std::size_t(layout.stride());
    EXPECT_NEAR(sums[first], expected, 1e-5 * expected);
    EXPECT_EQ(sums[first + 3], 0.0f);
}

// Rays as bright as floats are, of both signs, and among them such without a direction: sums stay numbers.
TEST_F(VulkanInject, addsUpTheBrightestRaysToNumbers) {
    const Level level = openLevel();
    std::vector<ClvRay> rays = testRays(level.volume, kRays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].flux = vec3(i % 5 == 0 ? -3e38f : 3e38f);
        if (i % 7 == 0) rays[i].direction = i % 2 == 0 ? vec3(0.0f) : vec3(1e30f);
    }
    for (const InjectWay way : kWays) {
        for (const std::uint32_t storage : {kClvStorageCube9, kClvStorageSh1}) {
            for (const ShaderLanguage language : kLanguages) {
                const std::vector<float> sums = depositsOf(device, language, settingsFor(way, {storage, 3}), level, rays, mat3(1.0f), 3e38f);
                std::size_t notFinite = 0, lit = 0;
                for (float sum : sums) notFinite += !std::isfinite(sum), lit += sum != 0.0f;
                EXPECT_EQ(notFinite, 0u) << "way " << int(way) << ", storage " << storage << ", language " << int(language);
                EXPECT_GT(lit, sums.size() / 10);
            }
        }
    }
}

// Where no receiver reads, no cell has slots, and nothing is listed.
TEST_F(VulkanInject, listsNoRaysInBricksWithoutSlots) {
    const ClvVolume volume = openLevel().volume;
    const ClvReceiver corner{volume.origin, 0.0f, vec3(0.0f, 0.0f, 1.0f), 0.0f};
    BuildOptions options;
    options.findRegions = false;
    const Level few = buildLevel(volume, {}, neededCells(volume, std::span(&corner, 1)), serialFor(), options);
    const BrickSlots bricks = brickSlots(few);
    ASSERT_LT(few.slots.size(), few.cellCount() / 4);
    const std::vector<ClvRay> rays = testRays(volume, kRays);
    std::size_t expected = 0;
    for (const ClvRay& ray : rays) {
        const ClvVolume grid = clvBrickVolume(volume);
        for (ClvWalk walk = clvWalkBegin(grid, ray); walk.running == 1;) {
            const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
            const uint brick = clvCellIndex(grid, crossing.cell);
            expected += crossing.tEnd > crossing.tBegin && (bricks.mask[brick / 32u] >> brick % 32u & 1u);
        }
    }
    ASSERT_GT(expected, 0u);
    for (const ShaderLanguage language : kLanguages) {
        LightFrameSettings settings = settingsFor(InjectWay::bricksPlain, {kClvStorageCube, 1});
        settings.levels = {describeLevel(few, bricks)};
        Frame description = lightFrame(settings);
        description.buffers[description.bufferIndex("brick cursors 0")].readBack = true;
        VulkanFrame frame(device, description, language);
        ClvFrame constants{};
        constants.rayCount = kRays, constants.halves = 2;
        frame.upload("frame", constants);
        frame.upload("rays", std::span(rays));
        frame.upload("level 0", levelConstants(few, bricks, settings, 1.0f, kLargestFlux));
        uploadLevel(frame, settings, 0, few, bricks);
        frame.run("light");
        const ivec3 counts = clvBrickCounts(volume);
        std::vector<uint> cursors(2u * std::size_t(counts.x) * std::size_t(counts.y) * std::size_t(counts.z) + 1u);
        frame.download("brick cursors 0", std::span(cursors));
        EXPECT_EQ(cursors.back(), expected);
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(BrickSlots, holdEachSlotOnceInGroupsOfOneBrick) {
    const Scene rooms = makeTwoRooms();
    const EmbreeScene embree(rooms);
    const Level level = twoRoomsLevel(embree, 16);
    const BrickSlots bricks = brickSlots(level);
    ASSERT_EQ(bricks.slots.size(), bricks.groupCount() * kClvBrickLanes);
    std::set<uint> seen;
    for (uint group = 0; group < bricks.groupCount(); ++group) {
        std::set<uint> inBricks;
        int depth = 0;
        for (uint k = 0; k < kClvBrickLanes; ++k) {
            const uint slot = bricks.slots[group * kClvBrickLanes + k];
            if (slot == kClvNoSlot) continue;
            EXPECT_TRUE(seen.insert(slot).second) << slot;
            const uint cell = level.slots[slot].cell;
            inBricks.insert(clvBrickOfCell(level.volume, clvCellFromIndex(level.volume, cell)));
            depth = std::max(depth, splitDepth(level, level.table[cell]));
        }
        EXPECT_NE(bricks.slots[group * kClvBrickLanes], kClvNoSlot);
        const uint brick = *inBricks.begin();
        EXPECT_TRUE(bricks.mask[brick / 32u] >> brick % 32u & 1u) << brick;
        EXPECT_EQ(inBricks.size(), 1u);
        EXPECT_LT(group, bricks.groupEnds[std::size_t(depth)]);
        EXPECT_GE(group, depth == 0 ? 0u : bricks.groupEnds[std::size_t(depth) - 1]);
    }
    EXPECT_EQ(seen.size(), level.slots.size());
}

}  // namespace inject_test
