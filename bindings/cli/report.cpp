// clv report: error against run time, of this library and of the methods that it competes with, measured on this machine.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "benchmarks/report/comparison.h"
#include "benchmarks/report/page.h"
#include "benchmarks/report/provenance.h"
#include "benchmarks/report/report_plans.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/options.h"
#include "bindings/cli/progress.h"
#include "bindings/cli/staged_output.h"
#include "bindings/cli/write_text.h"
#include "bindings/vulkan/vulkan_device.h"

namespace clv {
namespace {

constexpr int kMostPoints = 1 << 20, kMostRepeats = 1000;

// As the program was started, with quotes where a word needs them.
std::string commandLine() {
    std::ifstream input("/proc/self/cmdline", std::ios::binary);
    std::string text;
    for (std::string word; std::getline(input, word, '\0');) {
        const bool plain = word.find_first_of(" '\"\\$`") == std::string::npos;
        text += (text.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
    }
    return text;
}

// The device that rows of this library on Vulkan are measured on, or why there are none.
struct VulkanChoice {
    std::string name, whyNone;
};

VulkanChoice chooseVulkan() {
    try {
        const std::vector<VulkanDeviceInfo> devices = vulkanDevices();
        const auto discrete = std::ranges::find(devices, std::string("discrete"), &VulkanDeviceInfo::type);
        return {(discrete == devices.end() ? devices.front() : *discrete).name, {}};
    } catch (const std::runtime_error& error) {
        return {{}, error.what()};
    }
}

void keepMethods(std::vector<MethodCase>& cases, const std::vector<std::string>& methods) {
    std::set<std::string> names;
    for (const MethodCase& one : cases) names.insert(one.make()->name());
    for (const std::string& method : methods) {
        if (!names.contains(method)) throw InputError(fmt::format("--methods {}: expected some of: {}", method, fmt::join(names, ", ")));
    }
    std::erase_if(cases, [&](const MethodCase& one) { return std::ranges::find(methods, one.make()->name()) == methods.end(); });
}

struct ReportCommand {
    CommonOptions common;
    std::string out;
    std::string compare;  // report.json of an earlier report, or empty
    bool full = false;
    // In place of what the plan has, or empty.
    std::vector<std::string> scenes, methods;
    std::optional<std::uint64_t> mostRays;
    std::optional<std::size_t> points;
    std::optional<std::uint64_t> truthSamples;
    std::optional<int> repeats;

    ReportPlan plan(const VulkanChoice& vulkan) const {
        ReportPlan plan = full ? fullPlan(vulkan.name) : quickPlan(vulkan.name);
        if (!scenes.empty()) plan.scenes = scenes;
        if (!methods.empty()) keepMethods(plan.cases, methods);
        for (MethodCase& one : plan.cases) std::erase_if(one.rays, [&](std::uint64_t rays) { return rays > mostRays.value_or(rays); });
        if (std::ranges::all_of(plan.cases, [](const MethodCase& one) { return one.rays.empty(); })) throw InputError(fmt::format("--most-rays {}: leaves nothing to measure", *mostRays));
        plan.truth.points = points.value_or(plan.truth.points);
        plan.truth.samples = truthSamples.value_or(plan.truth.samples);
        plan.repeats = repeats.value_or(plan.repeats);
        plan.seed = common.seed;
        plan.program = fmt::format("{} on {} threads", programChecksum(), threadCount(common));
        return plan;
    }

    void run(const CLI::App& command) const {
        Report report = startReport(command, common);
        const VulkanChoice vulkan = chooseVulkan();
        const ReportPlan plan = this->plan(vulkan);
        const std::vector<Measurement> before = compare.empty() ? std::vector<Measurement>() : readReport(compare);
        const std::filesystem::path folder = outputFolder(out);
        StagedOutput output(folder);
        Progress progress("report");
        const std::vector<Measurement> all = measureAll(plan, folder, parallelForOf(common), [&](double share) { progress.update(share); });
        Progress stageProgress("stages");
        const std::vector<SceneStages> stages = measureStages(plan.scenes, plan.program, folder, [&](double share) { stageProgress.update(share); });
        report.update(provenance());
        report["command_line"] = commandLine();
        report["vulkan"] = vulkan.name.empty() ? "not measured: " + vulkan.whyNone : vulkan.name;
        const CurveLabels labels(all);
        std::map<std::string, std::vector<HeatMap>> heatMaps;
        for (const std::string& scene : plan.scenes)
            heatMaps[scene] = heatMapsAt(kHeatMapBudget, kPointReaders, curvesOf(all, scene), labels, truthPictureFile(folder, plan, scene), folder);
        writeText(output.path("report.html"), htmlOf(all, report, heatMaps, stages));
        Report file = report;
        file["measurements"] = Report::array();
        for (const Measurement& m : all) file["measurements"].push_back(toJson(m));
        file["stages"] = Report::array();
        for (const SceneStages& one : stages) file["stages"].push_back(toJson(one));
        writeText(output.path("report.csv"), csvOf(all));
        writeText(output.path("report.json"), file.dump(2, ' ', false, Report::error_handler_t::replace) + "\n");
        output.commit();

        report["scenes"] = plan.scenes;
        report["measurements"] = all.size();
        report["seconds"] = progress.seconds();
        report["out"] = out;
        report["files"] = {"report.html", "report.csv", "report.json"};
        const std::vector<std::string> worse = compare.empty() ? std::vector<std::string>() : findRegressions(before, all);
        if (!compare.empty()) report["worse"] = worse;
        printReport(report, common);
        if (!worse.empty()) throw std::runtime_error(fmt::format("worse than {}: {}", compare, fmt::join(worse, "; ")));
    }
};

}  // namespace

void addReportCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("report", "Measure error against run time, of this library and of other methods");
    auto options = std::make_shared<ReportCommand>();
    command->add_option("--out", options->out, "Folder for the report; made where it is missing. What an earlier run of this program measured there is kept")->required();
    auto* quick = command->add_flag("--quick")->description("A few minutes (the default)");
    command->add_flag("--full", options->full, "Within an hour: more scenes, settings, points and repeats")->excludes(quick);
    command->add_option("--scenes", options->scenes, "Scenes in place of the report's own: files, or names of built-in ones");
    command->add_option("--compare", options->compare, "The report.json of an earlier report; exit with 1 where an error or a ratio of times has become worse");
    command->add_option("--methods", options->methods, "Those of the report's methods to measure");
    addCountOption(*command, "--most-rays", options->mostRays, "Leave out what takes more rays a frame");
    command->add_option("--points", options->points, "Points where errors are measured")->check(CLI::Range(1, kMostPoints));
    addCountOption(*command, "--truth-samples", options->truthSamples, "Paths a point of the truth");
    command->add_option("--repeats", options->repeats, "Seeds a measurement")->check(CLI::Range(1, kMostRepeats));
    addCommonOptions(*command, options->common);
    command->callback([options, command] { options->run(*command); });
}

}  // namespace clv
