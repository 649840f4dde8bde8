// The thesis' injection: lines drawn into slices, cell by cell what the rule of the rasteriser says, and close to the thesis' walk.
#include <gtest/gtest.h>

#include <cmath>

#include "benchmarks/gpu_run/line_cells.h"
#include "clv/cpu/aligned.h"
#include "clv/cpu/inject.h"
#include "vulkan/level_scene.h"

using namespace clv;
using namespace clv::test;

namespace slices_test {

constexpr std::uint32_t kRays = 4096;
constexpr double kUnit = 0x1p-24;  // rounding of a float
constexpr ShaderLanguage kLanguages[] = {ShaderLanguage::glsl, ShaderLanguage::hlsl};

// Bounds of what each half's sides hold: `sure` lies in every cell that a line passes through the middle of, `most` adds what may fall
// either way. A number a slot, side and channel, in the order of the records.
struct Expected {
    std::vector<double> sure, most;
    std::vector<int> lines;
    std::vector<float> sureDynamicity, mostDynamicity;  // the largest, six a slot
};

Expected expectedLines(const Level& level, const DepositLayout& layout, std::span<const ClvRay> rays) {
    const std::size_t stride = std::size_t(layout.stride()), slots = level.slots.size();
    Expected expected{std::vector<double>(2 * slots * stride), std::vector<double>(2 * slots * stride), std::vector<int>(2 * slots), std::vector<float>(12 * slots), std::vector<float>(12 * slots)};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ClvRecord record = clvRecordOfRay(layout.storage, uint(layout.channels), rays[i], rays[i].direction, clvMostFlux(kClvInjectThesis, level.volume.cellSize));
        const ClvCoefficients sides = clvDepositCoefficients(kClvStorageCube, rays[i].direction);
        const ClvSlices slices = clvSlicesOfRay(level.volume, rays[i]);
        for (int s = 0; s < slices.count; ++s) {
            const int z = slices.first + s * slices.step;
            const auto add = [&](const ivec2& cell, bool isSure) {
                const uint entry = level.table[clvCellIndex(level.volume, ivec3(cell, z))];
                if (entry == kClvNoSlot) return;
                const CellSlots cellSlots = slotsOfCell(level, entry);
                for (uint slot = cellSlots.first; slot < cellSlots.first + cellSlots.count; ++slot) {
                    const std::size_t number = i / (rays.size() / 2) * slots + slot;
                    ++expected.lines[number];
                    for (uint side = 0; side < 6; ++side) {
                        const float dynamicity = clvCoefficient(sides, side) > 0.0f ? rays[i].dynamicity : 0.0f;
                        float& most = expected.mostDynamicity[6 * number + side];
                        float& sure = expected.sureDynamicity[6 * number + side];
                        most = std::max(most, dynamicity), sure = std::max(sure, isSure ? dynamicity : 0.0f);
                    }
                    for (int k = 0; k < layout.values(); ++k) {
                        const double value = clvRecordValue(record, uint(layout.channels), uint(k));
                        expected.most[number * stride + std::size_t(k)] += value;
                        if (isSure) expected.sure[number * stride + std::size_t(k)] += value;
                    }
                }
            };
            forCellsOfLine(clvSlicePiece(level.volume, rays[i], z), [&](const ivec2& cell) { add(cell, true); }, [&](const ivec2& cell) { add(cell, false); });
        }
    }
    return expected;
}

// Test rays, each with a dynamicity of its own.
std::vector<ClvRay> movingRays(const ClvVolume& volume, std::size_t count) {
    std::vector<ClvRay> rays = testRays(volume, count);
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i].dynamicity = glm::fract(0.37f * float(i));
    return rays;
}

class VulkanSlices : public testing::Test {
protected:
    struct Drawn {
        std::vector<float> sums;        // in the order of the records, both halves
        std::vector<float> dynamicity;  // six a slot
    };

    Drawn drawnBy(ShaderLanguage language, const Level& level, const DepositLayout& layout, std::span<const ClvRay> rays, FrameFormat format = FrameFormat::rgba32Float) {
        const BrickSlots bricks = brickSlots(level);
        LightFrameSettings settings;
        settings.rays = rays.size(), settings.halves = 2, settings.inject = InjectWay::slices, settings.rule = kClvInjectThesis, settings.sliceFormat = format;
        settings.storage = layout.storage, settings.channels = std::uint32_t(layout.channels);
        settings.levels = {describeLevel(level, bricks)};
        Frame description = lightFrame(settings);
        for (FrameBuffer& buffer : description.buffers) buffer.readBack = buffer.readBack || buffer.image.format == FrameFormat::rgba32Float;
        VulkanFrame frame(device, description, language);
        ClvFrame constants{};
        constants.rayCount = uint(rays.size()), constants.halves = settings.halves;
        frame.upload("frame", constants);
        frame.upload("rays", rays);
        frame.upload("level 0", levelConstants(level, bricks, settings, 1.0f, 1.0f));
        uploadLevel(frame, settings, 0, level, bricks);
        frame.run("light");
        Drawn drawn;
        drawn.sums.resize(settings.halves * level.slots.size() * frameStride(settings));
        frame.download("history 0", std::span(drawn.sums));
        for (float& sum : drawn.sums) sum *= float(rays.size() / 2);
        if (format == FrameFormat::rgba32Float) drawn.dynamicity = dynamicityOf(frame, description, level);
        EXPECT_EQ(device.messages(), std::vector<std::string>());
        return drawn;
    }

    // The alpha of the sides, slot by slot.
    static std::vector<float> dynamicityOf(VulkanFrame& frame, const Frame& description, const Level& level) {
        std::vector<float> dynamicity(12 * level.slots.size());
        for (std::size_t side = 0; side < 6; ++side) {
            const std::string name = "side " + std::to_string(side) + " 0";
            const uvec3 extent = description.buffers[description.bufferIndex(name)].image.extent;
            std::vector<vec4> texels(std::size_t(extent.x) * extent.y * extent.z);
            frame.download(name, std::span(texels));
            for (std::size_t i = 0; i < 2 * level.slots.size(); ++i) {
                const uvec3 at = uvec3(clvCellFromIndex(level.volume, level.slots[i % level.slots.size()].cell)) + uvec3(kClvSliceRim, kClvSliceRim, i / level.slots.size() * extent.z / 2);
                dynamicity[6 * i + side] = texels[at.x + std::size_t(extent.x) * (at.y + std::size_t(extent.y) * at.z)].w;
            }
        }
        return dynamicity;
    }

    void expectLines(const Level& level, const DepositLayout& layout) {
        const std::vector<ClvRay> rays = movingRays(level.volume, kRays);
        const Expected expected = expectedLines(level, layout, rays);
        const std::size_t stride = std::size_t(layout.stride());
        for (const ShaderLanguage language : kLanguages) {
            const auto [sums, dynamicity] = drawnBy(language, level, layout, rays);
            double sure = 0.0, most = 0.0;
            for (std::size_t k = 0; k < sums.size(); ++k) {
                const double rounding = (expected.lines[k / stride] + 3) * kUnit * expected.most[k];
                ASSERT_GE(sums[k], expected.sure[k] - rounding) << k;
                ASSERT_LE(sums[k], expected.most[k] + rounding) << k;
                sure += expected.sure[k], most += expected.most[k];
            }
            EXPECT_GT(sure, 0.9 * most) << "the test says little";
            for (std::size_t k = 0; k < dynamicity.size(); ++k) {
                ASSERT_GE(dynamicity[k], expected.sureDynamicity[k]) << k;
                ASSERT_LE(dynamicity[k], expected.mostDynamicity[k]) << k;
            }
        }
    }

    VulkanDevice device{{.validate = true}};
    const Scene rooms = makeTwoRooms();
    const EmbreeScene embree{rooms};
};

TEST_F(VulkanSlices, drawWhatTheRuleOfTheRasteriserSaysInEveryCell) {
    ASSERT_TRUE(device.info().features.diamondLines);
    for (const int channels : {1, 3}) expectLines(openLevel(), {kClvStorageCube, channels});
}

// Walls do not part what is drawn into a cell: all of its slots get it.
TEST_F(VulkanSlices, lightAllSlotsOfACell) { expectLines(twoRoomsLevel(embree, 16), {kClvStorageCube, 3}); }

// Rays from inside the level, of all lengths.
std::vector<ClvRay> inner(const ClvVolume& volume) {
    std::vector<ClvRay> rays = testRays(volume, 4 * kRays);
    std::erase_if(rays, [&](const ClvRay& ray) { return ray.maxDistance == kClvFar || !(ray.maxDistance > volume.cellSize) || !clvIsFinite(ray.flux) || !clvIsFinite(ray.direction); });
    rays.resize(rays.size() / 2 * 2);
    return rays;
}

TEST_F(VulkanSlices, agreeWithTheThesisRuleOfTheCpuButForTheCellsThatRaysClip) {
    const Level level = openLevel();
    const DepositLayout layout{kClvStorageCube, 3};
    const std::vector<ClvRay> rays = inner(level.volume);
    AlignedFloats walked(level.slots.size() * std::size_t(layout.stride()));
    inject(level, layout, kClvInjectThesis, std::span(rays).first(rays.size() / 2), {walked, {}});
    // 16 bits keep 11 of a sum's binary digits, and lose what is smaller.
    for (const FrameFormat format : {FrameFormat::rgba32Float, FrameFormat::rgba16Float}) {
        const std::vector<float> drawn = drawnBy(ShaderLanguage::glsl, level, layout, rays, format).sums;
        double light = 0.0, all = 0.0, excess = 0.0;
        for (std::size_t k = 0; k < walked.size(); ++k) light += drawn[k], all += walked[k], excess += std::max(0.0f, drawn[k] - walked[k]);
        // Measured: the lines hold 82.9 % of the light of the walk, and 1.3 % of it in cells where they hold more.
        EXPECT_NEAR(light / all, 0.83, 0.01);
        EXPECT_LT(excess / all, 0.015);
    }
}

// A ray within its first cell draws nothing; one that ends in the next cell draws that.
TEST_F(VulkanSlices, spareTheFirstCellAndKeepTheLast) {
    const Level level = openLevel();
    const DepositLayout layout{kClvStorageCube, 1};
    for (int axis = 0; axis < 3; ++axis) {
        ClvRay ray{};
        ray.origin = clvCellCenter(level.volume, ivec3(2, 2, 2));
        ray.direction[axis] = -1.0f, ray.flux = vec3(1.0f), ray.dynamicity = 0.5f;
        for (const float cells : {0.4f, 0.6f, 1.6f}) {
            ray.maxDistance = cells * level.volume.cellSize;
            const Drawn drawn = drawnBy(ShaderLanguage::glsl, level, layout, std::vector<ClvRay>(2, ray));
            for (std::size_t slot = 0; slot < level.slots.size(); ++slot) {
                const ivec3 steps = ivec3(2) - clvCellFromIndex(level.volume, level.slots[slot].cell);
                const bool along = steps[axis] > 0 && steps[axis] <= int(cells + 0.5f) && steps[(axis + 1) % 3] == 0 && steps[(axis + 2) % 3] == 0;
                EXPECT_EQ(drawn.sums[slot * std::size_t(layout.stride()) + 2 * std::size_t(axis)], along ? 1.0f : 0.0f) << axis << " " << cells;
                EXPECT_EQ(drawn.dynamicity[6 * slot + 2 * std::size_t(axis)], along ? 0.5f : 0.0f);
            }
        }
    }
}

// 16 bits hold sums up to 65504 as numbers: of a cell with more light that much is left.
TEST_F(VulkanSlices, keepWhatSixteenBitsHoldOfSumsThatAreLarger) {
    const Level level = openLevel();
    const DepositLayout layout{kClvStorageCube, 1};
    ClvRay ray{};
    ray.origin = clvCellCenter(level.volume, ivec3(2, 2, 2)), ray.direction = vec3(-1, 0, 0), ray.maxDistance = 1.6f * level.volume.cellSize;
    for (const float flux : {4e4f, 1e6f}) {
        ray.flux = vec3(flux);
        const Drawn drawn = drawnBy(ShaderLanguage::glsl, level, layout, std::vector<ClvRay>(4, ray), FrameFormat::rgba16Float);
        EXPECT_EQ(*std::ranges::max_element(drawn.sums), 65504.0f) << flux;
        EXPECT_EQ(std::ranges::count(drawn.sums, 65504.0f), 4) << flux;
    }
}

}  // namespace slices_test
