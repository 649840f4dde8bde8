// clv stress: stiff and extreme cases, each with what must hold and what was measured.
#include <chrono>
#include <exception>
#include <memory>

#include <fmt/format.h>

#include "bindings/cli/command_line.h"
#include "bindings/cli/options.h"
#include "bindings/cli/progress.h"
#include "bindings/cli/stress/stress_run.h"

namespace clv {

std::vector<StressCase> stressCases() {
    std::vector<StressCase> all;
    for (auto group : {historyCases, walkCases, fluxCases, gridCases, propertyCases, precisionCases, bounceCases, brightnessCases, sceneCases, tailCases, movingCases, extremeCases}) {
        for (StressCase& one : group()) all.push_back(std::move(one));
    }
    return all;
}

namespace {

Report measure(const StressCase& one, const StressSettings& settings) {
    Report row = {{"group", one.group}, {"name", one.name}, {"claim", one.claim}, {"holds", true}, {"figures", Report::array()}};
    const auto start = std::chrono::steady_clock::now();
    try {
        for (const StressFigure& figure : one.run(settings)) {
            Report entry = {{"name", figure.name}, {"value", figure.value}};
            if (figure.atMost != StressFigure::kStated) entry["at_most"] = figure.atMost, entry["holds"] = figure.holds();
            if (!figure.holds()) row["holds"] = false;
            row["figures"].push_back(entry);
        }
    } catch (const std::exception& error) {
        row["holds"] = false;
        row["error"] = error.what();
    }
    row["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return row;
}

void printRow(const Report& row) {
    fmt::print("{} {}: {}\n", row["holds"].get<bool>() ? "holds" : "FAILS", row["group"].get<std::string>(), row["name"].get<std::string>());
    fmt::print("      {}\n", row["claim"].get<std::string>());
    for (const Report& figure : row["figures"]) {
        const std::string bound = figure.contains("at_most") ? fmt::format(" (at most {:g}{})", figure["at_most"].get<double>(), figure["holds"].get<bool>() ? "" : ": FAILS") : "";
        fmt::print("      {:<66} {:>12.4g}{}\n", figure["name"].get<std::string>(), figure["value"].get<double>(), bound);
    }
    if (row.contains("error")) fmt::print("      {}\n", row["error"].get<std::string>());
}

void printGroups(const Report& rows) {
    struct Group {
        std::string name;
        int cases = 0, hold = 0;
        double seconds = 0.0;
    };
    std::vector<Group> groups;
    for (const Report& row : rows) {
        if (groups.empty() || groups.back().name != row["group"]) groups.push_back({row["group"].get<std::string>()});
        ++groups.back().cases, groups.back().hold += row["holds"].get<bool>(), groups.back().seconds += row["seconds"].get<double>();
    }
    fmt::print("\n{:<12} | {:>5} | {:>5} | {:>6}\n", "group", "cases", "hold", "s");
    for (const Group& group : groups) fmt::print("{:<12} | {:>5} | {:>5} | {:>6.1f}\n", group.name, group.cases, group.hold, group.seconds);
}

struct StressCommand {
    CommonOptions common;
    std::string only;
    bool exhaustive = false;

    void run(const CLI::App& command) const {
        std::vector<StressCase> cases;
        for (StressCase& one : stressCases()) {
            if (only.empty() || one.group == only || one.name.find(only) != std::string::npos) cases.push_back(std::move(one));
        }
        Report report = startReport(command, common);
        if (cases.empty()) throw InputError(fmt::format("--only {}: no case has this name or group", only));
        runStress(cases, {exhaustive, common.seed, parallelForOf(common)}, common, std::move(report));
    }
};

}  // namespace

void runStress(std::span<const StressCase> cases, const StressSettings& settings, const CommonOptions& common, Report report) {
    Progress progress("stress");
    std::size_t failed = 0;
    report["cases"] = Report::array();
    for (const StressCase& one : cases) {
        progress.update(double(report["cases"].size()) / double(cases.size()));
        report["cases"].push_back(measure(one, settings));
        const Report& row = report["cases"].back();
        failed += !row["holds"].get<bool>();
        if (!common.json) printRow(row);
    }
    report["held"] = cases.size() - failed;
    report["failed"] = failed;
    report["seconds"] = progress.seconds();
    if (common.json) {
        printReport(report, common);
    } else {
        printGroups(report["cases"]);
        fmt::print("{} of {} cases hold, in {:.1f} s\n", cases.size() - failed, cases.size(), progress.seconds());
    }
    if (failed > 0) throw std::runtime_error(fmt::format("{} of {} cases do not hold", failed, cases.size()));
}

void addStressCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("stress", "Try stiff and extreme cases; fails where one does not hold");
    auto options = std::make_shared<StressCommand>();
    command->add_flag("--exhaustive", options->exhaustive, "A hundred million rays, ten million triangles and more: minutes in place of a quarter of one");
    command->add_option("--only", options->only, "Cases of this group, or with this in their name");
    addCommonOptions(*command, options->common);
    command->callback([options, command] { options->run(*command); });
}

}  // namespace clv
