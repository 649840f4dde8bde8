// Runs the benchmarks that the program has registered. Behind their results stand the exponents with which times grow with each
// parameter in their names. `--benchmark_format=json` and the like come from Google Benchmark.
#include <benchmark/benchmark.h>

#include <memory>

#include "benchmarks/report/growth.h"

namespace clv {
namespace {

// Hands all on to Google Benchmark's own reporter, and the exponents at the end as if they were results.
class GrowthReporter : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context& context) override { return shown_->ReportContext(context); }
    void ReportRuns(const std::vector<Run>& runs) override {
        shown_->ReportRuns(runs);
        for (const Run& run : runs) {
            const bool aggregate = run.run_type == Run::RT_Aggregate;
            if (run.error_occurred || (aggregate && run.aggregate_name != "median")) continue;
            // Wall or device time where the benchmark asks for it: only then the name says so.
            const std::string& kind = run.run_name.time_type;
            const double time = kind.ends_with("real_time") || kind.ends_with("manual_time") ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime();
            if (time > 0.0) (aggregate ? medians_ : runs_).push_back({run.run_name.function_name, time / benchmark::GetTimeUnitMultiplier(run.time_unit)});
        }
    }
    void Finalize() override {
        std::vector<Run> exponents;
        for (const Growth& growth : growthsOf(runs_.empty() ? medians_ : runs_)) {
            Run& run = exponents.emplace_back();
            run.run_name.function_name = growth.name;
            run.run_type = Run::RT_Aggregate;
            run.aggregate_name = "growth";
            run.counters["exponent"] = growth.law.exponent;
            run.counters["plus_minus"] = growth.law.interval;
        }
        if (!exponents.empty()) shown_->ReportRuns(exponents);
        shown_->Finalize();
    }

private:
    const std::unique_ptr<BenchmarkReporter> shown_{benchmark::CreateDefaultDisplayReporter()};
    std::vector<TimedRun> runs_, medians_;  // the latter stand alone where the former are not asked for
};

}  // namespace
}  // namespace clv

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    clv::GrowthReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
}
