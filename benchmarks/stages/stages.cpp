// Time of each stage on one thread, on the built-in scenes: an item's time and bytes, and the share of the machine's own limit, which is
// measured in turns with the stage.
#include <benchmark/benchmark.h>

#include "benchmarks/stages/stage_runs.h"

namespace clv {
namespace {

constexpr std::size_t kRays = 16384, kRayCounts[] = {1024, 4096, kRays, 65536};
constexpr int kFewCells = 16, kCells = 32, kCellCounts[] = {kFewCells, kCells, 64, 128}, kFewCellCounts[] = {8, kFewCells, kCells, 64};
constexpr std::size_t kMostTriangles = 300'000;

const std::pair<const char*, std::uint32_t> kStorages[] = {
    {"cube9", kClvStorageCube9}, {"cube", kClvStorageCube}, {"sh1", kClvStorageSh1}, {"sh2", kClvStorageSh2}};
const std::pair<const char*, std::uint32_t> kLookups[] = {
    {"nearest", kClvLookupNearest}, {"trilinear", kClvLookupTrilinear}, {"linear_fit", kClvLookupLinearFit}};

// `share`: time of the limit over that of the stage, in turns in this run.
void timeStage(benchmark::State& state, const StageRun& run) {
    StageTurn sum;
    for (auto _ : state) {
        const StageTurn turn = takeTurn(run);
        state.SetIterationTime(turn.stage);
        sum.stage += turn.stage, sum.limit += turn.limit;
    }
    state.counters[run.item + "s/s"] = benchmark::Counter(run.items, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["s/" + run.item] = benchmark::Counter(run.items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["bytes/" + run.item] = run.bytes / run.items;
    state.counters["share"] = sum.limit / sum.stage;
    for (const auto& [name, value] : run.figures) state.counters[name] = value;
}

// What a benchmark varies; the scene is made when the first one of them runs.
struct Setting {
    std::size_t rays = kRays;
    int cuts = 0;  // of triangles
};

template <class Make>
void add(const std::string& name, const std::string& scene, const std::string& parameter, const Setting& setting, Make&& make) {
    const std::string whole = name + "/" + scene + (parameter.empty() ? "" : "/" + parameter);
    benchmark::RegisterBenchmark(whole.c_str(), [=](benchmark::State& state) { timeStage(state, make(stageScene(scene, setting.rays, setting.cuts))); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
}

std::string parameter(const std::string& name, std::size_t value) { return name + ":" + std::to_string(value); }

void addSweeps(const std::string& scene) {
    add("rsm", scene, "", {}, rsmRun);
    for (const std::size_t count : kRayCounts) {
        const std::string ofRays = parameter("rays", count);
        add("rays", scene, ofRays, {count}, raysRun);
        add("trace", scene, ofRays, {count}, traceRun);
        add("inject/32/cube9", scene, ofRays, {count}, [](const StageScene& s) { return injectRun(s, kCells, kClvStorageCube9); });
    }
    for (const int n : kCellCounts) {
        const std::string ofCells = parameter("resolution", std::size_t(n));
        for (const auto& [storageName, storage] : kStorages) {
            add(std::string("inject/") + storageName, scene, ofCells, {}, [n, storage](const StageScene& s) { return injectRun(s, n, storage); });
        }
        add("merge", scene, ofCells, {}, [n](const StageScene& s) { return mergeRun(s, n); });
    }
    for (const int n : kFewCellCounts) {
        const std::string ofCells = parameter("resolution", std::size_t(n));
        for (const auto& [lookupName, lookup] : kLookups) {
            add(std::string("evaluate/") + lookupName, scene, ofCells, {}, [n, lookup](const StageScene& s) { return evaluateRun(s, std::make_shared<const LitLevel>(s, n), lookup); });
        }
        add("evaluate/kept", scene, ofCells, {}, [n](const StageScene& s) { return evaluateKeptRun(s, std::make_shared<const LitLevel>(s, n)); });
        add("build_level", scene, ofCells, {}, [n](const StageScene& s) { return buildLevelRun(s, n); });
    }
    std::size_t triangles = makeBuiltinScene(scene).triangles.size();
    for (int cuts = 0; triangles <= kMostTriangles; ++cuts, triangles *= 4) {
        const std::string ofTriangles = parameter("triangles", triangles);
        add("rsm", scene, ofTriangles, {kRays, cuts}, rsmRun);
        add("trace", scene, ofTriangles, {kRays, cuts}, traceRun);
        add("build_level/16", scene, ofTriangles, {kRays, cuts}, [](const StageScene& s) { return buildLevelRun(s, kFewCells); });
    }
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const std::string scene : {"cornell", "atrium"}) addSweeps(scene);
    return true;
}();

}  // namespace
}  // namespace clv
