#include "benchmarks/report/report_plans.h"

#include "benchmarks/baselines/path_tracing.h"

namespace clv {
namespace {

constexpr std::uint64_t kThousand = 1 << 10, kMillion = 1 << 20;

}  // namespace

ReportPlan quickPlan() {
    ReportPlan plan;
    plan.scenes = {"cornell", "atrium"};
    plan.cases = {{.make = makePathTracing, .rays = {16 * kThousand, 64 * kThousand, 256 * kThousand}}};
    plan.truth = {.points = 1000, .pictureWidth = 64, .samples = 8192};
    plan.repeats = 4;
    return plan;
}

ReportPlan fullPlan() {
    ReportPlan plan;
    plan.scenes = {"cornell", "two_rooms", "atrium", "atrium_turned"};
    plan.cases = {{.make = makePathTracing, .rays = {16 * kThousand, 64 * kThousand, 256 * kThousand, kMillion, 4 * kMillion}}};
    plan.truth = {.points = 3000, .pictureWidth = 128, .samples = 65536};
    plan.repeats = 8;
    return plan;
}

}  // namespace clv
