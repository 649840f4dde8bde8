// Volumes on disk, as VTK's XML files that ParaView opens: a .vtm that lists a .vti a cascade, and a .pvd that lists the frames of a
// series. docs/inspector.md has the arrays and their units.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bindings/volume_file/baked_volume.h"
#include "clv/cpu/parallel.h"

namespace clv {

// Where to write the file that will be called `name`, relative to one folder; a name may begin with a folder of its own.
using PathOfName = std::function<std::string(const std::string& name)>;

// Asks for the paths of the pieces, "V/cascade_0.vti" for "V.vtm", and of `vtm` last, in whose folder they lie. Throws
// std::runtime_error where there is no room.
void writeVolume(const std::string& vtm, const BakedVolume& volume, const PathOfName& pathOf);
// Throws InputError, one line that names the file and what was expected, unless the whole volume is there as it was written. Pieces
// are read side by side.
BakedVolume readVolume(const std::string& vtm, const ParallelFor& parallelFor = serialFor());

struct SeriesStep {
    double time = 0.0;  // s
    std::string vtm;    // relative to the folder of the series
};
void writeSeries(const std::string& pvd, std::span<const SeriesStep> steps, const PathOfName& pathOf);
// Throws InputError. The volumes themselves are not opened.
std::vector<SeriesStep> readSeries(const std::string& pvd);

}  // namespace clv
