// A whole frame on a Vulkan device, from trace to evaluate, beside two others in turn with it, on two threads each: a plain native
// reference (one ray at a time through Embree, a scalar walk through the cells), and the library's own pipeline on the CPU.
// `work` is the time of all threads of the process, the least of all rounds: on a device that runs on the CPU, what the frame costs
// there, whoever else keeps the machine busy. CLV_DEVICE chooses the device by name.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <map>
#include <memory>
#include <thread>

#include "benchmarks/native_tracer.h"
#include "bindings/embree/bvh.h"
#include "bindings/embree/rsm.h"
#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/surface_rows.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/still_lighting.h"

namespace clv {
namespace {

constexpr std::size_t kRays = 65536, kReceivers = 3000;
constexpr int kCells = 32, kThreads = 2, kRounds = 25;
constexpr std::uint32_t kRsmSide = 128, kSeed = 1;

double processSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Case {
    Case(const std::string& name, const DepositLayout& depositLayout)
        : scene(makeBuiltinScene(name)), embree(scene), native(scene), layout(depositLayout),
          level(buildLevel(volumeOverBounds(scene.bounds.lo, scene.bounds.hi, kCells, layout.storage), embree.probe(), {}, tbbParallelFor())), bricks(brickSlots(level)),
          receivers(visiblePoints(embree, kReceivers, 1)), table(level, receivers, {}, tbbParallelFor()) {
        const std::size_t each = std::size_t(kRsmSide) * kRsmSide;
        texels.resize(scene.lights.size() * each);
        for (std::size_t k = 0; k < scene.lights.size(); ++k) {
            renderRsm(embree, scene.lights[k].light, int(kRsmSide), 0, clvHashCombine(kSeed, uint(k)), serialFor(), std::span(texels).subspan(k * each, each));
        }
        sampler.build(texels, int(kRsmSide), serialFor());
    }

    Scene scene;
    EmbreeScene embree;
    NativeTracer native;
    DepositLayout layout;
    Level level;
    BrickSlots bricks;
    std::vector<ClvReceiver> receivers;
    LookupTable table;
    std::vector<ClvRsmTexel> texels;
    TexelSampler sampler;
};

// The frame with its rays drawn in a step of their own.
Frame withRaysApart(Frame frame) {
    const auto light = std::find_if(frame.steps.begin(), frame.steps.end(), [](const FrameStep& step) { return step.name == "light"; });
    FrameStep rays{"rays", {light->passes.front()}};
    light->passes.erase(light->passes.begin());
    frame.steps.insert(light, std::move(rays));
    addBarriers(frame);
    return frame;
}

// In all three, draw() makes the rays of the next round, and run() traces, injects, merges and evaluates.
class OnDevice {
public:
    explicit OnDevice(const Case& c) : device_({.device = std::getenv("CLV_DEVICE") ? std::getenv("CLV_DEVICE") : ""}), bvh_(buildBvh(c.scene)) {
        std::vector<ClvLight> lights;
        for (const NamedLight& light : c.scene.lights) lights.push_back(light.light);
        LightFrameSettings settings;
        settings.lights = lights.size(), settings.rsmSide = kRsmSide, settings.rays = kRays;
        settings.triangles = c.scene.triangles.size(), settings.bvhNodes = bvh_.children.size(), settings.receivers = c.receivers.size();
        settings.storage = c.layout.storage, settings.channels = std::uint32_t(c.layout.channels);
        settings.inject = defaultInject(device_.info().features);
        settings.levels = {describeLevel(c.level, c.bricks)};
        settings.levels[0].lookupEntries = c.table.slots().size();
        frame_ = std::make_unique<VulkanFrame>(device_, withRaysApart(lightFrame(settings)));
        constants_.boundsLo = c.scene.bounds.lo, constants_.boundsHi = c.scene.bounds.hi;
        constants_.rayCount = kRays, constants_.halves = settings.halves, constants_.seed = clvHashCombine(kSeed, 0u), constants_.rsmSeed = kSeed;
        constants_.rsmSide = kRsmSide, constants_.texelRows = uint(lights.size()) * kRsmSide, constants_.receiverCount = uint(c.receivers.size());
        constants_.originOffset = c.embree.surfaceOffset(), constants_.triangleCount = uint(c.scene.triangles.size());
        frame_->upload("lights", std::span<const ClvLight>(lights));
        frame_->upload("bvh boxes", std::span<const vec4>(bvh_.boxes));
        frame_->upload("bvh children", std::span<const uvec4>(bvh_.children));
        frame_->upload("triangles", std::span<const vec4>(bvh_.triangles));
        frame_->upload("surfaces", std::span<const vec4>(surfaceRowsOf(c.scene).surfaces));
        frame_->upload("level 0", levelConstants(c.level, c.bricks, settings, 1.0f, float(c.sampler.totalFlux())));
        uploadLevel(*frame_, settings, 0, c.level, c.bricks);
        uploadLookup(*frame_, 0, c.table);
        frame_->upload("receivers", std::span(c.receivers));
        frame_->upload("frame", constants_);
        frame_->run("rsm");
    }

    void draw() {
        constants_.firstIndex += kRays;
        frame_->upload("frame", constants_);
        frame_->run("rays");
    }
    void run() { frame_->run({"light", "evaluate"}); }
    // Of the last run by timestamps, s; those of each pass are added to `passes`.
    double seconds(std::map<std::string, double>& passes) const {
        double sum = 0.0;
        for (const char* step : {"light", "evaluate"}) {
            for (const auto& [pass, time] : frame_->times(step)) sum += 1e-3 * time, passes[pass] += 1e-3 * time;
        }
        return sum;
    }
    double irradiance() {
        std::vector<vec4> all(constants_.receiverCount);
        frame_->download("irradiance 0", std::span(all));
        double sum = 0.0;
        for (const vec4& e : all) sum += e.y;
        return sum;
    }
    const std::string& name() const { return device_.info().name; }

private:
    VulkanDevice device_;
    Bvh bvh_;
    std::unique_ptr<VulkanFrame> frame_;
    ClvFrame constants_{};
};

// Plain code: each thread takes half of the rays, and has a volume of its own.
class Native {
public:
    explicit Native(const Case& c) : c_(c), rays_(kRays), volumes_(kThreads, std::vector<float>(c.level.slots.size() * std::size_t(c.layout.stride()))), irradiance_(c.receivers.size()) {}

    void draw() {
        makeRays(c_.sampler, first_, clvHashCombine(kSeed, 0u), c_.embree.surfaceOffset(), rays_);
        first_ += kRays;
    }
    void run() {
        inThreads([&](std::size_t t) { traceAndInject(t); });
        inThreads([&](std::size_t t) { merge(t); });
        inThreads([&](std::size_t t) { evaluate(t); });
    }
    double irradiance() const {
        double sum = 0.0;
        for (const vec3& e : irradiance_) sum += e.y;
        return sum;
    }

private:
    template <class Body>
    void inThreads(Body&& body) {
        std::jthread other([&] { body(1); });
        body(0);
    }
    void traceAndInject(std::size_t t) {
        std::vector<float>& volume = volumes_[t];
        std::fill(volume.begin(), volume.end(), 0.0f);
        const std::size_t stride = std::size_t(c_.layout.stride());
        for (std::size_t i = t * kRays / kThreads; i < (t + 1) * kRays / kThreads; ++i) {
            ClvRay ray = rays_[i];
            if (ray.maxDistance > 0.0f) ray.maxDistance = c_.native.trace(ray);
            const ClvRecord record = clvRecordOfRay(c_.layout.storage, uint(c_.layout.channels), ray, ray.direction, clvMostFlux(kClvInjectTrackLength, c_.level.volume.cellSize));
            float values[32];
            for (std::size_t k = 0; k < stride; ++k) values[k] = clvRecordValue(record, uint(c_.layout.channels), uint(k));
            for (ClvWalk walk = clvWalkBegin(c_.level.volume, ray); walk.running == 1;) {
                const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
                const float weight = clvCrossingWeight(kClvInjectTrackLength, crossing, c_.level.volume.cellSize);
                const uint entry = c_.level.table[clvCellIndex(c_.level.volume, crossing.cell)];
                if (entry == kClvNoSlot || !(weight > 0.0f)) continue;
                const float middle = 0.5f * (crossing.tBegin + crossing.tEnd) * c_.level.volume.cellSize;
                float* sums = volume.data() + slotAtPosition(c_.level, entry, ray.origin + ray.direction * middle) * stride;
                for (std::size_t k = 0; k < stride; ++k) sums[k] += values[k] * weight;
            }
        }
    }
    void merge(std::size_t t) {
        std::vector<float>& sums = volumes_[0];
        for (std::size_t k = t * sums.size() / kThreads; k < (t + 1) * sums.size() / kThreads; ++k) sums[k] = (sums[k] + volumes_[1][k]) / float(kRays);
    }
    void evaluate(std::size_t t) {
        for (std::size_t i = t * irradiance_.size() / kThreads; i < (t + 1) * irradiance_.size() / kThreads; ++i) {
            irradiance_[i] = c_.table.irradiance(i, c_.layout, volumes_[0], c_.layout.read(c_.receivers[i].normal));
        }
    }

    const Case& c_;
    std::vector<ClvRay> rays_;
    std::vector<std::vector<float>> volumes_;
    std::vector<vec3> irradiance_;
    uint first_ = 0;
};

// The library's pipeline.
class OnCpu {
public:
    explicit OnCpu(const Case& c)
        : c_(c), parallelFor_(tbbParallelFor(kThreads)),
          lighting_({.layout = c.layout, .parts = {.halves = 1, .chunks = kThreads}, .seed = kSeed, .originOffset = c.embree.surfaceOffset()},
                    [&c](std::span<ClvRay> rays) { c.embree.trace(rays); }, parallelFor_),
          irradiance_(c.receivers.size()) {
        lighting_.addLevel(c.level);
    }
    void draw() { lighting_.rays(c_.sampler, kRays); }
    void run() {
        lighting_.trace();
        lighting_.inject();
        lighting_.merge();
        const Volume& volume = lighting_.volumes().front();
        constexpr std::size_t kPiece = LookupTable::kPiece;
        parallelFor_((irradiance_.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
            for (std::size_t i = piece * kPiece; i < std::min(irradiance_.size(), (piece + 1) * kPiece); ++i) {
                irradiance_[i] = c_.table.irradiance(i, c_.layout, volume.history(0), c_.layout.read(c_.receivers[i].normal));
            }
        });
    }

private:
    const Case& c_;
    ParallelFor parallelFor_;
    StillLighting lighting_;
    std::vector<vec3> irradiance_;
};

double minimumOf(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }
double medianOf(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

void wholeFrame(benchmark::State& state, const std::string& scene, const DepositLayout& layout) {
    const Case c(scene, layout);
    OnDevice device(c);
    Native native(c);
    OnCpu cpu(c);
    std::map<std::string, double> passes;
    const auto round = [&](auto& frame) { frame.draw(), frame.run(); };
    round(device), round(native), round(cpu);  // shaders are compiled at their first run
    // What is measured is the same light: the estimates of one frame each.
    if (std::abs(device.irradiance() - native.irradiance()) > 0.05 * native.irradiance()) state.SkipWithError("the device's light is not that of the reference");
    struct {
        std::string name;
        std::vector<double> times{}, work{};
    } runs[3] = {{"device"}, {"native"}, {"cpu"}};
    const auto measure = [](auto& frame, auto& run) {
        frame.draw();
        const auto begin = std::chrono::steady_clock::now();
        const double before = processSeconds();
        frame.run();
        run.work.push_back(processSeconds() - before);
        run.times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    };
    for (auto _ : state) {
        measure(device, runs[0]), measure(native, runs[1]), measure(cpu, runs[2]);
        runs[0].times.back() = device.seconds(passes);
        state.SetIterationTime(runs[0].times.back());
    }
    for (const auto& run : runs) {
        state.counters[run.name + " median"] = medianOf(run.times);
        state.counters[run.name + " minimum"] = minimumOf(run.times);
        state.counters[run.name + " work"] = minimumOf(run.work);
        state.counters["device over " + run.name] = medianOf(runs[0].times) / medianOf(run.times);
        state.counters["work over " + run.name] = medianOf(runs[0].work) / minimumOf(run.work);
    }
    for (const auto& [pass, time] : passes) state.counters[pass] = benchmark::Counter(time, benchmark::Counter::kAvgIterations);
    state.SetLabel(device.name());
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const std::string scene : {"cornell", "two_rooms", "atrium"}) {
        for (const auto& [layoutName, layout] : {std::pair<std::string, DepositLayout>{"cube9x3", {kClvStorageCube9, 3}}, {"cubex1", {kClvStorageCube, 1}}}) {
            benchmark::RegisterBenchmark(("gpu_frame/" + scene + "/" + layoutName).c_str(), [scene, layout = layout](benchmark::State& state) { wholeFrame(state, scene, layout); })
                ->Unit(benchmark::kMillisecond)
                ->Iterations(kRounds)
                ->UseManualTime();
        }
    }
    return true;
}();

}  // namespace
}  // namespace clv
