// Time of a frame on a device, pass by pass, from its timestamps.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "benchmarks/gpu_run/stored.h"
#include "bindings/vulkan/vulkan_device.h"

namespace clv {

struct TimedSetting {
    std::string name;
    int cells = 32;                // the volume has about cells^3; of each cascade
    int cascades = 0;              // 0: one volume over the scene
    std::uint64_t rays = 65536;    // a frame
    std::uint32_t width = 240, height = 135;  // of the picture whose pixels are lit
    double goal = 0.0;             // ms, on an NVIDIA H200; 0: none
};

// The rows of the thesis' Table 4.1, and all of them together; an RSM that stands still is not rendered again.
constexpr int kTimedRows = 5;
constexpr const char* kTimedRowNames[kTimedRows] = {"rays", "intersection", "volume", "applying", "frame"};

struct TimedRow {
    double median = 0.0, minimum = 0.0;  // ms
};

struct TimedWay {
    InjectWay way;
    TraceWay trace = TraceWay::walk;
    TimedRow rows[kTimedRows] = {};
    std::map<std::string, double> passes{};  // shortest time of each, ms
    std::size_t repeats = 0;
    std::string failure{};               // one line, where the device could not run it
};

struct TimedFrame {
    TimedSetting setting;
    std::uint64_t receivers = 0, slots = 0, rounds = 0, bytes = 0;
    std::vector<TimedWay> ways{};        // the device's defaults first
};

// The settings that are timed: growing volumes, and those that goals are set for.
std::vector<TimedSetting> timedSettings();

// seconds: how long each way is repeated, at least. everyCell: cells that no pixel reads hold light, too.
TimedFrame timeFrame(VulkanDevice& device, const StoredScene& scene, const TimedSetting& setting, double seconds, bool everyCell);

}  // namespace clv
