// The ways to trace and to inject that a device can take.
#pragma once
#include <string>
#include <vector>

#include "bindings/vulkan/vulkan_device.h"

namespace clv {

inline std::string wayName(InjectWay way) {
    switch (way) {
        case InjectWay::bricks: return "bricks";
        case InjectWay::bricksPlain: return "bricks_plain";
        case InjectWay::floatAtomics: return "float_atomics";
        case InjectWay::slices: return "slices";
        default: return "fixed_point";
    }
}

inline std::string traceName(TraceWay way) {
    if (way == TraceWay::walk) return "walk";
    return way == TraceWay::query ? "query" : "pipeline";
}

// The default first.
inline std::vector<TraceWay> traceWaysOf(const VulkanDeviceInfo& info) {
    std::vector<TraceWay> ways{defaultTrace(info)};
    const auto add = [&](TraceWay way, bool possible) {
        if (possible && way != ways.front()) ways.push_back(way);
    };
    add(TraceWay::walk, true);
    add(TraceWay::query, info.features.rayQueries);
    add(TraceWay::pipeline, info.features.rayPipelines);
    return ways;
}

// Whether it draws the thesis' lines, and by the rule that the CPU knows.
inline bool drawsSlices(const VulkanFeatures& features) { return features.draws && features.blendsFloats && features.diamondLines; }

// The default first.
inline std::vector<InjectWay> waysOf(const VulkanFeatures& features, std::uint32_t rule = kClvInjectTrackLength) {
    std::vector<InjectWay> ways{defaultInject(features, rule)};
    const auto add = [&](InjectWay way, bool possible) {
        if (possible && way != ways.front()) ways.push_back(way);
    };
    add(InjectWay::bricksPlain, rule == kClvInjectTrackLength);
    add(InjectWay::floatAtomics, features.floatAtomics);
    add(InjectWay::fixedPoint, true);
    return ways;
}

}  // namespace clv
