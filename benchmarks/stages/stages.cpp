// Time of each stage on one thread, on the built-in scenes: an item's time and bytes, and the share of the machine's own limit, which is
// measured in turns with the stage.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "benchmarks/stages/limits.h"
#include "benchmarks/stages/stage_scene.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/volume.h"
#include "clv/stages/rsm.h"

namespace clv {
namespace {

constexpr std::size_t kRays = 16384, kRayCounts[] = {1024, 4096, kRays, 65536};
constexpr int kFewCells = 16, kCells = 32, kCellCounts[] = {kFewCells, kCells, 64, 128}, kFewCellCounts[] = {8, kFewCells, kCells, 64};
constexpr std::size_t kMostTriangles = 300'000;

const std::pair<const char*, std::uint32_t> kStorages[] = {
    {"cube9", kClvStorageCube9}, {"cube", kClvStorageCube}, {"sh1", kClvStorageSh1}, {"sh2", kClvStorageSh2}};
const std::pair<const char*, std::uint32_t> kLookups[] = {
    {"nearest", kClvLookupNearest}, {"trilinear", kClvLookupTrilinear}, {"linear_fit", kClvLookupLinearFit}};

// Time that this thread had the processor, s: other programs do not count.
double threadSeconds() {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

// What one run of a stage works through.
struct Work {
    std::string item;
    double items = 0.0;
    double bytes = 0.0;  // read and written
};

// `share`: time of the limit over that of the stage, in turns in this run. `before` is not measured.
template <class Before, class Stage, class Limit>
void timeStage(benchmark::State& state, const Work& work, Before&& before, Stage&& stage, Limit&& limit) {
    double own = 0.0, limits = 0.0;
    for (auto _ : state) {
        before();
        const double begin = threadSeconds();
        stage();
        benchmark::ClobberMemory();
        const double middle = threadSeconds();
        limit();
        benchmark::ClobberMemory();
        state.SetIterationTime(middle - begin);
        own += middle - begin, limits += threadSeconds() - middle;
    }
    state.counters[work.item + "s/s"] = benchmark::Counter(work.items, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["s/" + work.item] = benchmark::Counter(work.items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["bytes/" + work.item] = work.bytes / work.items;
    state.counters["share"] = limits / own;
}
void nothing() {}

void rsm(benchmark::State& state, const StageScene& s) {
    constexpr int kSide = StageScene::kRsmSide;
    const std::size_t each = std::size_t(kSide) * kSide;
    std::vector<ClvRsmTexel> texels(each);
    std::vector<ClvRay> rays(each);
    const ClvLight& light = s.scene.lights.front().light;
    for (std::size_t i = 0; i < each; ++i) {
        rays[i] = clvLightRay(light, clvRsmSamplePoint(uvec2(i % kSide, i / kSide), uint(kSide), 0, StageScene::kSeed), s.scene.bounds.lo, s.scene.bounds.hi);
    }
    timeStage(state, {"texel", double(each), double(each * sizeof(ClvRsmTexel))}, nothing,
              [&] { renderRsm(s.embree, light, kSide, 0, StageScene::kSeed, serialFor(), texels); }, [&] { benchmark::DoNotOptimize(traceBare(s.bare, rays)); });
}

void rays(benchmark::State& state, const StageScene& s) {
    std::vector<ClvRay> out(s.rays.size());
    std::uint32_t index = 0;
    const Work work{"ray", double(out.size()), double(out.size() * (sizeof(ClvRsmTexel) + sizeof(ClvRay)))};
    timeStage(state, work, [&] { index += std::uint32_t(out.size()); },
              [&] { makeRays(s.sampler, index, StageScene::kSeed, s.embree.surfaceOffset(), out); }, Copy(work.bytes));
}

void trace(benchmark::State& state, const StageScene& s) {
    std::vector<ClvRay> traced;
    timeStage(state, {"ray", double(s.rays.size()), double(2 * s.rays.size() * sizeof(ClvRay))}, [&] { traced = s.rays; }, [&] { s.embree.trace(traced); },
              [&] { benchmark::DoNotOptimize(traceBare(s.bare, s.rays)); });
}

void inject(benchmark::State& state, const StageScene& s, int n, std::uint32_t storage) {
    const Level level = s.denseLevel(n, storage);
    const DepositLayout layout{storage, 3};
    const ScatterAdd scatter(level, layout, s.cut);
    AlignedFloats deposits(level.slots.size() * layout.stride(), 0.0f);
    const double crossings = double(scatter.crossings());
    timeStage(state, {"crossing", crossings, 2.0 * crossings * layout.stride() * sizeof(float)}, nothing,
              [&] { inject(level, layout, kClvInjectTrackLength, s.cut, {deposits, {}}); }, [&] { scatter(deposits); });
    state.counters["crossings/ray"] = crossings / double(s.rays.size());
}

void merge(benchmark::State& state, const StageScene& s, int n) {
    const DepositLayout layout;
    Volume volume(s.denseLevel(n, layout.storage), layout, VolumeParts{2, 1});
    const double slots = double(volume.level().slots.size()) * volume.parts().halves;
    // Sums are read and cleared, the history is read and written.
    const Work work{"slot", slots, 4.0 * slots * layout.stride() * sizeof(float)};
    timeStage(state, work, nothing, [&] { volume.merge(kRays, 2.0f / kRays, serialFor()); }, Copy(work.bytes));
}

// A level with the light of the scene's rays.
struct LitLevel {
    LitLevel(const StageScene& s, int n) : level(s.openLevel(n, layout.storage)), deposits(level.slots.size() * layout.stride(), 0.0f) {
        inject(level, layout, kClvInjectTrackLength, s.cut, {deposits, {}});
    }
    // Reads and writes as many bytes as `records` have.
    double bytes(std::size_t records) const { return double(records * layout.stride() * sizeof(float)); }

    const DepositLayout layout;
    Level level;
    AlignedFloats deposits;
};

// Weights are found anew, as for a camera that moves.
void evaluate(benchmark::State& state, const StageScene& s, int n, std::uint32_t lookup) {
    const LitLevel lit(s, n);
    LookupOptions options;
    options.lookup = lookup;
    const std::size_t records = LookupTable(lit.level, s.receivers, options, serialFor()).slots().size();
    const Work work{"receiver", double(s.receivers.size()), lit.bytes(records)};
    SlotWeights weights;
    timeStage(state, work, nothing,
              [&] {
                  for (const ClvReceiver& receiver : s.receivers) {
                      lookupWeights(lit.level, receiver, options, weights);
                      benchmark::DoNotOptimize(readIrradiance(lit.layout, lit.deposits, weights, lit.layout.read(receiver.normal)));
                  }
              },
              Copy(work.bytes));
}

// Weights are kept, as for what stands still.
void evaluateKept(benchmark::State& state, const StageScene& s, int n) {
    const LitLevel lit(s, n);
    const LookupTable table(lit.level, s.receivers, {}, serialFor());
    const Work work{"receiver", double(s.receivers.size()), lit.bytes(table.slots().size()) + double(table.bytes())};
    timeStage(state, work, nothing,
              [&] {
                  for (std::size_t i = 0; i < s.receivers.size(); ++i) {
                      benchmark::DoNotOptimize(table.irradiance(i, lit.layout, lit.deposits, lit.layout.read(s.receivers[i].normal)));
                  }
              },
              Copy(work.bytes));
}

// The lines and rays that it asks for are held against bare Embree, which finds the first surface on each.
void build(benchmark::State& state, const StageScene& s, int n) {
    const ClvVolume volume = s.grid(n, kClvStorageCube9);
    const auto needed = neededCells(volume, s.receivers);
    std::vector<ClvRay> asked;
    const auto ask = [&](const vec3& origin, const vec3& direction, float length) {
        ClvRay& ray = asked.emplace_back();
        ray.origin = origin, ray.direction = direction, ray.maxDistance = length;
    };
    const SceneProbe probe = s.embree.probe();
    const SceneProbe noting{.lineHits = [&](const vec3& origin, const vec3& direction, float length, std::vector<LineHit>& hits) {
                                ask(origin, direction, length);
                                probe.lineHits(origin, direction, length, hits);
                            },
                            .occluded = [&](const vec3& from, const vec3& to) {
                                ask(from, normalize(to - from), distance(from, to));
                                return probe.occluded(from, to);
                            }};
    const Level level = buildLevel(volume, noting, needed, serialFor());
    timeStage(state, {"cell", double(std::count(needed.begin(), needed.end(), 1)), double(level.bytes())}, nothing,
              [&] { benchmark::DoNotOptimize(buildLevel(volume, probe, needed, serialFor())); }, [&] { benchmark::DoNotOptimize(traceBare(s.bare, asked)); });
    state.counters["queries/cell"] = double(asked.size()) / double(std::count(needed.begin(), needed.end(), 1));
}

// What a benchmark varies; the scene is made when the first one of them runs.
struct Setting {
    std::size_t rays = kRays;
    int cuts = 0;  // of triangles
};

template <class Body>
void add(const std::string& name, const std::string& scene, const std::string& parameter, const Setting& setting, Body&& body) {
    const std::string whole = name + "/" + scene + (parameter.empty() ? "" : "/" + parameter);
    benchmark::RegisterBenchmark(whole.c_str(), [=](benchmark::State& state) { body(state, stageScene(scene, setting.rays, setting.cuts)); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
}

std::string parameter(const std::string& name, std::size_t value) { return name + ":" + std::to_string(value); }

void addSweeps(const std::string& scene) {
    add("rsm", scene, "", {}, rsm);
    for (const std::size_t count : kRayCounts) {
        const std::string ofRays = parameter("rays", count);
        add("rays", scene, ofRays, {count}, rays);
        add("trace", scene, ofRays, {count}, trace);
        add("inject/32/cube9", scene, ofRays, {count}, [](benchmark::State& state, const StageScene& s) { inject(state, s, kCells, kClvStorageCube9); });
    }
    for (const int n : kCellCounts) {
        const std::string ofCells = parameter("resolution", std::size_t(n));
        for (const auto& [storageName, storage] : kStorages) {
            add(std::string("inject/") + storageName, scene, ofCells, {}, [n, storage](benchmark::State& state, const StageScene& s) { inject(state, s, n, storage); });
        }
        add("merge", scene, ofCells, {}, [n](benchmark::State& state, const StageScene& s) { merge(state, s, n); });
    }
    for (const int n : kFewCellCounts) {
        const std::string ofCells = parameter("resolution", std::size_t(n));
        for (const auto& [lookupName, lookup] : kLookups) {
            add(std::string("evaluate/") + lookupName, scene, ofCells, {}, [n, lookup](benchmark::State& state, const StageScene& s) { evaluate(state, s, n, lookup); });
        }
        add("evaluate/kept", scene, ofCells, {}, [n](benchmark::State& state, const StageScene& s) { evaluateKept(state, s, n); });
        add("build_level", scene, ofCells, {}, [n](benchmark::State& state, const StageScene& s) { build(state, s, n); });
    }
    std::size_t triangles = makeBuiltinScene(scene).triangles.size();
    for (int cuts = 0; triangles <= kMostTriangles; ++cuts, triangles *= 4) {
        const std::string ofTriangles = parameter("triangles", triangles);
        add("rsm", scene, ofTriangles, {kRays, cuts}, rsm);
        add("trace", scene, ofTriangles, {kRays, cuts}, trace);
        add("build_level/16", scene, ofTriangles, {kRays, cuts}, [](benchmark::State& state, const StageScene& s) { build(state, s, kFewCells); });
    }
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const std::string scene : {"cornell", "atrium"}) addSweeps(scene);
    return true;
}();

}  // namespace
}  // namespace clv
