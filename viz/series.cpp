#include "viz/series.h"

#include <filesystem>

#include <fmt/format.h>

namespace clv {
namespace fs = std::filesystem;

Series::Series(const std::string& file) {
    if (fs::path(file).extension() != ".pvd") {
        steps_ = {{0.0, file}};
        return;
    }
    steps_ = readSeries(file);
    if (steps_.empty()) throw InputError(fmt::format("{}: expected at least one frame", file));
    for (SeriesStep& step : steps_) step.vtm = (fs::path(file).parent_path() / step.vtm).string();
}

BakedVolume Series::load(std::size_t frame, const ParallelFor& parallelFor) const {
    if (frame == kLastFrame) frame = frames() - 1;
    if (frame >= frames()) throw InputError(fmt::format("--frame {}: expected a number below {}", frame, frames()));
    return readVolume(steps_[frame].vtm, parallelFor);
}

}  // namespace clv
