// clv report: error against run time, of this library and of the methods that it competes with, measured on this machine.
#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "benchmarks/report/provenance.h"
#include "benchmarks/report/report_plans.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/options.h"
#include "bindings/cli/progress.h"
#include "bindings/cli/staged_output.h"

namespace clv {
namespace {

void writeText(const std::string& file, const std::string& text) {
    std::ofstream output(file, std::ios::binary);
    output << text << std::flush;
    if (!output) throw std::runtime_error(fmt::format("{}: cannot be written", file));
}

struct ReportCommand {
    CommonOptions common;
    std::string out;
    std::vector<std::string> scenes;  // in place of those of the plan, or empty
    bool full = false;

    void run(const CLI::App& command) const {
        Report report = startReport(command, common);
        const std::filesystem::path folder = outputFolder(out);
        StagedOutput output(folder);
        ReportPlan plan = full ? fullPlan() : quickPlan();
        if (!scenes.empty()) plan.scenes = scenes;
        plan.seed = common.seed;
        plan.program = fmt::format("{} on {} threads", programChecksum(), threadCount(common));

        Progress progress("report");
        const std::vector<Measurement> all = measureAll(plan, folder, parallelForOf(common), [&](double share) { progress.update(share); });
        report.update(provenance());
        report["size"] = full ? "full" : "quick";
        Report file = report;
        file["measurements"] = Report::array();
        for (const Measurement& m : all) file["measurements"].push_back(toJson(m));
        writeText(output.path("report.csv"), csvOf(all));
        writeText(output.path("report.json"), file.dump(2, ' ', false, Report::error_handler_t::replace) + "\n");
        output.commit();

        report["scenes"] = plan.scenes;
        report["measurements"] = all.size();
        report["seconds"] = progress.seconds();
        report["out"] = out;
        report["files"] = {"report.csv", "report.json"};
        printReport(report, common);
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
    addCommonOptions(*command, options->common);
    command->callback([options, command] { options->run(*command); });
}

}  // namespace clv
