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

// The rows of the thesis' Table 4.1, and all of them together, by the device's clock and by the host's; an RSM that stands still is not
// rendered again.
constexpr int kTimedRows = 6;
constexpr int kVolumeRow = 2, kFrameRow = 4, kWallRow = 5;
constexpr const char* kTimedRowNames[kTimedRows] = {"rays", "intersection", "volume", "applying", "frame", "wall"};

struct TimedRow {
    double median = 0.0, minimum = 0.0;  // ms
};

struct TimedWay {
    InjectWay way;                       // slices: by the thesis' rule, in its cube
    TraceWay trace = TraceWay::walk;
    TimedRow rows[kTimedRows] = {};
    std::map<std::string, double> passes{};  // shortest time of each, ms
    std::size_t repeats = 0;
    std::uint64_t rounds = 0, bytes = 0;  // of one frame
    std::string failure{};               // one line, where the device could not run it
};

struct TimedFrame {
    TimedSetting setting;
    std::uint64_t receivers = 0, slots = 0;
    TimedRow picture{}, pictureWall{};   // of as many pixels: drawn, and lit from the first volume by a deferred pass; 0: the device does not draw
    std::vector<TimedWay> ways{};        // the device's defaults first
};

// The settings that are timed: growing volumes, and those that goals are set for.
std::vector<TimedSetting> timedSettings();

// seconds: how long each way is repeated, at least. everyCell: cells that no pixel reads hold light, too. `drawing` is the same device
// again, for passes that draw: the clock of llvmpipe goes wrong in a queue that has drawn.
TimedFrame timeFrame(VulkanDevice& device, VulkanDevice& drawing, const StoredScene& scene, const TimedSetting& setting, double seconds, bool everyCell);

}  // namespace clv
