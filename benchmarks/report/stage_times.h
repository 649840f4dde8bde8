// What each stage takes in a scene, on one thread, and the share of the machine's own limit that it reaches: the short list that a
// report shows.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/stages/stage_runs.h"

namespace clv {

struct StageTime {
    std::string stage;           // with its setting: "inject 32³"
    std::string item;            // that times and bytes are counted by
    double nanoseconds = 0.0;    // an item, median over the turns
    double spread = 0.0;         // ns, of the middle half
    double bytes = 0.0;          // an item, read and written
    std::string limit;           // of the machine, measured in turns with the stage
    double share = 0.0;          // of it that the stage reaches: 1 is as fast as the limit
};

struct SceneStages {
    std::string scene;
    std::vector<StageTime> times;
};

// `run` in turns with its limit, for a tenth of a second at least.
StageTime timeOf(const std::string& stage, const StageRun& run);

// Those of a scene that has work for them: none without lights. `onProgress` is told the share that is done.
std::vector<StageTime> timeStages(const Scene& scene, const std::function<void(double)>& onProgress);

// Of each scene, kept in stages.json of `folder`, which must exist, and taken from there where the same program measured them.
std::vector<SceneStages> measureStages(const std::vector<std::string>& scenes, const std::string& program, const std::filesystem::path& folder,
                                       const std::function<void(double)>& onProgress);

nlohmann::ordered_json toJson(const SceneStages& stages);

}  // namespace clv
