// clv info: what this build and this machine offer.
#include <memory>
#include <thread>

#include "bindings/cli/command_line.h"
#include "bindings/cli/options.h"

namespace clv {
namespace {

// Of the instruction sets that matter to the loops here, those that this processor has.
Report cpuFeatures() {
    Report features = Report::array();
#if defined(__x86_64__)
    if (__builtin_cpu_supports("sse4.2")) features.push_back("sse4.2");
    if (__builtin_cpu_supports("avx2")) features.push_back("avx2");
    if (__builtin_cpu_supports("fma")) features.push_back("fma");
    if (__builtin_cpu_supports("avx512f")) features.push_back("avx512f");
#endif
    return features;
}

}  // namespace

void addInfoCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "Say what this build and this machine offer");
    auto options = std::make_shared<CommonOptions>();
    addCommonOptions(*command, *options);
    command->callback([options, command] {
        Report report = startReport(*command, *options);
        report["version"] = CLV_VERSION;
        report["hardware_threads"] = std::thread::hardware_concurrency();
        report["cpu_features"] = cpuFeatures();
        report["backends"] = {"cpu"};
        printReport(report, *options);
    });
}

}  // namespace clv
