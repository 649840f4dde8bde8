// Time of each stage on one thread, on the built-in scenes. `--benchmark_format=json` and the like come from Google Benchmark.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>

#include "bindings/embree/rsm.h"
#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/rays.h"
#include "clv/cpu/volume.h"

namespace clv {
namespace {

constexpr std::size_t kRays = 16384;
constexpr std::size_t kReceivers = 2000;
constexpr int kRsmSide = 256;
constexpr std::uint32_t kSeed = 1;

const std::pair<const char*, std::uint32_t> kStorages[] = {
    {"cube9", kClvStorageCube9}, {"cube", kClvStorageCube}, {"sh1", kClvStorageSh1}, {"sh2", kClvStorageSh2}};
const std::pair<const char*, std::uint32_t> kLookups[] = {
    {"nearest", kClvLookupNearest}, {"trilinear", kClvLookupTrilinear}, {"linear_fit", kClvLookupLinearFit}};

// Time that this process had the processor, s: the stages run on one thread, and other programs do not count.
double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

// A built-in scene with its RSMs, rays before and after tracing, and receivers.
struct Stage {
    explicit Stage(const std::string& name) : scene(makeBuiltinScene(name)), embree(scene) {
        const std::size_t each = std::size_t(kRsmSide) * kRsmSide;
        texels.resize(scene.lights.size() * each);
        for (std::size_t k = 0; k < scene.lights.size(); ++k) {
            renderRsm(embree, scene.lights[k].light, kRsmSide, 0, kSeed, serialFor(), std::span(texels).subspan(k * each, each));
        }
        sampler.build(texels, kRsmSide, serialFor());
        rays.resize(kRays);
        makeRays(sampler, 0, kSeed, embree.surfaceOffset(), rays);
        cut = rays;
        embree.trace(cut);
        receivers = visiblePoints(embree, kReceivers, kSeed);
    }
    ClvVolume grid(int n, std::uint32_t storage) const { return volumeOverBounds(scene.bounds.lo, scene.bounds.hi, n, storage); }
    // Every cell has a slot.
    Level denseLevel(int n, std::uint32_t storage) const {
        BuildOptions options;
        options.findRegions = false;
        return buildLevel(grid(n, storage), embree.probe(), {}, serialFor(), options);
    }

    Scene scene;
    EmbreeScene embree;
    std::vector<ClvRsmTexel> texels;
    TexelSampler sampler;
    std::vector<ClvRay> rays, cut;
    std::vector<ClvReceiver> receivers;
};

const Stage& stageOf(const std::string& name) {
    static std::map<std::string, std::unique_ptr<Stage>> stages;
    auto& stage = stages[name];
    if (!stage) stage = std::make_unique<Stage>(name);
    return *stage;
}

// Items a second, and ns an item.
void countItems(benchmark::State& state, const std::string& item, double perIteration) {
    state.counters[item + "s/s"] = benchmark::Counter(perIteration, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["s/" + item] = benchmark::Counter(perIteration, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void rays(benchmark::State& state, const Stage& stage) {
    std::vector<ClvRay> out(kRays);
    std::uint32_t index = 0;
    for (auto _ : state) {
        makeRays(stage.sampler, index, kSeed, stage.embree.surfaceOffset(), out);
        benchmark::DoNotOptimize(out.data());
        index += kRays;
    }
    countItems(state, "ray", kRays);
}

void traceOneByOne(benchmark::State& state, const Stage& stage) {
    for (auto _ : state) {
        for (const ClvRay& ray : stage.rays) benchmark::DoNotOptimize(stage.embree.hit(ray.origin, ray.direction, ray.maxDistance));
    }
    countItems(state, "ray", kRays);
}

void tracePackets(benchmark::State& state, const Stage& stage) {
    std::vector<ClvRay> traced;
    for (auto _ : state) {
        state.PauseTiming();
        traced = stage.rays;
        state.ResumeTiming();
        stage.embree.trace(traced);
    }
    countItems(state, "ray", kRays);
}

// The crossings of all rays, as a walk finds them.
struct Crossings {
    std::vector<std::uint32_t> slot, ray;
    std::vector<float> weight;
};

Crossings recordCrossings(const Level& level, std::span<const ClvRay> rays) {
    Crossings all;
    CrossingBuffer buffer;
    for (std::size_t first = 0; first < rays.size(); first += kPacketLanes) {
        auto flush = [&](CrossingBuffer& full) {
            for (int k = 0; k < full.count; ++k) {
                all.slot.push_back(full.entry[k]);
                all.ray.push_back(std::uint32_t(first) + full.lane[k]);
                all.weight.push_back(full.weight[k]);
            }
            full.count = 0;
        };
        walkPacket(level, kClvInjectTrackLength, rays.subspan(first, std::min<std::size_t>(kPacketLanes, rays.size() - first)), buffer, flush);
        flush(buffer);
    }
    return all;
}

// The same additions to the same addresses in the same order, without the walk: what memory allows.
template <int Stride>
void scatterStrided(const Crossings& crossings, const AlignedFloats& values, AlignedFloats& deposits) {
    for (std::size_t k = 0; k < crossings.slot.size(); ++k) {
        float* __restrict record = deposits.data() + std::size_t(crossings.slot[k]) * Stride;
        const float* __restrict add = values.data() + std::size_t(crossings.ray[k]) * Stride;
        const float weight = crossings.weight[k];
#pragma GCC unroll 1
        for (int j = 0; j < Stride; ++j) record[j] += add[j] * weight;
    }
}

void scatter(int stride, const Crossings& crossings, const AlignedFloats& values, AlignedFloats& deposits) {
    switch (stride) {
        case 16: return scatterStrided<16>(crossings, values, deposits);
        case 24: return scatterStrided<24>(crossings, values, deposits);
        default: return scatterStrided<32>(crossings, values, deposits);
    }
}

// `share`: time of the plain scatter-add over that of inject, both measured in turns in this run.
void injectAndScatter(benchmark::State& state, const Stage& stage, int n, std::uint32_t storage) {
    const Level level = stage.denseLevel(n, storage);
    const DepositLayout layout{storage, 3};
    const Crossings crossings = recordCrossings(level, stage.cut);
    const AlignedFloats values(kRays * layout.stride(), 1e-6f);
    AlignedFloats deposits(level.slots.size() * layout.stride(), 0.0f);
    double injecting = 0.0, scattering = 0.0;
    for (auto _ : state) {
        const double begin = seconds();
        inject(level, layout, kClvInjectTrackLength, stage.cut, {deposits, {}});
        const double middle = seconds();
        scatter(layout.stride(), crossings, values, deposits);
        benchmark::ClobberMemory();
        state.SetIterationTime(middle - begin);
        injecting += middle - begin;
        scattering += seconds() - middle;
    }
    const double count = double(crossings.slot.size());
    countItems(state, "crossing", count);
    state.counters["share"] = scattering / injecting;
    state.counters["crossings/ray"] = count / kRays;
    // Each crossing reads and writes its record.
    state.counters["bytes/s"] = benchmark::Counter(2.0 * count * layout.stride() * sizeof(float), benchmark::Counter::kIsIterationInvariantRate, benchmark::Counter::kIs1024);
}

void merge(benchmark::State& state, const Stage& stage, int n) {
    const DepositLayout layout;
    Volume volume(stage.denseLevel(n, layout.storage), layout, VolumeParts{2, 1});
    for (auto _ : state) volume.merge(kRays, 2.0f / kRays, serialFor());
    countItems(state, "slot", double(volume.level().slots.size()) * volume.parts().halves);
}

void evaluate(benchmark::State& state, const Stage& stage, std::uint32_t lookup) {
    const DepositLayout layout;
    const Level level = buildLevel(stage.grid(32, layout.storage), stage.embree.probe(), {}, tbbParallelFor());
    AlignedFloats deposits(level.slots.size() * layout.stride(), 0.0f);
    inject(level, layout, kClvInjectTrackLength, stage.cut, {deposits, {}});
    LookupOptions options;
    options.lookup = lookup;
    SlotWeights weights;
    for (auto _ : state) {
        for (const ClvReceiver& receiver : stage.receivers) {
            lookupWeights(level, receiver, options, weights);
            benchmark::DoNotOptimize(readIrradiance(layout, deposits, weights, clvReadCoefficients(layout.storage, receiver.normal)));
        }
    }
    countItems(state, "receiver", double(stage.receivers.size()));
}

void build(benchmark::State& state, const Stage& stage, int n) {
    const ClvVolume volume = stage.grid(n, kClvStorageCube9);
    const auto needed = neededCells(volume, stage.receivers);
    for (auto _ : state) benchmark::DoNotOptimize(buildLevel(volume, stage.embree.probe(), needed, serialFor()));
    countItems(state, "cell", double(std::count(needed.begin(), needed.end(), 1)));
}

void registerAll() {
    for (const std::string scene : {"cornell", "atrium"}) {
        // The scene is made when its first benchmark runs.
        auto add = [&](const std::string& name, auto&& body) {
            return benchmark::RegisterBenchmark((name + "/" + scene).c_str(), [scene, body](benchmark::State& state) { body(state, stageOf(scene)); })
                ->Unit(benchmark::kMillisecond);
        };
        add("rays", rays);
        add("trace/one_by_one", traceOneByOne);
        add("trace/packets", tracePackets);
        for (int n : {16, 32, 64, 128}) {
            const std::string size = std::to_string(n);
            for (const auto& [storageName, storage] : kStorages) {
                add("inject/" + size + "/" + storageName, [n, storage](benchmark::State& state, const Stage& stage) {
                    injectAndScatter(state, stage, n, storage);
                })->UseManualTime();
            }
            add("merge/" + size, [n](benchmark::State& state, const Stage& stage) { merge(state, stage, n); });
        }
        for (const auto& [lookupName, lookup] : kLookups) {
            add(std::string("evaluate/32/") + lookupName, [lookup](benchmark::State& state, const Stage& stage) { evaluate(state, stage, lookup); });
        }
        for (int n : {16, 32, 64}) {
            add("build_level/" + std::to_string(n), [n](benchmark::State& state, const Stage& stage) { build(state, stage, n); });
        }
    }
}

}  // namespace
}  // namespace clv

int main(int argc, char** argv) {
    clv::registerAll();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
}
