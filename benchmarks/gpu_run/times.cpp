#include "benchmarks/gpu_run/times.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <stdexcept>

#include "benchmarks/gpu_run/host_scene.h"
#include "benchmarks/gpu_run/ways.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/cpu/build_level.h"
#include "clv/plan/cascade_placement.h"
#include "clv/plan/map_faces.h"
#include "clv/plan/triangle_corners.h"
#include "clv/stages/rays.h"

namespace clv {
namespace {

constexpr std::uint32_t kRsmSide = 256;
constexpr int kWarmUps = 2;
constexpr std::size_t kFewestRepeats = 3;

struct LevelInputs {
    Level level;
    BrickSlots bricks;
    std::vector<uint> ends, slots;  // of all receivers; those of other cascades read nothing
    std::vector<float> weights;
};

// The scene's volume, or cascades around its camera whose last one holds the scene wherever that stands.
ClvCascades volumesOf(const StoredScene& scene, const TimedSetting& setting) {
    ClvCascades cascades{};
    if (setting.cascades == 0) {
        cascades.count = 1;
        cascades.volumes[0] = volumeOverBounds(scene.boundsLo, scene.boundsHi, setting.cells, kClvStorageCube9);
        return cascades;
    }
    const vec3 extent = scene.boundsHi - scene.boundsLo;
    CascadeDesc desc{.count = setting.cascades, .resolution = ivec3(setting.cells)};
    const double coarsest = 2.0 * std::max({extent.x, extent.y, extent.z}) / (setting.cells - 2 * desc.marginCells - 1);
    desc.finestCellSize = coarsest * desc.finestCellSize / cascadeCellSize(desc, desc.count - 1);
    CameraView view{.position = glm::dvec3(scene.camera.position), .forward = glm::dvec3(scene.camera.forward), .yfov = scene.camera.yfov};
    return placeCascades(desc, view, glm::dvec3(0.0), kClvStorageCube9, 0.0f);
}

std::vector<LevelInputs> levelsOf(const StoredScene& scene, const ClvCascades& cascades, const std::vector<ClvReceiver>& receivers, bool everyCell, const ParallelFor& parallelFor) {
    std::vector<LevelInputs> levels(cascades.count);
    for (uint l = 0; l < cascades.count; ++l) {
        std::vector<ClvReceiver> mine;
        std::vector<std::size_t> numbers;
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            if (clvCascadeFromPosition(cascades, receivers[i].position) != l) continue;
            mine.push_back(receivers[i]);
            numbers.push_back(i);
        }
        LevelInputs& level = levels[l];
        const auto needed = everyCell ? std::vector<std::uint8_t>() : neededCells(cascades.volumes[l], mine);
        level.level = buildLevel(cascades.volumes[l], probeOf(scene), needed, parallelFor);
        level.bricks = brickSlots(level.level);
        const LookupTable table(level.level, mine, {.lookup = kClvLookupTrilinear}, parallelFor);
        level.slots.assign(table.slots().begin(), table.slots().end());
        level.weights.assign(table.weights().begin(), table.weights().end());
        level.ends.assign(receivers.size(), 0);
        for (std::size_t k = 0; k < numbers.size(); ++k) level.ends[numbers[k]] = uint(table.ends()[k]);
        for (std::size_t i = 1; i < level.ends.size(); ++i) level.ends[i] = std::max(level.ends[i], level.ends[i - 1]);
    }
    return levels;
}

int rowOf(const std::string& pass) { return pass == "rays" ? 0 : pass == "trace" ? 1 : pass.starts_with("evaluate") ? 3 : kVolumeRow; }

double millisecondsOf(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

// Calls `once` for so many seconds, and at least a few times.
void repeat(double seconds, const std::function<void()>& once) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (std::size_t repeats = 0; repeats < kFewestRepeats || std::chrono::steady_clock::now() < end; ++repeats) once();
}

TimedRow rowOf(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return {times[times.size() / 2], times.front()};
}

class FrameTimer {
public:
    FrameTimer(VulkanDevice& device, const StoredScene& scene, const TimedSetting& setting, const std::vector<ClvReceiver>& receivers, const std::vector<LevelInputs>& levels)
        : device_(device), scene_(scene), setting_(setting), receivers_(receivers), levels_(levels) {
        settings_.lights = scene.lights.size(), settings_.rsmSide = kRsmSide;
        settings_.triangles = scene.surfaces.size() / kClvSurfaceRows, settings_.bvhNodes = scene.children.size();
        settings_.receivers = receivers.size();
        for (const LevelInputs& level : levels) {
            settings_.levels.push_back(describeLevel(level.level, level.bricks));
            settings_.levels.back().lookupEntries = std::max<std::size_t>(level.slots.size(), 1);
        }
    }

    void time(InjectWay way, TraceWay trace, double seconds, TimedFrame& timed) {
        TimedWay& result = timed.ways.emplace_back(TimedWay{.way = way, .trace = trace});
        try {
            const Frame description = describe(way, trace);
            result.rounds = (setting_.rays + settings_.rays - 1) / settings_.rays, result.bytes = description.bytes();
            VulkanFrame frame(device_, description);
            upload(frame);
            for (int i = 0; i < kWarmUps; ++i) runOnce(frame, result.rounds);
            std::vector<Times> times;
            repeat(seconds, [&] { times.push_back(runOnce(frame, result.rounds)); });
            result.repeats = times.size();
            for (int row = 0; row < kTimedRows; ++row) {
                std::vector<double> values;
                for (const Times& one : times) values.push_back(one.rows[row]);
                result.rows[row] = rowOf(values);
            }
            result.passes = times.front().passes;
            for (const Times& one : times) {
                for (const auto& [pass, milliseconds] : one.passes) result.passes[pass] = std::min(result.passes[pass], milliseconds);
            }
        } catch (const std::runtime_error& error) {
            result.failure = error.what();
        }
    }

    // A picture with the light of one frame.
    void timePicture(InjectWay way, double seconds, TimedFrame& timed) {
        settings_.picture = uvec2(setting_.width, setting_.height);
        VulkanFrame frame(device_, describe(way, TraceWay::walk));
        upload(frame);
        runOnce(frame, 1);
        std::vector<double> times, walls;
        repeat(seconds, [&] {
            walls.push_back(millisecondsOf([&] { frame.run("picture"); }));
            double sum = 0.0;
            for (const auto& [pass, milliseconds] : frame.times("picture")) sum += milliseconds;
            times.push_back(sum);
        });
        timed.picture = rowOf(times), timed.pictureWall = rowOf(walls);
    }

private:
    // With as many rays as the device takes at a time.
    Frame describe(InjectWay way, TraceWay trace) {
        const bool slices = way == InjectWay::slices;
        settings_.inject = way, settings_.trace = trace;
        settings_.storage = slices ? kClvStorageCube : kClvStorageCube9, settings_.rule = slices ? kClvInjectThesis : kClvInjectTrackLength;
        if (trace != TraceWay::walk) settings_.accelerationBytes = device_.accelerationBytes(settings_.triangles);
        settings_.rays = setting_.rays;
        settings_.rays = std::min(setting_.rays, largestFrameRays(settings_, device_.info().limits));
        Frame description = lightFrame(settings_);
        description.buffers[description.bufferIndex("texels")].readBack = true;
        return description;
    }

    void upload(VulkanFrame& frame) {
        constants_.boundsLo = scene_.boundsLo, constants_.boundsHi = scene_.boundsHi;
        constants_.rayCount = uint(settings_.rays), constants_.halves = settings_.halves, constants_.seed = 1;
        constants_.halfStep = constants_.rayCount / constants_.halves;
        constants_.rsmSide = kRsmSide, constants_.texelRows = uint(scene_.lights.size()) * kRsmSide, constants_.receiverCount = uint(receivers_.size());
        constants_.originOffset = scene_.originOffset, constants_.triangleCount = uint(scene_.triangles.size() / kClvTriangleRows);
        frame.upload("frame", constants_);
        frame.upload("lights", std::span(scene_.lights));
        if (settings_.trace == TraceWay::walk) {
            frame.upload("bvh boxes", std::span(scene_.boxes));
            frame.upload("bvh children", std::span(scene_.children));
        } else {
            frame.upload("corners", std::span<const vec3>(triangleCorners(scene_.triangles, settings_.triangles)));
            frame.run("scene");
        }
        frame.upload("triangles", std::span(scene_.triangles));
        frame.upload("surfaces", std::span(scene_.surfaces));
        frame.upload("receivers", std::span(receivers_));
        if (settings_.picture.x > 0) {
            const StoredCamera& view = scene_.camera;
            const float aspect = float(setting_.width) / float(setting_.height), nearest = 1e-4f * length(scene_.boundsHi - scene_.boundsLo);
            frame.upload("camera", cameraFace(view.position, view.forward, view.up, view.yfov, aspect, nearest));
            frame.upload("picture", ClvPicture{.ambient = vec3(0.01f), .ambientThreshold = 0.5f, .width = setting_.width, .height = setting_.height, .pad0 = 0, .pad1 = 0});
        }
        frame.run("rsm");
        std::vector<ClvRsmTexel> texels(settings_.lights * kRsmSide * kRsmSide);
        frame.download("texels", std::span(texels));
        // Texels are picked in proportion to their flux over all channels: no channel of a ray carries more than all of it.
        double flux = 0.0;
        for (const ClvRsmTexel& texel : texels) flux += clvTexelWeight(texel);
        for (std::size_t l = 0; l < levels_.size(); ++l) {
            const LevelInputs& level = levels_[l];
            const std::string name = std::string(" ").append(std::to_string(l));
            uploadLevel(frame, settings_, l, level.level, level.bricks);
            frame.upload("level" + name, levelConstants(level.level, level.bricks, settings_, 0.5f, float(flux)));
            frame.upload("lookup ends" + name, std::span(level.ends));
            frame.upload("lookup slots" + name, std::span(level.slots));
            frame.upload("lookup weights" + name, std::span(level.weights));
        }
    }

    // Times of one frame, ms.
    struct Times {
        std::array<double, kTimedRows> rows{};
        std::map<std::string, double> passes;
    };
    Times runOnce(VulkanFrame& frame, std::uint64_t rounds) {
        Times times;
        const auto runStep = [&](const std::string& step) {
            times.rows[kWallRow] += millisecondsOf([&] { frame.run(step); });
            for (const auto& [pass, milliseconds] : frame.times(step)) {
                times.rows[rowOf(pass)] += milliseconds, times.rows[kFrameRow] += milliseconds;
                times.passes[pass] += milliseconds;
            }
        };
        for (std::uint64_t round = 0; round < rounds; ++round) {
            frame.upload("frame", constants_);
            constants_.firstIndex += constants_.rayCount;
            runStep("light");
        }
        runStep("evaluate");
        if (!(times.rows[kFrameRow] > 0.0)) throw std::runtime_error("the device has no timestamps");
        return times;
    }

    VulkanDevice& device_;
    const StoredScene& scene_;
    const TimedSetting& setting_;
    const std::vector<ClvReceiver>& receivers_;
    const std::vector<LevelInputs>& levels_;
    LightFrameSettings settings_;
    ClvFrame constants_{};
};

}  // namespace

std::vector<TimedSetting> timedSettings() {
    return {{.name = "16^3, 64k rays", .cells = 16},
            {.name = "32^3, 64k rays", .cells = 32, .goal = 0.15},
            {.name = "64^3, 64k rays", .cells = 64},
            {.name = "128^3, 64k rays", .cells = 128},
            {.name = "64^3, 512k rays", .cells = 64, .rays = 524288, .goal = 0.6},
            {.name = "4 cascades of 64^3, 1M rays, 1920x1080", .cells = 64, .cascades = 4, .rays = 1048576, .width = 1920, .height = 1080, .goal = 3.0}};
}

TimedFrame timeFrame(VulkanDevice& device, VulkanDevice& drawing, const StoredScene& scene, const TimedSetting& setting, double seconds, bool everyCell) {
    const ParallelFor parallelFor = threadsFor();
    const std::vector<ClvReceiver> receivers = visibleReceivers(scene, setting.width, setting.height, parallelFor);
    const std::vector<LevelInputs> levels = levelsOf(scene, volumesOf(scene, setting), receivers, everyCell, parallelFor);
    TimedFrame timed{.setting = setting, .receivers = receivers.size()};
    for (const LevelInputs& level : levels) timed.slots += level.level.slots.size();
    FrameTimer timer(device, scene, setting, receivers, levels);
    const std::vector<TraceWay> traces = traceWaysOf(device.info());
    const std::vector<InjectWay> ways = waysOf(device.info().features);
    for (const TraceWay trace : traces) timer.time(ways.front(), trace, seconds, timed);
    for (std::size_t i = 1; i < ways.size(); ++i) timer.time(ways[i], traces.front(), seconds, timed);
    if (!device.info().features.draws) return timed;
    FrameTimer drawn(drawing, scene, setting, receivers, levels);
    if (drawsSlices(device.info().features)) drawn.time(InjectWay::slices, traces.front(), seconds, timed);
    drawn.timePicture(ways.front(), seconds, timed);
    return timed;
}

}  // namespace clv
