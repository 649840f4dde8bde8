// What `clv report` measures. A further setting is a line in report_plans.cpp.
#pragma once
#include "benchmarks/report/runner.h"

namespace clv {

// Within three minutes on two cores.
ReportPlan quickPlan();
// Within an hour.
ReportPlan fullPlan();

}  // namespace clv
