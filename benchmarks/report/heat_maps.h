// Where methods err, side by side.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/report/curves.h"

namespace clv {

struct HeatMap {
    std::string title;
    std::string png;  // bytes of the file
};

// Of each method that which errs least within `seconds`, else its fastest; all with the same colours. `truthPicture` is that of the
// scene, and `folder` has the pictures of the measurements. Throws ImageError where one is missing.
std::vector<HeatMap> heatMapsAt(double seconds, double readers, const std::vector<Curve>& curves, const CurveLabels& labels,
                                const std::filesystem::path& truthPicture, const std::filesystem::path& folder);

}  // namespace clv
