// What makes no frame is refused in words, and what is let through makes a sound one.
#include "clv/plan/light_frame_check.h"

#include <functional>

#include <gtest/gtest.h>

using namespace clv;

namespace {

LightFrameSettings soundSettings() {
    LightFrameSettings settings;
    settings.lights = 2, settings.rsmSide = 64, settings.triangles = 100, settings.bvhNodes = 60, settings.rays = 4096, settings.receivers = 10, settings.halves = 2;
    LightFrameLevel level;
    level.volume.resolution = ivec3(8, 6, 5), level.cells = 240, level.slots = 250, level.splits = 10, level.lookupEntries = 100;
    level.groupEnds = {20, 30, 30, 30, 30};
    settings.levels = {level};
    return settings;
}

TEST(LightFrameCheck, letsThroughWhatMakesASoundFrame) {
    for (InjectWay way : {InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics, InjectWay::fixedPoint, InjectWay::slices}) {
        for (TraceWay trace : {TraceWay::walk, TraceWay::query, TraceWay::pipeline}) {
            LightFrameSettings settings = soundSettings();
            settings.inject = way, settings.trace = trace, settings.accelerationBytes = 4096, settings.picture = uvec2(32, 16);
            if (way == InjectWay::slices) settings.rule = kClvInjectThesis, settings.storage = kClvStorageCube;
            EXPECT_EQ(validate(settings), "");
            EXPECT_EQ(checkFrame(lightFrame(settings)), std::vector<std::string>());
        }
    }
}

TEST(LightFrameCheck, refusesWhatMakesNone) {
    const std::function<void(LightFrameSettings&)> faults[] = {
        [](auto& s) { s.halves = 3; }, [](auto& s) { s.channels = 2; }, [](auto& s) { s.storage = 4; }, [](auto& s) { s.rule = 2; }, [](auto& s) { s.rays = 0; },
        [](auto& s) { s.rays = 4097; }, [](auto& s) { s.rays = std::uint64_t(1) << 40; }, [](auto& s) { s.levels.clear(); }, [](auto& s) { s.rule = kClvInjectThesis; },
        [](auto& s) { s.inject = InjectWay::slices; }, [](auto& s) { s.movingLights = true; }, [](auto& s) { s.emitters = 64; }, [](auto& s) { s.sharedRays = true; },
        [](auto& s) { s.rsmSide = 0; }, [](auto& s) { s.rsmSide = std::uint64_t(1) << 30; }, [](auto& s) { s.lights = 0, s.emitters = 65; }, [](auto& s) { s.triangles = 0; },
        [](auto& s) { s.bvhNodes = 0; }, [](auto& s) { s.trace = TraceWay::query; }, [](auto& s) { s.guideCells = 5; }, [](auto& s) { s.lights = 0, s.keepHits = true; },
        [](auto& s) { s.mapFaces = 6; }, [](auto& s) { s.picture = uvec2(64, 0); }, [](auto& s) { s.lights = 0, s.picture = uvec2(64); },
        [](auto& s) { s.levels[0].volume.resolution.y = 0; }, [](auto& s) { s.levels[0].volume.resolution.x = 1 << 30; }, [](auto& s) { s.levels[0].cells = 7; },
        [](auto& s) { s.levels[0].slots = 0; }, [](auto& s) { s.levels[0].lookupEntries = 0; }, [](auto& s) { s.levels[0].groupEnds[2] = 5; }, [](auto& s) { s.levels[0].groupEnds = {}; }};
    int number = 0;
    for (const auto& fault : faults) {
        LightFrameSettings settings = soundSettings();
        fault(settings);
        EXPECT_NE(validate(settings), "") << number;
        ++number;
    }
}

// A use of no buffer is a fault in words, wherever it is bound to.
TEST(FrameCheck, targetsThatAreNotDeclaredAreFaults) {
    Frame frame;
    frame.buffers.push_back({"a", 0, 16, FrameSource::passes, true});
    FramePass pass;
    pass.name = "draw", pass.shader = "shader", pass.raster = {FrameTopology::triangles, 3};
    pass.uses = {{7, FrameBinding::target, FrameAccess::write, FrameFormat::none}, {0, FrameBinding::arguments, FrameAccess::read, FrameFormat::none}};
    frame.steps.push_back({"step", {pass}});
    EXPECT_FALSE(checkFrame(frame).empty());
    EXPECT_EQ(frameLayers(frame, pass), 0u);
}

}  // namespace
