// From the lights to the receivers: the device's light is the CPU's, in both languages, from run to run, and by every way to inject.
#include <gtest/gtest.h>

#include <cmath>

#include "bindings/vulkan/shader_interface.h"
#include "vulkan/whole_frame.h"

using namespace clv;
using namespace clv::test;

namespace whole_frame_test {

constexpr const char* kScenes[] = {"cornell", "two_rooms", "atrium"};
constexpr InjectWay kWays[] = {InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics, InjectWay::fixedPoint};
constexpr ShaderLanguage kLanguages[] = {ShaderLanguage::glsl, ShaderLanguage::hlsl};
constexpr int kCells = 16;
constexpr std::uint32_t kRays = 65536;

double relativeRmse(const std::vector<vec3>& values, const std::vector<vec3>& expected) {
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        square += double(glm::dot(values[i] - expected[i], values[i] - expected[i]));
        sum += double(expected[i].x) + expected[i].y + expected[i].z;
    }
    const double numbers = 3.0 * double(values.size());
    return std::sqrt(square / numbers) / (sum / numbers);
}

TEST(VulkanWholeFrame, givesTheCpusLight) {
    for (const char* name : kScenes) {
        WholeFrame whole(name, kCells, kRays);
        const std::vector<vec3> cpu = whole.onCpu();
        for (const InjectWay way : kWays) {
            const double error = relativeRmse(whole.onDevice(way), cpu);
            EXPECT_LE(error, 1e-3) << name << ", way " << int(way);
        }
        EXPECT_EQ(whole.device.messages(), std::vector<std::string>());
    }
}

TEST(VulkanWholeFrame, isTheSameToTheLastBitInFixedPointFromRunToRunAndInBothLanguages) {
    for (const char* name : kScenes) {
        WholeFrame whole(name, kCells, kRays);
        const std::vector<vec3> first = whole.onDevice(InjectWay::fixedPoint);
        EXPECT_TRUE(sameBits(whole.onDevice(InjectWay::fixedPoint), first)) << name;
        EXPECT_TRUE(sameBits(whole.onDevice(InjectWay::fixedPoint, ShaderLanguage::hlsl), first)) << name;
    }
}

// The order in which rays come differs from run to run, and with it the rounding of sums; nothing else does.
TEST(VulkanWholeFrame, differsByTheRoundingOfSumsBetweenLanguages) {
    WholeFrame whole("two_rooms", kCells, kRays);
    for (const InjectWay way : {InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics}) {
        EXPECT_LE(relativeRmse(whole.onDevice(way), whole.onDevice(way, ShaderLanguage::hlsl)), 1e-5) << int(way);
    }
}

LightFrameLevel levelOf(const std::array<uint, kClvMostSplits + 1>& groupEnds) {
    LightFrameLevel level;
    level.volume.resolution = ivec3(4);
    level.cells = 64, level.splits = 8, level.slots = 64, level.groupEnds = groupEnds, level.lookupEntries = 100;
    return level;
}

// Every frame that settings can ask for binds what its shaders bind, and gives the constants that they have.
TEST(LightFrameShaders, areMatchedByEverySetting) {
    std::vector<LightFrameSettings> all(1);
    const auto vary = [&](auto&& change, auto... values) {
        std::vector<LightFrameSettings> varied;
        for (const LightFrameSettings& settings : all) (change(varied.emplace_back(settings), values), ...);
        all = std::move(varied);
    };
    all[0].triangles = all[0].bvhNodes = 10, all[0].rsmSide = 8, all[0].rays = 64;
    vary([](LightFrameSettings& s, std::uint64_t lights) { s.lights = lights; }, 0, 2);
    all.push_back(all[0]), all.back().emitters = 16;
    vary([](LightFrameSettings& s, std::uint64_t texels) { s.textureTexels = texels; }, 0, 16);
    vary([](LightFrameSettings& s, std::uint32_t faces) { s.mapFaces = faces, s.faceSide = 8; }, 0, 3);
    vary([](LightFrameSettings& s, TraceWay trace) { s.trace = trace, s.accelerationBytes = 4096; }, TraceWay::walk, TraceWay::query, TraceWay::pipeline);
    vary([](LightFrameSettings& s, bool keepHits) { s.keepHits = keepHits; }, false, true);
    vary([](LightFrameSettings& s, std::uint64_t receivers) { s.receivers = receivers; }, 0, 10);
    vary([](LightFrameSettings& s, std::uint32_t halves) { s.halves = halves; }, 1, 2);
    vary([](LightFrameSettings& s, std::uint32_t storage) { s.storage = storage; }, kClvStorageCube9, kClvStorageCube, kClvStorageSh1, kClvStorageSh2);
    vary([](LightFrameSettings& s, std::uint32_t channels) { s.channels = channels; }, 1, 3);
    vary([](LightFrameSettings& s, bool turned) { s.turned = turned; }, false, true);
    vary([](LightFrameSettings& s, std::uint64_t rows) { s.guideCells = s.guideRows = rows; }, 0, 9);
    vary([](LightFrameSettings& s, std::uint32_t rule) { s.rule = rule; }, kClvInjectTrackLength, kClvInjectThesis);
    vary([](LightFrameSettings& s, InjectWay way) { s.inject = way; }, InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics, InjectWay::fixedPoint, InjectWay::slices);
    vary([](LightFrameSettings& s, std::uint32_t pixels) { s.picture = uvec2(s.lights > 0 ? pixels : 0); }, 0, 16);
    vary([](LightFrameSettings& s, bool moving) { s.movingLights = moving; }, false, true);
    vary([](LightFrameSettings& s, const std::vector<LightFrameLevel>& levels) { s.levels = levels; },
         std::vector{levelOf({8, 8, 8, 8, 8})}, std::vector{levelOf({2, 3, 4, 5, 6}), levelOf({0, 0, 8, 8, 8})});

    const VulkanFeatures features{.floatAtomics = true, .subgroupSize = 8, .rayQueries = true, .rayPipelines = true, .draws = true, .blendsFloats = true};
    std::map<std::pair<std::string, ShaderLanguage>, ShaderInterface> shaders;
    for (const ShaderCode& code : shaderCodes()) shaders[{std::string(code.name), code.language}] = shaderInterface(code.words);
    std::set<std::string> used;
    for (const LightFrameSettings& settings : all) {
        const Frame frame = lightFrame(settings);
        for (const FrameStep& step : frame.steps) {
            for (const FramePass& pass : step.passes) {
                if (pass.shader.empty()) continue;
                for (const ShaderLanguage language : kLanguages) {
                    // HLSL as it is compiled here traces no rays.
                    if (language == ShaderLanguage::hlsl && (pass.sendsRays() || pass.shader.ends_with("_query"))) continue;
                    ShaderInterface needs;
                    for (const std::string& name : frameShaders(pass)) {
                        used.insert(name);
                        needs = together(needs, shaders.at({name, language}));
                    }
                    ASSERT_EQ(shaderMismatches(frame, pass, needs, features), std::vector<std::string>());
                }
            }
        }
    }
    used.insert("walk_check");  // of walk_test.cpp alone
    for (const auto& [key, shader] : shaders) EXPECT_TRUE(used.contains(key.first)) << "no frame uses the shader " << key.first;
}

}  // namespace whole_frame_test
