// Time of whole frames on the CPU, from rays to merge, over the number of threads and of cascades.
#include <benchmark/benchmark.h>

#include <cmath>
#include <thread>

#include "benchmarks/stages/stage_scene.h"
#include "clv/cpu/moving_lighting.h"
#include "clv/cpu/still_lighting.h"

namespace clv {
namespace {

constexpr std::size_t kRays = 64 << 10;
constexpr int kCells = 32;
// For the interval where the machine has two threads.
constexpr int kRepetitions = 5;

int mostThreads() { return std::max(1, int(std::thread::hardware_concurrency())); }

Tracer tracerOf(const StageScene& s) {
    return [&s](std::span<ClvRay> rays) { s.embree.trace(rays); };
}

void countRays(benchmark::State& state) {
    state.counters["s/ray"] = benchmark::Counter(double(kRays), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// A still volume, cut into as many parts as the machine has threads, however many of them are used.
void overThreads(benchmark::State& state, const StageScene& s, int threads) {
    StillLightingSettings settings;
    settings.parts = {.halves = 1, .chunks = mostThreads()};
    settings.originOffset = s.embree.surfaceOffset();
    StillLighting lighting(settings, tracerOf(s), tbbParallelFor(threads));
    lighting.addLevel(s.openLevel(kCells, settings.layout.storage));
    for (auto _ : state) {
        lighting.rays(s.sampler, kRays);
        lighting.trace();
        lighting.inject();
        lighting.merge();
    }
    countRays(state);
}

// Around a camera in the middle of the scene, on one thread; the coarsest cascade covers the whole scene.
void overCascades(benchmark::State& state, const StageScene& s, int count, int most) {
    const vec3 extent = s.scene.bounds.extent();
    MovingLightingSettings settings;
    settings.cascades.count = count;
    settings.cascades.finestCellSize = std::max({extent.x, extent.y, extent.z}) / (kCells - 2 * settings.cascades.marginCells) / std::pow(settings.cascades.growth, most - 1);
    settings.originOffset = s.embree.surfaceOffset();
    MovingLighting lighting(settings, s.embree.probe(), tracerOf(s), serialFor());
    lighting.moveTo({.position = glm::dvec3(s.scene.bounds.center())});
    for (auto _ : state) {
        lighting.rays(s.sampler, kRays);
        lighting.trace();
        lighting.inject();
        lighting.merge(settings.merge.timestep);
    }
    countRays(state);
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const std::string scene : {"cornell", "atrium"}) {
        auto add = [&](const std::string& parameter, int value, auto&& body) {
            const std::string name = "frame/" + scene + "/" + parameter + ":" + std::to_string(value);
            return benchmark::RegisterBenchmark(name.c_str(), [scene, body](benchmark::State& state) { body(state, stageScene(scene, kRays, 0)); })->Unit(benchmark::kMillisecond);
        };
        for (int threads = 1; threads < 2 * mostThreads(); threads *= 2) {
            const int count = std::min(threads, mostThreads());
            add("threads", count, [count](benchmark::State& state, const StageScene& s) { overThreads(state, s, count); })->UseRealTime()->Repetitions(kRepetitions);
        }
        constexpr int kMost = 4;
        for (int count = 1; count <= kMost; ++count) {
            add("cascades", count, [count](benchmark::State& state, const StageScene& s) { overCascades(state, s, count, kMost); });
        }
    }
    return true;
}();

}  // namespace
}  // namespace clv
