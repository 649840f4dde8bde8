// Options that several commands share.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "bindings/scene/scene.h"
#include "clv/cpu/parallel.h"

namespace clv {

using Report = nlohmann::ordered_json;

struct CommonOptions {
    bool json = false;
    std::string backend = "cpu";
    int threads = 0;  // 0: all of the machine's
    std::uint32_t seed = 1;
};
void addCommonOptions(CLI::App& command, CommonOptions& options);

// The number of threads that `options` come down to.
int threadCount(const CommonOptions& options);
ParallelFor parallelForOf(const CommonOptions& options);

// A report that starts with what every command says: its name, back end, threads and seed. Throws InputError for a back end
// that the command does not have.
Report startReport(const CLI::App& command, const CommonOptions& options, bool usesGpu = false);
// Prints the report on stdout: with --json as one object, else as lines for people. Throws std::runtime_error.
void printReport(const Report& report, const CommonOptions& options);

struct SceneOptions {
    std::string scene = "atrium";
    std::string lights;  // file that replaces the scene's lights, or empty
};
void addSceneOptions(CLI::App& command, SceneOptions& options, bool required);
// Loads the scene with its lights and says in `report` what was loaded and what was left out. Throws InputError.
Scene loadScene(const SceneOptions& options, Report& report);

// "65536", "64k" or "4M" (k = 1024, M = 1024 k), at least 1. Throws InputError that names the option.
std::uint64_t parseCount(const std::string& option, const std::string& text);
CLI::Option* addCountOption(CLI::App& command, const std::string& name, std::uint64_t& value, const std::string& description);
CLI::Option* addCountOption(CLI::App& command, const std::string& name, std::optional<std::uint64_t>& value, const std::string& description);
// Checks for a number in (above, atMost]; `expected` says so in words.
CLI::Validator finiteNumber(double above, double atMost, const std::string& expected);
CLI::Option* addPositiveOption(CLI::App& command, const std::string& name, double& value, const std::string& description);

// --points and --out; `columns` says what the output has beside the columns of the points.
void addPointOptions(CLI::App& command, std::string& points, std::string& out, const std::string& columns);

// "one" or "all".
void addBouncesOption(CLI::App& command, bool& allBounces);

}  // namespace clv
