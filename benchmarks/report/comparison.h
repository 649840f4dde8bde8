// A report against an earlier one: what has become worse.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/measurement.h"

namespace clv {

// The measurements of a report.json. Throws InputError.
std::vector<Measurement> readReport(const std::filesystem::path& file);

// Measurements that answer the same question are compared; one line for each that is worse, none where nothing is:
// - an error that has grown by more than both confidence intervals together,
// - this library's time over that of another method, in one scene and run, that has grown by more than 20 %. Times count by their
//   ratios alone, so the two reports may come from machines of different speed.
// Throws InputError where no question is in both.
std::vector<std::string> findRegressions(std::span<const Measurement> before, std::span<const Measurement> now);

}  // namespace clv
