// The frames of a file: one of a .vtm, many of a .pvd.
#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "bindings/volume_file/volume_file.h"

namespace clv {

inline constexpr std::size_t kLastFrame = std::numeric_limits<std::size_t>::max();

class Series {
public:
    // Without frames.
    Series() = default;
    // Throws InputError.
    explicit Series(const std::string& file);

    std::size_t frames() const { return steps_.size(); }
    double time(std::size_t frame) const { return steps_[frame].time; }  // s
    // From 0, or kLastFrame. Throws InputError.
    BakedVolume load(std::size_t frame, const ParallelFor& parallelFor) const;

private:
    std::vector<SeriesStep> steps_;
};

}  // namespace clv
