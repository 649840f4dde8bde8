// Any description of a frame is checked without harm, and lightFrame makes sound ones of whatever settings `validate` lets through.
#include "clv/plan/light_frame_check.h"
#include "fuzz/bytes.h"

using namespace clv;
using namespace clv::test;

namespace {

// Takes whatever fits the types.
constexpr FrameLimits kNoLimits{~0u, ~0u, ~std::uint64_t(0), ~std::uint64_t(0), ~std::uint64_t(0), ~0u, ~0u, ~0u, ~0u, ~std::uint64_t(0)};

template <class Choice>
Choice oneOf(FuzzBytes& bytes, int count) {
    return Choice(bytes.byte() % count);
}

std::uint64_t count(FuzzBytes& bytes, int most) { return std::uint64_t(std::uint32_t(bytes.integer(0, most))); }

FrameBuffer bufferFrom(FuzzBytes& bytes) {
    FrameBuffer buffer;
    buffer.name = std::string(1, char('a' + bytes.byte() % 8));
    buffer.binding = bytes.byte();
    buffer.bytes = bytes.flag() ? 4 * count(bytes, 1000) : bytes.take<std::uint64_t>();
    buffer.source = oneOf<FrameSource>(bytes, 4);
    buffer.readBack = bytes.flag();
    if (bytes.flag()) {
        buffer.image = {oneOf<FrameFormat>(bytes, 7), oneOf<FrameShape>(bytes, 3), uvec3(count(bytes, 64), count(bytes, 64), count(bytes, 8))};
        if (buffer.isImage() && bytes.flag()) buffer.bytes = frameImageBytes(buffer.image);
    }
    if (bytes.byte() % 8 == 0) buffer.triangles = count(bytes, 100);
    return buffer;
}

FramePass passFrom(FuzzBytes& bytes) {
    FramePass pass;
    pass.name = std::string(1, char('a' + bytes.byte() % 8));
    if (bytes.flag()) pass.shader = "shader";
    for (int k = bytes.byte() % 4; k > 0; --k) pass.constants.push_back({std::uint32_t(bytes.byte() % 4), bytes.take<std::uint32_t>()});
    for (int k = bytes.byte() % 5; k > 0; --k) {
        FrameUse use;
        use.buffer = std::uint32_t(bytes.integer(0, 8));
        use.binding = oneOf<FrameBinding>(bytes, 8), use.access = oneOf<FrameAccess>(bytes, 3);
        if (bytes.flag()) use.format = oneOf<FrameFormat>(bytes, 7);
        use.blend = oneOf<FrameBlend>(bytes, 3);
        pass.uses.push_back(use);
    }
    pass.groups = uvec3(count(bytes, 10), count(bytes, 10), count(bytes, 10));
    for (int k = bytes.byte() % 3; k > 0; --k) pass.barriers.push_back({std::uint32_t(bytes.integer(0, 8)), std::uint32_t(bytes.integer(0, 4))});
    pass.raster = {oneOf<FrameTopology>(bytes, 3), std::uint32_t(count(bytes, 100))};
    if (bytes.byte() % 8 == 0) pass.rays = {"miss", bytes.flag() ? "hit" : ""};
    return pass;
}

void checkAnyFrame(FuzzBytes& bytes) {
    Frame frame;
    for (int k = bytes.byte() % 6; k > 0; --k) frame.buffers.push_back(bufferFrom(bytes));
    for (int s = bytes.byte() % 3; s > 0; --s) {
        FrameStep& step = frame.steps.emplace_back();
        step.name = std::string(1, char('a' + s));
        for (int k = bytes.byte() % 5; k > 0; --k) step.passes.push_back(passFrom(bytes));
    }
    if (bytes.flag()) addBarriers(frame);
    const std::vector<std::string> faults = checkFrame(frame, bytes.flag() ? kNoLimits : FrameLimits{});
    if (!faults.empty()) return;
    // What a back end does with a frame that is sound stays within its buffers.
    for (const FrameStep& step : frame.steps) {
        for (const FramePass& pass : step.passes) {
            frameLayers(frame, pass), frameThreads(pass), frameShaders(pass);
            for (const FrameUse& use : pass.uses) require(use.buffer < frame.buffers.size(), "a sound frame uses buffers that it declares");
            for (const FrameBarrier& barrier : pass.barriers) require(barrier.buffer < frame.buffers.size(), "and barriers for them");
        }
    }
}

LightFrameLevel levelFrom(FuzzBytes& bytes) {
    LightFrameLevel level;
    for (int axis = 0; axis < 3; ++axis) level.volume.resolution[axis] = bytes.integer(1, 64);
    const ivec3& n = level.volume.resolution;
    level.cells = bytes.byte() % 8 == 0 ? count(bytes, 1000) : std::uint64_t(n.x) * std::uint64_t(n.y) * std::uint64_t(n.z);
    level.splits = count(bytes, 100), level.slots = count(bytes, 1000), level.lookupEntries = count(bytes, 1000);
    uint end = 0;
    for (uint& group : level.groupEnds) group = bytes.byte() % 8 == 0 ? bytes.take<uint>() : end += bytes.byte();
    return level;
}

void checkLightFrame(FuzzBytes& bytes) {
    LightFrameSettings s;
    if (bytes.byte() % 4 != 0) s.lights = count(bytes, 4);
    s.rsmSide = count(bytes, 64), s.triangles = count(bytes, 1000), s.bvhNodes = count(bytes, 1000);
    if (bytes.byte() % 4 == 0) s.emitters = bytes.flag() ? s.rsmSide * (bytes.byte() % 8) : count(bytes, 100);
    s.sharedRays = bytes.byte() % 4 == 0;
    if (bytes.flag()) s.textureTexels = count(bytes, 1000);
    if (bytes.flag()) s.mapFaces = std::uint32_t(count(bytes, 6)), s.faceSide = std::uint32_t(count(bytes, 64));
    s.rays = 2 * count(bytes, 1000), s.receivers = count(bytes, 100);
    s.halves = std::uint32_t(bytes.integer(1, 2)), s.storage = std::uint32_t(bytes.integer(0, 3)), s.channels = bytes.flag() ? 3u : std::uint32_t(bytes.integer(0, 4));
    if (bytes.flag()) s.picture = uvec2(count(bytes, 64), count(bytes, 64));
    s.turned = bytes.flag();
    s.rule = std::uint32_t(bytes.integer(0, 1));
    if (bytes.flag()) s.guideCells = count(bytes, 100), s.guideRows = count(bytes, 100);
    s.movingLights = bytes.flag(), s.keepHits = bytes.flag();
    s.trace = oneOf<TraceWay>(bytes, 3);
    s.accelerationBytes = 4 * count(bytes, 1000);
    s.inject = oneOf<InjectWay>(bytes, 5);
    s.sliceFormat = bytes.flag() ? FrameFormat::rgba32Float : oneOf<FrameFormat>(bytes, 7);
    for (int k = bytes.byte() % 4; k > 0; --k) s.levels.push_back(levelFrom(bytes));
    if (!validate(s).empty()) return;
    const Frame frame = lightFrame(s);
    for (const std::string& fault : checkFrame(frame, kNoLimits)) require(false, fault.c_str());
    require(largestFrameRays(s) % s.halves == 0, "as many rays in each half");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FuzzBytes bytes(data, size);
    if (bytes.flag()) checkAnyFrame(bytes);
    else checkLightFrame(bytes);
    return 0;
}
