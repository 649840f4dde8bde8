// The walk in shaders: rays that it may stumble over keep their length, come to no cell twice, and cross the same bricks as on the processor.
#include <gtest/gtest.h>

#include <iterator>
#include <numeric>

#include "bindings/cli/stress/clipped_length.h"
#include "bindings/cli/stress/walk_rays.h"
#include "clv/stages/walk_check.h"
#include "vulkan/level_scene.h"

using namespace clv;
using namespace clv::test;

namespace walk_test {

constexpr std::uint32_t kRays = 1u << 16;  // of a frame: the lists of the longest grid take 134 MB
constexpr std::uint32_t kRounds = 3;        // with the six grids more than a million rays in each language

// How many rays cross each brick.
std::vector<uint> raysOfBricks(const ClvVolume& bricks, std::span<const ClvRay> rays) {
    std::vector<uint> counts(std::size_t(bricks.resolution.x) * std::size_t(bricks.resolution.y) * std::size_t(bricks.resolution.z));
    for (const ClvRay& ray : rays) {
        for (ClvWalk walk = clvWalkBegin(bricks, ray); walk.running == 1;) {
            const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
            counts[clvCellIndex(bricks, crossing.cell)] += crossing.tEnd > crossing.tBegin;
        }
    }
    return counts;
}

ClvVolume volumeOf(const ivec3& resolution, float cellSize, const vec3& origin) {
    ClvVolume volume{};
    volume.origin = origin, volume.cellSize = cellSize, volume.resolution = resolution;
    return volume;
}

Level openLevel(const ivec3& resolution, float cellSize, const vec3& origin) {
    return buildLevel(volumeOf(resolution, cellSize, origin), {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
}

std::vector<ClvRay> raysIn(const ClvVolume& volume, std::uint32_t seed) {
    Random random(seed);
    std::vector<ClvRay> rays;
    for (std::uint32_t i = 0; i < kRays; ++i) rays.push_back(rayOfKind(RayKind(int(i % std::uint32_t(RayKind::kCount))), random, volume));
    return rays;
}

// --gtest_shuffle --gtest_repeat=N gives other rays each time.
TEST(VulkanWalk, raysOfEveryKindKeepTheirLengthAndComeToNoCellTwice) {
    VulkanDevice device({.validate = true});
    Frame description;
    description.buffers = {{"frame", CLV_BIND_FRAME, sizeof(ClvFrame), FrameSource::host},
                           {"level", CLV_BIND_LEVEL, sizeof(ClvLevelFrame), FrameSource::host},
                           {"rays", CLV_BIND_RAYS, kRays * sizeof(ClvRay), FrameSource::host},
                           {"checks", CLV_BIND_WALK_CHECKS, kRays * sizeof(ClvWalkCheck), FrameSource::passes, true}};
    description.steps = {{"light", {{"walk", "walk_check", {}, {{0, FrameBinding::uniform}, {1, FrameBinding::uniform}, {2, FrameBinding::texel, FrameAccess::read, FrameFormat::rgba32Float},
                                                                {3, FrameBinding::storage, FrameAccess::write}}, groupsFor(kRays), {}}}}};
    addBarriers(description);
    const ClvVolume volumes[] = {volumeOf(ivec3(32), 0.5f, vec3(-8.0f)), volumeOf(ivec3(61, 23, 40), 0.1f, vec3(0.3f, -1.7f, 2.9f)), volumeOf(ivec3(1), 1.0f, vec3(0.0f)),
                                 volumeOf(ivec3(1, 1, 500), 0.25f, vec3(0.0f)), volumeOf(ivec3(1024, 1, 1), 0.25f, vec3(-128.0f, 0.0f, 0.0f)),
                                 volumeOf(ivec3(16), 1e-9f, vec3(-8e-9f)), volumeOf(ivec3(16), 1e5f, vec3(-8e5f)), volumeOf(ivec3(16), 4.0f, vec3(1e7f, -1e7f, 1e7f))};
    for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) {
        VulkanFrame frame(device, description, language);
        ClvFrame constants{};
        constants.rayCount = kRays;
        frame.upload("frame", constants);
        double worst = 0.0, outside = 0.0, cells = 0.0;
        for (std::uint32_t k = 0; k < 2 * std::size(volumes); ++k) {
            ClvLevelFrame level{};
            level.volume = volumes[k % std::size(volumes)];
            const std::vector<ClvRay> rays = raysIn(level.volume, 77u + k + 1000u * std::uint32_t(testing::UnitTest::GetInstance()->random_seed()));
            frame.upload("level", level);
            frame.upload("rays", std::span<const ClvRay>(rays));
            frame.run("light");
            std::vector<ClvWalkCheck> checks(kRays);
            frame.download("checks", std::span(checks));
            for (std::uint32_t i = 0; i < kRays; ++i) {
                // Each piece begins where the one before ends: together they are as long as the way from the first to the last.
                const ExactRay exact = exactRay(level.volume, rays[i]);
                const ClippedLength clipped = clippedLength(level.volume, exact);
                if (checks[i].cells > 0) outside = largerOf(outside, cellsOutside(exact, checks[i].farCell, checks[i].farAt) / exact.place);
                worst = largerOf(worst, clipped.excess(double(checks[i].end) - double(checks[i].begin)) / clipped.place);
                cells += checks[i].cells;
                ASSERT_EQ(checks[i].faults, 0) << k << ", ray " << i << ", language " << int(language);
            }
        }
        EXPECT_LE(worst, 4.0) << "last places, language " << int(language);
        EXPECT_LE(outside, 4.0) << "last places, language " << int(language);
        EXPECT_GT(cells, double(kRays) * 2 * std::size(volumes)) << "most rays cross cells";
        const std::string name = language == ShaderLanguage::glsl ? "glsl" : "hlsl";
        RecordProperty(name, std::to_string(worst));
        RecordProperty(name + "_outside", std::to_string(outside));
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(VulkanWalk, raysOfEveryKindCrossTheBricksThatTheyCrossOnTheHost) {
    VulkanDevice device({.validate = true});
    const Level levels[] = {openLevel(ivec3(32), 0.5f, vec3(-8.0f)), openLevel(ivec3(61, 23, 40), 0.1f, vec3(0.3f, -1.7f, 2.9f)),
                            openLevel(ivec3(1), 1.0f, vec3(0.0f)), openLevel(ivec3(1024, 1, 1), 0.25f, vec3(-128.0f, 0.0f, 0.0f)),
                            openLevel(ivec3(16), 1e5f, vec3(-8e5f)), openLevel(ivec3(16), 4.0f, vec3(1e7f, -1e7f, 1e7f))};
    for (std::uint32_t k = 0; k < kRounds * std::size(levels); ++k) {
        const Level& level = levels[k % std::size(levels)];
        const ClvVolume bricks = clvBrickVolume(level.volume);
        const std::vector<ClvRay> rays = raysIn(level.volume, 7u + k);
        const std::vector<uint> expected = raysOfBricks(bricks, rays);
        ASSERT_GT(std::accumulate(expected.begin(), expected.end(), 0u), kRays / 2);
        const BrickSlots slots = brickSlots(level);
        LightFrameSettings settings;
        settings.rays = kRays, settings.halves = 1, settings.inject = InjectWay::bricksPlain, settings.storage = kClvStorageCube, settings.channels = 1;
        settings.levels = {describeLevel(level, slots)};
        Frame description = lightFrame(settings);
        for (const char* name : {"brick begins 0", "brick cursors 0"}) description.buffers[description.bufferIndex(name)].readBack = true;
        for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) {
            VulkanFrame frame(device, description, language);
            ClvFrame constants{};
            constants.rayCount = kRays, constants.halves = 1;
            frame.upload("frame", constants);
            frame.upload("rays", std::span<const ClvRay>(rays));
            frame.upload("level 0", levelConstants(level, slots, settings, 1.0f, 1.0f));
            uploadLevel(frame, settings, 0, level, slots);
            frame.run("light");
            // The list pass moves each cursor from where its brick's list begins to where it ends.
            std::vector<uint> begins(expected.size()), counts(expected.size() + 1);
            frame.download("brick begins 0", std::span(begins));
            frame.download("brick cursors 0", std::span(counts));
            counts.pop_back();
            for (std::size_t brick = 0; brick < counts.size(); ++brick) counts[brick] -= begins[brick];
            EXPECT_EQ(counts, expected) << level.volume.resolution.x << ", language " << int(language);
        }
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace walk_test
