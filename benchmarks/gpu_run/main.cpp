// clv_gpu_run: whether a GPU computes what the CPU computed, and how long each pass takes there; one JSON. See benchmarks/gpu.sh.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>

#include "benchmarks/gpu_run/check.h"
#include "benchmarks/gpu_run/json.h"
#include "benchmarks/gpu_run/times.h"
#include "benchmarks/gpu_run/ways.h"

namespace clv {
namespace {

constexpr const char* kUsage =
    "Usage: clv_gpu_run --pack DIR [--device NAME] [--out FILE] [--check-only] [--scene NAME] [--only TEXT] [--seconds S] [--every-cell]\n"
    "                   [--commit NAME] [--command TEXT]\n"
    "Compares a GPU with the CPU's stored results, times a frame's passes on it, and writes one JSON.\n";

struct Options {
    std::filesystem::path pack;       // folder that clv_gpu_store has written
    std::string device, out, scene = "atrium", only, commit = "unknown", command;
    double seconds = 1.0;             // of each timing, at least
    bool checkOnly = false, everyCell = false;
};

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

Options optionsOf(int count, char** arguments) {
    Options options;
    std::map<std::string, std::string*> texts{{"--device", &options.device}, {"--out", &options.out}, {"--scene", &options.scene}, {"--only", &options.only},
                                              {"--commit", &options.commit}, {"--command", &options.command}};
    std::map<std::string, bool*> flags{{"--check-only", &options.checkOnly}, {"--every-cell", &options.everyCell}};
    for (int i = 1; i < count; ++i) {
        const std::string name = arguments[i];
        if (flags.contains(name)) {
            *flags[name] = true;
            continue;
        }
        const bool known = texts.contains(name) || name == "--pack" || name == "--seconds";
        if (!known || i + 1 == count) throw UsageError((known ? "a value must follow " : "there is no option ") + name);
        const std::string value = arguments[++i];
        if (name == "--pack") {
            options.pack = value;
        } else if (name == "--seconds") {
            options.seconds = std::atof(value.c_str());
        } else {
            *texts[name] = value;
        }
    }
    if (options.pack.empty()) throw UsageError("--pack DIR is missing");
    return options;
}

std::string utcTime() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    return text;
}

std::string versionText(std::uint32_t version) {
    return std::to_string(version >> 22 & 0x7f) + "." + std::to_string(version >> 12 & 0x3ff) + "." + std::to_string(version & 0xfff);
}

Json deviceJson(const VulkanDeviceInfo& info) {
    return Json::object({{"name", info.name}, {"driver", info.driver}, {"type", info.type}, {"vulkan", versionText(info.apiVersion)}, {"memory_bytes", info.memory},
                         {"float_atomics", info.features.floatAtomics}, {"subgroup_size", info.features.subgroupSize}, {"ray_queries", info.features.rayQueries}, {"ray_pipelines", info.features.rayPipelines}, {"draws_slices", drawsSlices(info.features)}});
}

Json caseJson(const CaseResult& result) {
    return Json::object({{"name", result.name}, {"language", result.language}, {"inject", result.way}, {"trace", result.trace}, {"passed", result.passed}, {"found", result.words}});
}

Json rowJson(const TimedRow& row) { return Json::object({{"median_ms", row.median}, {"minimum_ms", row.minimum}}); }

Json wayJson(const TimedWay& way) {
    if (!way.failure.empty()) return Json::object({{"inject", wayName(way.way)}, {"trace", traceName(way.trace)}, {"failure", way.failure}});
    std::vector<Json::Member> members{{"inject", wayName(way.way)}, {"trace", traceName(way.trace)}, {"repeats", way.repeats}, {"rounds", way.rounds}, {"bytes", way.bytes}};
    for (int row = 0; row < kTimedRows; ++row) members.push_back({kTimedRowNames[row], rowJson(way.rows[row])});
    std::vector<Json::Member> passes;
    for (const auto& [pass, milliseconds] : way.passes) passes.push_back({pass, milliseconds});
    members.push_back({"passes_minimum_ms", Json::object(passes)});
    return Json::object(members);
}

// The way whose volume row is shortest, of those that keep the same light; null where none ran.
const TimedWay* fastestWay(const TimedFrame& frame) {
    const TimedWay* fastest = nullptr;
    for (const TimedWay& way : frame.ways) {
        if (way.failure.empty() && way.way != InjectWay::slices && (!fastest || way.rows[kVolumeRow].median < fastest->rows[kVolumeRow].median)) fastest = &way;
    }
    return fastest;
}

Json frameJson(const TimedFrame& frame) {
    std::vector<Json> ways;
    for (const TimedWay& way : frame.ways) ways.push_back(wayJson(way));
    const TimedWay* fastest = fastestWay(frame);
    std::vector<Json::Member> members{{"name", frame.setting.name}, {"cells", frame.setting.cells}, {"cascades", frame.setting.cascades}, {"rays", frame.setting.rays},
                                      {"receivers", frame.receivers}, {"slots", frame.slots},
                                      {"default", wayName(frame.ways.front().way)}, {"fastest", fastest ? wayName(fastest->way) : ""}, {"ways", ways},
                                      {"picture", rowJson(frame.picture)}, {"picture_wall", rowJson(frame.pictureWall)}};
    if (frame.setting.goal > 0.0) {
        const TimedWay& way = frame.ways.front();
        members.push_back({"h200_goal_ms", frame.setting.goal});
        members.push_back({"below_goal", way.failure.empty() && way.rows[kFrameRow].median <= frame.setting.goal});
    }
    return Json::object(members);
}

void printFrame(const TimedFrame& frame) {
    std::printf("\n%s: %llu slots, %llu pixels\n%-21s", frame.setting.name.c_str(), static_cast<unsigned long long>(frame.slots), static_cast<unsigned long long>(frame.receivers), "ms (median)");
    for (const char* row : kTimedRowNames) std::printf("%14s", row);
    for (const TimedWay& way : frame.ways) {
        std::printf("\n%-21s", (wayName(way.way) + ", " + traceName(way.trace)).c_str());
        if (!way.failure.empty()) std::printf("  %s", way.failure.c_str());
        if (way.failure.empty()) {
            for (const TimedRow& row : way.rows) std::printf("%14.3f", row.median);
        }
    }
    std::printf("\npicture %.3f, by the host's clock %.3f\n", frame.picture.median, frame.pictureWall.median);
    std::fflush(stdout);
}

bool run(const Options& options) {
    // First as it comes, to see what it has; then with the features that it has.
    const VulkanFeatures features = VulkanDevice({.device = options.device}).info().features;
    const VulkanOptions all{.device = options.device, .floatAtomics = features.floatAtomics, .rayQueries = true, .rayPipelines = true};
    VulkanDevice device(all), drawing(all);
    std::printf("%s, %s\n", device.info().name.c_str(), device.info().driver.c_str());

    std::vector<Json> cases, frames;
    bool passed = true;
    for (const CaseResult& result : checkCases(drawing, options.pack / "cases")) {
        std::string how = result.language;
        for (const std::string& way : {result.way, result.trace}) how += (way.empty() ? "" : ", ") + way;
        std::printf("%s  %s (%s): %s\n", result.passed ? "pass" : "FAIL", result.name.c_str(), how.c_str(), result.words.c_str());
        passed = passed && result.passed;
        cases.push_back(caseJson(result));
    }
    std::fflush(stdout);
    if (!options.checkOnly) {
        const StoredScene scene = readStoredScene(options.pack / "scenes" / (options.scene + ".scene"));
        for (const TimedSetting& setting : timedSettings()) {
            if (setting.name.find(options.only) == std::string::npos) continue;
            const TimedFrame frame = timeFrame(device, drawing, scene, setting, options.seconds, options.everyCell);
            printFrame(frame);
            frames.push_back(frameJson(frame));
        }
    }
    if (options.out.empty()) return passed;
    const Json json = Json::object({{"device", deviceJson(device.info())}, {"date", utcTime()}, {"commit", options.commit}, {"command", options.command}, {"passed", passed},
                                    {"cases", cases}, {"scene", options.scene}, {"every_cell", options.everyCell}, {"frames", frames}});
    std::ofstream file(options.out);
    file << json.text() << "\n";
    file.close();
    if (!file) throw std::runtime_error("cannot write " + options.out);
    return passed;
}

}  // namespace
}  // namespace clv

int main(int count, char** arguments) {
    try {
        return clv::run(clv::optionsOf(count, arguments)) ? 0 : 1;
    } catch (const clv::UsageError& error) {
        std::fprintf(stderr, "clv_gpu_run: %s\n%s", error.what(), clv::kUsage);
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "clv_gpu_run: %s\n", error.what());
        return 1;
    }
}
