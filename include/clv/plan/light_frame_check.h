// Says what is wrong with the settings of the library's own frame, in words.
#ifndef CLV_PLAN_LIGHT_FRAME_CHECK_H
#define CLV_PLAN_LIGHT_FRAME_CHECK_H
#include <string>

#include "light_frame.h"

namespace clv {

// More of anything than that is a mistake; products of two are still counts.
inline constexpr std::uint64_t kMostFrameItems = std::uint64_t(1) << 30;

// What is wrong with a level of a frame with these settings; empty if nothing is.
inline std::string validate(const LightFrameSettings& settings, const LightFrameLevel& level) {
    std::uint64_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (level.volume.resolution[axis] < 1 || std::uint64_t(level.volume.resolution[axis]) > kMostFrameItems / cells) return "frame: a level must have 1 to 2^30 cells";
        cells *= std::uint64_t(level.volume.resolution[axis]);
    }
    if (level.cells != cells) return "frame: a level's cells must be the product of its resolution";
    if (level.slots < 1 || level.slots > kMostFrameItems || level.splits > kMostFrameItems) return "frame: a level must have 1 to 2^30 slots, and at most as many splits";
    if (level.lookupEntries > kMostFrameItems || (settings.receivers > 0 && level.lookupEntries == 0)) return "frame: where there are receivers, a level must have 1 to 2^30 entries that they read";
    if (settings.inject == InjectWay::slices && std::uint64_t(level.volume.resolution.z) * settings.halves > kMostFrameItems) return "frame: a level has too many slices";
    if (!gathers(settings.inject)) return {};
    uint first = 0;
    for (uint end : level.groupEnds) {
        if (end < first || end > kMostFrameItems / kClvBrickLanes) return "frame: the ends of a level's groups of slots must rise, up to 2^27";
        first = end;
    }
    return first == 0 ? "frame: a level must have a group of slots" : "";
}

// What is wrong with the settings, in words; empty: lightFrame makes a frame of them that checkFrame finds nothing wrong with, but for what
// a device may not take.
inline std::string validate(const LightFrameSettings& s) {
    if (s.halves != 1 && s.halves != 2) return "frame: halves must be 1 or 2";
    if (s.channels != 1 && s.channels != 3) return "frame: channels must be 1 or 3";
    if (s.storage > kClvStorageSh2) return "frame: storage must be one of kClvStorage...";
    if (s.rule != kClvInjectTrackLength && s.rule != kClvInjectThesis) return "frame: rule must be one of kClvInject...";
    for (std::uint64_t count : {s.lights, s.rsmSide, s.triangles, s.bvhNodes, s.emitters, s.textureTexels, s.rays, s.receivers, s.guideCells, s.guideRows}) {
        if (count > kMostFrameItems) return "frame: there must be at most 2^30 of anything";
    }
    if (s.rays == 0 || s.rays % s.halves != 0) return "frame: there must be rays, as many in each half";
    if (s.levels.empty()) return "frame: there must be a level";
    if (gathers(s.inject) && s.rule != kClvInjectTrackLength) return "frame: bricks gather track lengths alone";
    if (s.inject == InjectWay::slices && (s.rule != kClvInjectThesis || s.storage != kClvStorageCube)) return "frame: slices know kClvInjectThesis and kClvStorageCube alone";
    if (s.inject == InjectWay::slices && s.sliceFormat != FrameFormat::rgba32Float && s.sliceFormat != FrameFormat::rgba16Float) return "frame: sliceFormat must be rgba32Float or rgba16Float";
    if (s.movingLights && s.inject != InjectWay::floatAtomics && s.inject != InjectWay::fixedPoint) return "frame: moving lights need InjectWay::floatAtomics or fixedPoint";
    const bool draws = s.lights > 0 || s.emitters > 0;
    if (s.lights > 0 && s.emitters > 0) return "frame: emitters stand in place of lights";
    if (draws && s.sharedRays) return "frame: rays are drawn, or shared";
    if (!draws && s.keepHits) return "frame: hits are kept of rays that the frame traces";
    if (draws && (s.rsmSide == 0 || s.lights * s.rsmSide > kMostFrameItems / s.rsmSide)) return "frame: maps must have 1 to 2^30 texels";
    if (s.emitters > 0 && s.emitters % s.rsmSide != 0) return "frame: emitters must be whole rows of rsmSide";
    if (draws && s.triangles == 0) return "frame: there must be triangles to trace rays among";
    if (draws && s.trace == TraceWay::walk && s.bvhNodes == 0) return "frame: there must be nodes of a tree to walk through";
    if (draws && s.trace != TraceWay::walk && (s.accelerationBytes == 0 || s.accelerationBytes % 4 != 0)) return "frame: an acceleration structure must have bytes, a multiple of 4";
    if ((s.guideCells > 0) != (s.guideRows > 0) || (s.guideRows > 0 && !draws)) return "frame: a guide has cells and rows, and guides rays that are drawn";
    const bool drawsMaps = s.lights > 0 && s.mapFaces > 0;
    if (drawsMaps && (s.faceSide == 0 || s.mapFaces > kMostFrameItems || s.faceSide > 65536u || s.triangles > kMostFrameItems / 3)) return "frame: pictures of a map must have 1 to 65536 texels a side, and at most 2^30 / 3 triangles";
    if ((s.picture.x > 0) != (s.picture.y > 0) || s.picture.x > 65536u || s.picture.y > 65536u) return "frame: a picture must have up to 65536 pixels a side";
    if (s.picture.x > 0 && (s.lights == 0 || s.triangles > kMostFrameItems / 3)) return "frame: a picture needs lights, and at most 2^30 / 3 triangles";
    for (const LightFrameLevel& level : s.levels) {
        if (std::string problem = validate(s, level); !problem.empty()) return problem;
    }
    return {};
}

}  // namespace clv
#endif
