// Measures methods in scenes, one by one, and goes on where an earlier run stopped.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/report/measurement.h"
#include "benchmarks/report/scene_truth.h"
#include "clv/cpu/parallel.h"

namespace clv {

// A method with its settings, at several costs: a curve.
struct MethodCase {
    std::function<std::unique_ptr<Method>()> make;
    std::vector<std::uint64_t> rays;   // of a frame; a measurement each
    std::vector<int> frames = {1};     // merged; rising; a measurement each, for every number of rays
    int repeats = 0;                   // in place of the plan's, where they would take too long; 0: the plan's
};

struct ReportPlan {
    std::vector<std::string> scenes;   // built-in ones or files
    std::vector<MethodCase> cases;
    TruthSettings truth;
    int repeats = 8;                   // with a seed each, after one that warms up
    std::uint32_t seed = 1;
    std::string program;               // measurements of another program are not taken over
};

// All measurements in the order of scenes, cases, rays and frames. `folder` must exist; it gets measurements.jsonl, the truths and the
// pictures (irradiance, named after the measurement by pictureFile()). `onProgress` is told the share of the work that is done, from any thread.
// Throws InputError where a scene is none, or the folder holds something else.
std::vector<Measurement> measureAll(const ReportPlan& plan, const std::filesystem::path& folder, const ParallelFor& parallelFor,
                                    const std::function<void(double)>& onProgress);

// What a method makes of the picture of the truth, first repeat; EXR.
std::filesystem::path pictureFile(const std::filesystem::path& folder, const Measurement& m);
// The picture of the truth; not a number where nothing is seen.
std::filesystem::path truthPictureFile(const std::filesystem::path& folder, const ReportPlan& plan, const std::string& scene);

}  // namespace clv
