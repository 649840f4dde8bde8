#include "benchmarks/report/stage_times.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "benchmarks/report/kept_file.h"
#include "benchmarks/report/statistics.h"

namespace clv {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRays = 16384;
constexpr double kLeastSeconds = 0.1;
constexpr std::size_t kLeastTurns = 3;

SceneStages stagesFrom(const nlohmann::ordered_json& json) {
    SceneStages stages{json.at("scene"), {}};
    for (const auto& one : json.at("times"))
        stages.times.push_back({one.at("stage"), one.at("item"), one.at("ns"), one.at("ns_spread"), one.at("bytes"), one.at("limit"), one.at("share")});
    return stages;
}

// Nothing where the file is missing, damaged or of another program: then stages are measured anew.
std::vector<SceneStages> readStages(const fs::path& file, const std::string& program) {
    std::ifstream input(file, std::ios::binary);
    std::vector<SceneStages> all;
    try {
        const auto kept = nlohmann::ordered_json::parse(input);
        if (kept.at("program") != program) return {};
        for (const auto& one : kept.at("scenes")) all.push_back(stagesFrom(one));
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return all;
}

void writeStages(const fs::path& file, const std::string& program, const std::vector<SceneStages>& all) {
    nlohmann::ordered_json kept{{"program", program}, {"scenes", nlohmann::ordered_json::array()}};
    for (const SceneStages& stages : all) kept["scenes"].push_back(toJson(stages));
    keepFile(file, kept.dump());
}

}  // namespace

StageTime timeOf(const std::string& stage, const StageRun& run) {
    takeTurn(run);  // warms up
    std::vector<double> times, shares;
    for (double seconds = 0.0; seconds < kLeastSeconds || times.size() < kLeastTurns;) {
        const StageTurn turn = takeTurn(run);
        seconds += turn.stage + turn.limit;
        times.push_back(1e9 * turn.stage / run.items);
        shares.push_back(turn.limit / turn.stage);
    }
    return {stage, run.item, median(times), middleHalf(times), run.bytes / run.items, run.limitName, median(shares)};
}

std::vector<StageTime> timeStages(const Scene& scene, const std::function<void(double)>& onProgress) {
    if (scene.lights.empty()) return {};
    const StageScene s(scene, kRays);
    const auto lit = std::make_shared<const LitLevel>(s, 32);
    const std::pair<const char*, std::function<StageRun()>> stages[] = {
        {"rsm", [&] { return rsmRun(s); }},
        {"rays", [&] { return raysRun(s); }},
        {"trace", [&] { return traceRun(s); }},
        {"inject 16³", [&] { return injectRun(s, 16, kClvStorageCube9); }},
        {"inject 32³", [&] { return injectRun(s, 32, kClvStorageCube9); }},
        {"inject 64³", [&] { return injectRun(s, 64, kClvStorageCube9); }},
        {"merge 32³", [&] { return mergeRun(s, 32); }},
        {"evaluate 32³, trilinear", [&] { return evaluateRun(s, lit, kClvLookupTrilinear); }},
        {"evaluate 32³, linear fit", [&] { return evaluateRun(s, lit, kClvLookupLinearFit); }},
        {"evaluate 32³, weights kept", [&] { return evaluateKeptRun(s, lit); }},
        {"build_level 16³", [&] { return buildLevelRun(s, 16); }},
    };
    std::vector<StageTime> times;
    double done = 0.0;
    for (const auto& [name, make] : stages) {
        const StageRun run = make();
        if (run.items > 0.0) times.push_back(timeOf(name, run));
        onProgress(++done / double(std::size(stages)));
    }
    return times;
}

std::vector<SceneStages> measureStages(const std::vector<std::string>& scenes, const std::string& program, const fs::path& folder,
                                       const std::function<void(double)>& onProgress) {
    const fs::path file = folder / "stages.json";
    std::vector<SceneStages> kept = readStages(file, program), asked;
    double done = 0.0;
    for (const std::string& scene : scenes) {
        auto found = std::ranges::find(kept, scene, &SceneStages::scene);
        if (found == kept.end()) {
            const double share = 1.0 / double(scenes.size());
            found = kept.insert(kept.end(), {scene, timeStages(loadScene(scene), [&](double part) { onProgress((done + part) * share); })});
            writeStages(file, program, kept);
        }
        asked.push_back(*found);
        ++done;
    }
    return asked;
}

nlohmann::ordered_json toJson(const SceneStages& stages) {
    nlohmann::ordered_json times = nlohmann::ordered_json::array();
    for (const StageTime& t : stages.times)
        times.push_back({{"stage", t.stage}, {"item", t.item}, {"ns", t.nanoseconds}, {"ns_spread", t.spread}, {"bytes", t.bytes}, {"limit", t.limit}, {"share", t.share}});
    return {{"scene", stages.scene}, {"times", times}};
}

}  // namespace clv
