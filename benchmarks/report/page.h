// The report as one page: tables and plots, nothing from elsewhere.
#pragma once
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/heat_maps.h"
#include "benchmarks/report/stage_times.h"

namespace clv {

// Readers that the page's times are for: some points, as of probes or a small picture, and a whole picture.
constexpr double kPointReaders = 3000, kPictureReaders = double(kPictureWidth) * kPictureHeight;
// Of the heat maps, s.
constexpr double kHeatMapBudget = 10e-3;

// `about` is what the head of the page says: names and values. Heat maps: of each scene.
std::string htmlOf(const std::vector<Measurement>& all, const nlohmann::ordered_json& about, const std::map<std::string, std::vector<HeatMap>>& heatMaps,
                   const std::vector<SceneStages>& stages);

}  // namespace clv
