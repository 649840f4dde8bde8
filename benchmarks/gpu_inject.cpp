// Time of each way to inject on a Vulkan device, from its timestamps, beside the CPU's in the same run. The CPU column is the time that
// all threads of the process took: on a device that runs on the CPU, what the work costs there. CLV_DEVICE chooses the device by name.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>

#include "bindings/embree/rsm.h"
#include "bindings/embree/task_pool.h"
#include "bindings/scene/builtin_scenes.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/rays.h"
#include "clv/cpu/volume.h"

namespace clv {
namespace {

constexpr std::size_t kRays = 65536, kHalves = 2;
constexpr int kRsmSide = 128;

const std::pair<const char*, InjectWay> kWays[] = {
    {"bricks", InjectWay::bricks}, {"bricks_plain", InjectWay::bricksPlain}, {"float_atomics", InjectWay::floatAtomics}, {"fixed_point", InjectWay::fixedPoint}};
const std::pair<const char*, DepositLayout> kLayouts[] = {{"cube9x3", {kClvStorageCube9, 3}}, {"cubex1", {kClvStorageCube, 1}}};

VulkanDevice& device() {
    const char* name = std::getenv("CLV_DEVICE");
    static VulkanDevice made({.device = name ? name : "", .floatAtomics = true});
    return made;
}

// Two rooms, their rays, and a level: with `walls` as it is used, else every cell one slot.
struct Case {
    Case(int n, bool walls) {
        const Scene scene = makeTwoRooms();
        const EmbreeScene embree(scene);
        const std::size_t each = std::size_t(kRsmSide) * kRsmSide;
        std::vector<ClvRsmTexel> texels(scene.lights.size() * each);
        for (std::size_t k = 0; k < scene.lights.size(); ++k) {
            renderRsm(embree, scene.lights[k].light, kRsmSide, 0, 1, serialFor(), std::span(texels).subspan(k * each, each));
        }
        TexelSampler sampler;
        sampler.build(texels, kRsmSide, serialFor());
        rays.resize(kRays);
        for (std::size_t h = 0; h < kHalves; ++h) {
            makeRays(sampler, 0, uint(h), embree.surfaceOffset(), std::span(rays).subspan(h * kRays / kHalves, kRays / kHalves));
        }
        embree.trace(rays);
        for (const ClvRay& ray : rays) largestFlux = std::max({largestFlux, ray.flux.x, ray.flux.y, ray.flux.z});
        BuildOptions options;
        options.findRegions = walls;
        level = buildLevel(volumeOverBounds(scene.bounds.lo, scene.bounds.hi, n, kClvStorageCube9), embree.probe(), {}, tbbParallelFor(), options);
        CrossingBuffer buffer;
        auto count = [&](CrossingBuffer& full) { crossings += std::size_t(full.count), full.count = 0; };
        for (std::size_t first = 0; first < rays.size(); first += kPacketLanes) {
            walkPacket(level, kClvInjectTrackLength, std::span(rays).subspan(first, kPacketLanes), buffer, count);
            count(buffer);
        }
    }

    Level level;
    std::vector<ClvRay> rays;
    float largestFlux = 0.0f;
    std::size_t crossings = 0;
};

const Case& caseOf(int n, bool walls) {
    static std::map<std::pair<int, bool>, std::unique_ptr<Case>> cases;
    auto& made = cases[{n, walls}];
    if (!made) made = std::make_unique<Case>(n, walls);
    return *made;
}

void countCrossings(benchmark::State& state, const Case& scene) {
    state.counters["s/crossing"] = benchmark::Counter(double(scene.crossings), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Inject and merge: the ways differ in where one ends and the other begins.
void onDevice(benchmark::State& state, const Case& scene, InjectWay way, const DepositLayout& layout) {
    LightFrameSettings settings;
    settings.rays = kRays, settings.halves = kHalves, settings.inject = way;
    settings.storage = layout.storage, settings.channels = std::uint32_t(layout.channels);
    const BrickSlots bricks = brickSlots(scene.level);
    settings.levels = {describeLevel(scene.level, bricks)};
    VulkanFrame frame(device(), lightFrame(settings));
    ClvFrame constants{};
    constants.rayCount = kRays, constants.halves = kHalves;
    frame.upload("frame", constants);
    frame.upload("rays", std::span(scene.rays));
    frame.upload("level 0", levelConstants(scene.level, bricks, settings, 1.0f, scene.largestFlux));
    uploadLevel(frame, settings, 0, scene.level, bricks);
    frame.run("light");  // shaders are compiled at their first run
    std::map<std::string, double> passes;
    for (auto _ : state) {
        frame.run("light");
        double milliseconds = 0.0;
        for (const auto& [pass, time] : frame.times("light")) milliseconds += time, passes[pass] += 1e-3 * time;
        state.SetIterationTime(1e-3 * milliseconds);
    }
    for (const auto& [pass, time] : passes) state.counters[pass] = benchmark::Counter(time, benchmark::Counter::kAvgIterations);
    state.SetLabel(device().info().name);
    countCrossings(state, scene);
}

void onCpu(benchmark::State& state, const Case& scene, const DepositLayout& layout) {
    Volume volume(scene.level, layout, {.halves = int(kHalves), .chunks = 1});
    for (auto _ : state) {
        for (std::size_t h = 0; h < kHalves; ++h) {
            inject(volume.level(), layout, kClvInjectTrackLength, std::span(scene.rays).subspan(h * kRays / kHalves, kRays / kHalves), volume.partial(int(h), 0));
        }
        volume.merge(double(kRays), float(kHalves) / float(kRays), serialFor());
    }
    state.SetLabel("one thread");
    countCrossings(state, scene);
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const int n : {16, 32, 64}) {
        for (const bool walls : {false, true}) {
            for (const auto& [layoutName, layout] : kLayouts) {
                const std::string name = "gpu_inject/resolution:" + std::to_string(n) + (walls ? "/walls/" : "/open/") + layoutName + "/";
                auto add = [&](const std::string& way, auto&& body) {
                    return benchmark::RegisterBenchmark((name + way).c_str(), [n, walls, body](benchmark::State& state) { body(state, caseOf(n, walls)); })
                        ->Unit(benchmark::kMillisecond)
                        ->MeasureProcessCPUTime();
                };
                add("cpu", [layout](benchmark::State& state, const Case& scene) { onCpu(state, scene, layout); })->UseRealTime();
                for (const auto& [wayName, way] : kWays) {
                    add(wayName, [way, layout](benchmark::State& state, const Case& scene) { onDevice(state, scene, way, layout); })->UseManualTime();
                }
            }
        }
    }
    return true;
}();

}  // namespace
}  // namespace clv
