// The library's own frame, for every setting.
#include <gtest/gtest.h>

#include <set>

#include "clv/plan/frame_check.h"
#include "clv/plan/light_frame.h"

using namespace clv;

namespace {

LightFrameLevel levelOf(int resolution) {
    LightFrameLevel level;
    level.volume.resolution = ivec3(resolution);
    level.cells = std::uint64_t(resolution) * resolution * resolution;
    level.splits = resolution;
    level.slots = level.cells / 8;
    // Some groups of whole cells, some of cells with one, and some with three splits.
    const uint groups = uint(level.cells / 32);
    level.groupEnds = {groups / 2, groups / 4 * 3, groups / 4 * 3, groups, groups};
    level.lookupEntries = 800;
    return level;
}

LightFrameSettings smallSettings(InjectWay inject = InjectWay::bricks) {
    LightFrameSettings settings;
    settings.lights = 2, settings.rsmSide = 16, settings.triangles = 100, settings.bvhNodes = 40;
    settings.rays = 4096, settings.receivers = 100, settings.inject = inject;
    settings.levels = {levelOf(16)};
    return settings;
}

constexpr InjectWay kWays[] = {InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics, InjectWay::fixedPoint, InjectWay::slices};

// Names of the passes of a step; empty where the frame has no such step.
std::vector<std::string> passesOf(const Frame& frame, const std::string& step) {
    std::vector<std::string> names;
    for (const FrameStep& s : frame.steps) {
        if (s.name != step) continue;
        for (const FramePass& pass : s.passes) names.push_back(pass.name);
    }
    return names;
}

bool has(const Frame& frame, const std::string& buffer) { return frame.bufferIndex(buffer) < frame.buffers.size(); }

TEST(LightFrame, isFreeOfFaultsForEverySetting) {
    std::size_t checked = 0;
    for (const InjectWay inject : kWays) {
        for (const bool keepHits : {false, true}) {
            for (const std::uint32_t halves : {1u, 2u}) {
                for (const std::uint64_t receivers : {0u, 100u}) {
                    for (const std::uint32_t storage : {kClvStorageCube9, kClvStorageCube, kClvStorageSh1, kClvStorageSh2}) {
                        for (const std::uint32_t channels : {1u, 3u}) {
                            for (const std::size_t levels : {1u, 3u}) {
                                LightFrameSettings settings = smallSettings(inject);
                                settings.keepHits = keepHits, settings.halves = halves, settings.receivers = receivers;
                                settings.storage = storage, settings.channels = channels;
                                settings.levels.resize(levels, levelOf(32));
                                EXPECT_EQ(checkFrame(lightFrame(settings)), std::vector<std::string>())
                                    << int(inject) << keepHits << halves << receivers << storage << channels << levels;
                                ++checked;
                            }
                        }
                    }
                }
            }
        }
    }
    EXPECT_EQ(checked, 5u * 2 * 2 * 2 * 4 * 2 * 2);
}

// The thesis' injection: a draw a slice and half, into a target a side.
TEST(LightFrame, drawsLinesIntoSlices) {
    LightFrameSettings settings = smallSettings(InjectWay::slices);
    settings.halves = 2, settings.storage = kClvStorageCube, settings.rule = kClvInjectThesis;
    const Frame frame = lightFrame(settings);
    EXPECT_EQ(passesOf(frame, "light"), (std::vector<std::string>{"rays", "trace", "begin 0", "list 0", "inject 0", "merge 0"}));
    const FramePass& draw = frame.steps[1].passes[4];
    EXPECT_EQ(frameLayers(frame, draw), 32u);
    EXPECT_EQ(draw.raster.topology, FrameTopology::lines);
    EXPECT_EQ(frame.buffers[frame.bufferIndex("side 5 0")].bytes, 18u * 18 * 32 * sizeof(vec4));
    EXPECT_EQ(frame.buffers[frame.bufferIndex("slice rays 0")].bytes, 32u * 2048 * sizeof(uint));
    EXPECT_EQ(checkFrame(frame, {.colourTargets = 5}).size(), 1u);
}

// Maps that are drawn take the place of traced ones.
TEST(LightFrame, drawsItsMapsWhereItHasFaces) {
    LightFrameSettings settings = smallSettings();
    settings.mapFaces = 7, settings.faceSide = 32;
    for (const std::uint64_t textureTexels : {0u, 64u}) {
        settings.textureTexels = textureTexels;
        const Frame frame = lightFrame(settings);
        EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
        EXPECT_EQ(passesOf(frame, "rsm"), (std::vector<std::string>{"map faces", "rsm", "texel rows", "texel columns"}));
        EXPECT_EQ(frameLayers(frame, frame.steps[0].passes[0]), 7u);
        EXPECT_EQ(frame.steps[0].passes[0].raster.vertices, 300u);
        EXPECT_EQ(frame.bytes() - lightFrame([&] { LightFrameSettings traced = settings; traced.mapFaces = 0; return traced; }()).bytes(),
                  7 * sizeof(ClvMapFace) + (7 + 1) * 32 * 32 * sizeof(float));
    }
}

// Ray tracing needs what a step of its own has built, and no tree.
TEST(LightFrame, buildsWhatItsRayTracingSearches) {
    LightFrameSettings settings = smallSettings();
    settings.accelerationBytes = 5120;
    for (const auto& [way, keepHits] : {std::pair{TraceWay::query, false}, {TraceWay::query, true}, {TraceWay::pipeline, false}, {TraceWay::pipeline, true}}) {
        settings.trace = way, settings.keepHits = keepHits;
        const Frame frame = lightFrame(settings);
        EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
        EXPECT_EQ(passesOf(frame, "scene"), std::vector<std::string>{"build"});
        EXPECT_EQ(passesOf(frame, "rsm"), (std::vector<std::string>{"rsm", "texel rows", "texel columns"}));
        EXPECT_FALSE(has(frame, "bvh boxes") || has(frame, "bvh children"));
        EXPECT_EQ(frame.buffers[frame.bufferIndex("acceleration")].triangles, 100u);
        EXPECT_EQ(frame.bytes() + 40 * (kClvBvhBoxRows * sizeof(vec4) + sizeof(uvec4)),
                  lightFrame([&] { LightFrameSettings walks = settings; walks.trace = TraceWay::walk; return walks; }()).bytes() + 5120 + 100 * kFrameCornerBytes);
    }
    settings.accelerationBytes = 0;
    EXPECT_EQ(checkFrame(lightFrame(settings)), std::vector<std::string>{"buffer acceleration has no bytes"});
}

TEST(LightFrame, hasTheStagesInTheirOrder) {
    const Frame frame = lightFrame(smallSettings(InjectWay::fixedPoint));
    EXPECT_EQ(passesOf(frame, "rsm"), (std::vector<std::string>{"rsm", "texel rows", "texel columns"}));
    EXPECT_EQ(passesOf(frame, "light"), (std::vector<std::string>{"rays", "trace", "inject 0", "merge 0"}));
    EXPECT_EQ(passesOf(frame, "evaluate"), (std::vector<std::string>{"evaluate 0"}));
}

// A pass for each number of splits that there is, and one list for all of them.
TEST(LightFrame, gathersWholeCellsApartFromSplitOnes) {
    const Frame frame = lightFrame(smallSettings(InjectWay::bricks));
    EXPECT_EQ(passesOf(frame, "light"), (std::vector<std::string>{"rays", "trace", "clear 0", "count 0", "begin 0", "list 0", "inject 0",
                                                                  "inject 0 split 1", "inject 0 split 3"}));
    EXPECT_FALSE(has(frame, "deposits 0")) << "what is gathered is merged at once";
}

TEST(LightFrame, beginsWithTheHostsRaysWhereThereAreNoLights) {
    LightFrameSettings settings = smallSettings(InjectWay::floatAtomics);
    settings.lights = 0;
    const Frame frame = lightFrame(settings);
    EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
    EXPECT_EQ(passesOf(frame, "light"), (std::vector<std::string>{"inject 0", "merge 0"}));
    EXPECT_TRUE(frame.buffers[frame.bufferIndex("rays")].source == FrameSource::host);
    for (const char* buffer : {"lights", "texels", "triangles", "bvh boxes"}) EXPECT_FALSE(has(frame, buffer)) << buffer;
}

TEST(LightFrame, leavesOutWhatNobodyReads) {
    LightFrameSettings settings = smallSettings();
    settings.receivers = 0;
    const Frame frame = lightFrame(settings);
    EXPECT_TRUE(passesOf(frame, "evaluate").empty());
    for (const char* buffer : {"hits", "receivers", "irradiance 0", "lookup ends 0"}) EXPECT_FALSE(has(frame, buffer)) << buffer;
    const Frame atomics = lightFrame(smallSettings(InjectWay::floatAtomics));
    for (const char* buffer : {"brick cursors 0", "brick begins 0", "brick rays 0", "brick slots 0", "brick mask 0", "slots 0"}) EXPECT_FALSE(has(atomics, buffer)) << buffer;
}

TEST(LightFrame, takesEmittersInPlaceOfMaps) {
    LightFrameSettings settings = smallSettings();
    settings.lights = 0, settings.emitters = 4 * settings.rsmSide;
    for (const bool keepHits : {false, true}) {
        settings.keepHits = keepHits;
        const Frame frame = lightFrame(settings);
        EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
        EXPECT_EQ(passesOf(frame, "rsm"), (std::vector<std::string>{"texel rows", "texel columns"}));
        EXPECT_TRUE(frame.buffers[frame.bufferIndex("texels")].source == FrameSource::host);
        EXPECT_EQ(frame.buffers[frame.bufferIndex("texels")].bytes, settings.emitters * sizeof(ClvRsmTexel));
        EXPECT_FALSE(has(frame, "lights"));
        EXPECT_EQ(has(frame, "surfaces"), keepHits) << "what rays hit matters to further bounces alone";
    }
}

TEST(LightFrame, sharesTheRaysOfAnotherFrame) {
    LightFrameSettings settings = smallSettings();
    settings.lights = 0;
    const std::uint64_t bytes = lightFrame(settings).bytes();
    settings.sharedRays = true;
    const Frame frame = lightFrame(settings);
    EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
    EXPECT_TRUE(frame.buffers[frame.bufferIndex("rays")].source == FrameSource::shared);
    EXPECT_EQ(bytes - frame.bytes(), settings.rays * sizeof(ClvRay)) << "what is shared takes no memory";
}

TEST(LightFrame, bindsAGuideOnlyWhereThereIsOne) {
    LightFrameSettings settings = smallSettings();
    for (const char* buffer : {"guide", "guide cells", "guide weights"}) EXPECT_FALSE(has(lightFrame(settings), buffer)) << buffer;
    settings.guideCells = 64, settings.guideRows = 9;
    const Frame frame = lightFrame(settings);
    EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
    EXPECT_EQ(frame.buffers[frame.bufferIndex("guide weights")].bytes, 9 * kClvGuideRow * sizeof(float));
    EXPECT_EQ(frame.steps[0].passes[1].shader, "texel_rows_guided");
    EXPECT_EQ(frame.steps[1].passes[0].shader, "rays_guided");
}

// Its lights stand still and one volume holds the scene: it has neither the data nor the passes of what moves.
TEST(LightFrame, hasNeitherDynamicityNorScrolling) {
    for (const InjectWay inject : kWays) {
        const Frame frame = lightFrame(smallSettings(inject));
        std::vector<std::string> names;
        for (const FrameBuffer& buffer : frame.buffers) names.push_back(buffer.name);
        for (const FrameStep& step : frame.steps) {
            for (const FramePass& pass : step.passes) names.insert(names.end(), {pass.name, pass.shader});
        }
        for (const std::string& name : names) {
            EXPECT_EQ(name.find("dynamicity"), std::string::npos);
            EXPECT_EQ(name.find("scroll"), std::string::npos);
        }
        // The whole of a record is light.
        EXPECT_EQ(frame.buffers[frame.bufferIndex("history 0")].bytes, 512u * 32 * sizeof(float));
    }
}

TEST(LightFrame, statesItsMemoryByItsSettings) {
    const LightFrameSettings settings = smallSettings(InjectWay::fixedPoint);
    const std::uint64_t record = 32 * sizeof(float);  // nine coefficients in three channels, padded to 32
    const std::uint64_t expected = sizeof(ClvFrame) + 2 * sizeof(ClvLight)
                                   + 40 * (kClvBvhBoxRows + 1) * sizeof(vec4) + 100 * (kClvTriangleRows + kClvSurfaceRows) * sizeof(vec4)
                                   + 2 * 16 * 16 * sizeof(ClvRsmTexel) + (32 * 17 + 33) * sizeof(float) + 4096 * sizeof(ClvRay)
                                   + sizeof(ClvLevelFrame) + 16 * 16 * 16 * sizeof(uint) + 16 * sizeof(ClvSplit) + 2 * 512 * record
                                   + 100 * sizeof(ClvReceiver) + 100 * sizeof(uint) + 800 * (sizeof(uint) + sizeof(float)) + 100 * sizeof(vec4);
    EXPECT_EQ(lightFrame(settings).bytes(), expected);
}

TEST(LightFrame, growsByEachLevelAlone) {
    LightFrameSettings one = smallSettings(), two = one;
    two.levels.push_back(levelOf(32));
    LightFrameSettings other = one;
    other.levels = {levelOf(32)};
    LightFrameSettings none = one;
    none.levels.clear();
    EXPECT_EQ(lightFrame(two).bytes() - lightFrame(one).bytes(), lightFrame(other).bytes() - lightFrame(none).bytes());
}

TEST(LightFrame, holdsTheLargestNumberOfRaysAndNoMore) {
    for (const InjectWay inject : kWays) {
        for (const int resolution : {16, 32, 64}) {
            LightFrameSettings settings = smallSettings(inject);
            settings.halves = 2, settings.levels = {levelOf(resolution)};
            settings.rays = largestFrameRays(settings);
            EXPECT_EQ(settings.rays % 2, 0u);
            EXPECT_EQ(checkFrame(lightFrame(settings)), std::vector<std::string>());
            settings.rays += CLV_GROUP_SIZE;
            EXPECT_NE(checkFrame(lightFrame(settings)), std::vector<std::string>()) << int(inject) << " " << resolution;
        }
    }
}

TEST(LightFrame, isLimitedByMemoryAndTypedViewsAlone) {
    const FrameLimits large{.storageBytes = std::uint64_t(1) << 32};
    EXPECT_EQ(largestFrameRays(smallSettings(InjectWay::floatAtomics), large), large.storageBytes / sizeof(ClvRay));
    // A ray is three elements where it is read through a typed view.
    const FrameLimits fewElements{.texelElements = 30000};
    LightFrameSettings settings = smallSettings(InjectWay::bricks);
    EXPECT_EQ(largestFrameRays(settings, fewElements), 10000u);
    settings.rays = 10000;
    EXPECT_EQ(checkFrame(lightFrame(settings), fewElements), std::vector<std::string>());
    ++settings.rays;
    EXPECT_NE(checkFrame(lightFrame(settings), fewElements), std::vector<std::string>());
}

TEST(LightFrame, coversMoreRaysThanARowOfWorkGroups) {
    LightFrameSettings settings = smallSettings(InjectWay::floatAtomics);
    const FrameLimits limits{.storageBytes = std::uint64_t(1) << 32};
    settings.rays = largestFrameRays(settings, limits);
    const Frame frame = lightFrame(settings);
    EXPECT_EQ(checkFrame(frame, limits), std::vector<std::string>());
    for (const FramePass& pass : frame.steps[1].passes) {
        if (pass.name != "rays" && pass.name != "inject 0") continue;
        EXPECT_GT(pass.groups.y, 1u);
        EXPECT_GE(std::uint64_t(pass.groups.x) * pass.groups.y * CLV_GROUP_SIZE, settings.rays);
    }
}

// A straight line through the middle of a volume's bricks meets as many as the lists have room for.
TEST(LightFrame, listsHoldTheLongestWayOfARay) {
    ClvVolume volume{};
    volume.resolution = ivec3(6, 4, 2);
    const ivec3 bricks = clvBrickCounts(volume);
    EXPECT_EQ(bricks, ivec3(3, 2, 1));
    std::set<std::vector<int>> met;
    const vec3 from(0.1f, 0.05f, 0.5f), to(2.9f, 1.97f, 0.5f);
    for (int i = 0; i <= 10000; ++i) {
        const vec3 p = from + (to - from) * (float(i) / 10000.0f);
        met.insert({int(p.x), int(p.y), int(p.z)});
    }
    EXPECT_EQ(met.size(), frameBricksOfRay(volume));
}

}  // namespace
