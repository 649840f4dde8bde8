#include "benchmarks/report/heat_maps.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "benchmarks/report/runner.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "bindings/image/heat_map.h"

namespace clv {
namespace {

namespace fs = std::filesystem;

// Screen pixels a pixel of the measured pictures, about, so that the numbers beside them can be read.
constexpr int kShownHeight = 180;

struct ErrorPicture {
    const Measurement* measurement;
    std::vector<float> errors;  // a pixel; not a number where nothing is seen
};

std::vector<float> pixelErrors(const Image& estimate, const Image& truth) {
    std::vector<glm::vec3> seenEstimate, seenTruth;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        if (std::isnan(truth.pixels[i].x)) continue;
        seenEstimate.push_back(estimate.pixels[i]);
        seenTruth.push_back(truth.pixels[i]);
    }
    const std::vector<float> seen = pointErrors(seenEstimate, seenTruth);
    std::vector<float> all;
    auto next = seen.begin();
    for (const glm::vec3& t : truth.pixels) all.push_back(std::isnan(t.x) ? t.x : *next++);
    return all;
}

std::string drawn(const std::vector<float>& errors, const Image& shape, double top, const fs::path& file) {
    const int scale = std::max(1, kShownHeight / shape.height);
    std::vector<float> larger;
    for (int y = 0; y < scale * shape.height; ++y) {
        for (int x = 0; x < scale * shape.width; ++x) larger.push_back(errors[std::size_t(y / scale * shape.width + x / scale)]);
    }
    writePng(heatMap(larger, scale * shape.width, scale * shape.height, top), file.string());
    std::ifstream input(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(input), {}};
}

}  // namespace

std::vector<HeatMap> heatMapsAt(double seconds, double readers, const std::vector<Curve>& curves, const CurveLabels& labels, const fs::path& truthPicture, const fs::path& folder) {
    const Image truth = readImage(truthPicture.string());
    std::vector<std::string> methods;
    for (const Curve& curve : curves) {
        if (std::ranges::find(methods, curve.method) == methods.end()) methods.push_back(curve.method);
    }
    std::vector<ErrorPicture> pictures;
    std::vector<double> tops;  // below which most errors of a method lie
    for (const std::string& method : methods) {
        Points points;
        for (const Curve& curve : curves) {
            if (curve.method == method) points.insert(points.end(), curve.points.begin(), curve.points.end());
        }
        const Measurement* chosen = bestWithin(points, seconds, readers);
        if (!chosen) {
            const Points front = paretoFront(points, readers);
            if (front.empty()) continue;
            chosen = front.front();
        }
        pictures.push_back({chosen, pixelErrors(readImage(pictureFile(folder, *chosen).string()), truth)});
        std::vector<float> seen;
        std::ranges::copy_if(pictures.back().errors, std::back_inserter(seen), [](float e) { return std::isfinite(e); });
        tops.push_back(percentile95(seen));
    }
    // That of the method in the middle, so that one far off does not turn all others black. What is above looks alike.
    const double top = niceCeiling(std::max(median(tops), 1e-6));
    std::vector<HeatMap> maps;
    for (const ErrorPicture& picture : pictures) {
        fs::path file = pictureFile(folder, *picture.measurement);
        maps.push_back({fmt::format("{}: {}", labels.setting(*picture.measurement), timeText(picture.measurement->seconds(readers))),
                        drawn(picture.errors, truth, top, file.replace_extension(".png"))});
    }
    return maps;
}

}  // namespace clv
