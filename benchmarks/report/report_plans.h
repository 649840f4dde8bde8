// What `clv report` measures. A further setting is a line in report_plans.cpp.
#pragma once
#include "benchmarks/report/runner.h"

namespace clv {

// Within three minutes on two cores. `vulkanDevice`: index or a part of its name; empty: none, and no rows of one.
ReportPlan quickPlan(const std::string& vulkanDevice);
// Within an hour.
ReportPlan fullPlan(const std::string& vulkanDevice);

}  // namespace clv
