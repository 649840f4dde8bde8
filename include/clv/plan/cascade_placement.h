// Where the cascades stand: around the camera or on its view frustum, always on whole cells of a lattice fixed in the world.
//
// World positions are doubles and lattice coordinates 64-bit integers, so that snapping is exact at any distance from the
// origin; the core gets positions relative to an anchor. A lattice cell keeps its storage address for as long as it is covered.
#ifndef CLV_PLAN_CASCADE_PLACEMENT_H
#define CLV_PLAN_CASCADE_PLACEMENT_H
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "../data/cascades.h"
#include "cell_box.h"
#include "number_check.h"

namespace clv {

using LatticeCell = glm::vec<3, std::int64_t>;

enum class CascadeFit {
    camera,   // centred on the camera: turning it moves nothing
    frustum,  // each cascade encloses as long a slice of the view frustum, from the camera on, as it can hold however it turns
};

struct CascadeDesc {
    int count = 4;                 // [1, kClvMaxCascades]
    ivec3 resolution{32};          // cells an axis of every cascade, > 2 * marginCells + 3, <= 1024
    double finestCellSize = 0.25;  // m, >= kMinCellSize
    double growth = 2.0;           // >= 1: cell size over that of the next finer cascade
    int marginCells = 2;           // >= 0: cells at each side that no surface in view needs
    CascadeFit fit = CascadeFit::camera;
};

struct CameraView {
    glm::dvec3 position{0.0};            // m, world space
    glm::dvec3 forward{0.0, 0.0, -1.0};  // unit length
    double yfov = 1.0;                   // rad, (0, pi)
    double aspect = 16.0 / 9.0;          // width over height, > 0
};

struct PlacedCascade {
    LatticeCell lowest{0};  // its lowest cell covers [lowest, lowest + 1) * cellSize in the world
    ivec3 resolution{0};
    double cellSize = 0.0;  // m
};

// Beyond this many cells from the origin a double no longer tells cells apart.
inline constexpr double kMaxLatticeCoordinate = 4503599627370496.0;  // 2^52

// m: within these a cell's volume, and one over it, are floats of full precision.
inline constexpr double kMinCellSize = 1e-12, kMaxCellSize = 1e12;

// Cells an axis, so that the index of a cell fits an int.
inline constexpr int kMaxCascadeResolution = 1024;

// Cell size (m) of a cascade; level 0 is the finest.
inline double cascadeCellSize(const CascadeDesc& desc, int level) {
    return desc.finestCellSize * std::pow(desc.growth, level);
}

// What is wrong with the description, in words; empty if nothing is.
inline std::string validate(const CascadeDesc& desc) {
    if (desc.count < 1 || desc.count > int(kClvMaxCascades)) {
        return "cascades: count must lie in [1, " + std::to_string(kClvMaxCascades) + "], not " + std::to_string(desc.count);
    }
    if (!liesIn(desc.finestCellSize, kMinCellSize)) return "cascades: finestCellSize must be at least 1e-12 m";
    if (!liesIn(desc.growth, 1.0)) return "cascades: growth must be at least 1";
    if (!liesIn(cascadeCellSize(desc, desc.count - 1), 0.0, kMaxCellSize)) return "cascades: the coarsest cells must be at most 1e12 m";
    if (desc.marginCells < 0) return "cascades: marginCells must not be negative";
    for (int axis = 0; axis < 3; ++axis) {
        if (desc.resolution[axis] / 2 - 1 <= desc.marginCells) return "cascades: resolution must exceed 2 * marginCells + 3";
        if (desc.resolution[axis] > kMaxCascadeResolution) {
            return "cascades: resolution must be at most " + std::to_string(kMaxCascadeResolution);
        }
    }
    return {};
}

// The same for a camera, and for the two together.
inline std::string validate(const CascadeDesc& desc, const CameraView& view) {
    if (std::string problem = validate(desc); !problem.empty()) return problem;
    for (int axis = 0; axis < 3; ++axis) {
        if (!isFinite(view.position[axis])) return "camera: position must be finite";
        if (std::abs(view.position[axis]) / desc.finestCellSize > kMaxLatticeCoordinate) {
            return "camera: position is more than 2^52 of the finest cells away from the origin";
        }
    }
    if (!liesIn(glm::length(view.forward), 1.0 - 1e-6, 1.0 + 1e-6)) return "camera: forward must be of unit length";
    if (!isFinite(view.yfov) || view.yfov <= 0.0 || view.yfov >= double(kClvPi)) return "camera: yfov must lie in (0, pi)";
    if (!isFinite(view.aspect) || view.aspect <= 0.0) return "camera: aspect must be above 0";
    return {};
}

// Radius (m) of the largest sphere that a cascade holds inside its margin wherever it snaps to: snapping moves it by half a cell.
inline double heldRadius(const CascadeDesc& desc, int level) {
    int narrowest = std::min({desc.resolution.x, desc.resolution.y, desc.resolution.z});
    return (narrowest / 2 - desc.marginCells - 0.5) * cascadeCellSize(desc, level);
}

// How far ahead (m) the frustum's slice from the camera on reaches whose bounding sphere has this radius, and where
// its centre lies. slope: tangent of half the angle between the frustum's opposite edges.
struct FrustumSlice {
    double farthest;
    double centre;
};
inline FrustumSlice sliceOfRadius(double radius, double slope) {
    // A wide slice is bounded by its far side, a narrow one by the camera and the far corners.
    if (slope >= 1.0) return {radius / slope, radius / slope};
    return {2.0 * radius / (1.0 + slope * slope), radius};
}

inline double frustumSlope(const CameraView& view) {
    double vertical = std::tan(0.5 * view.yfov);
    return vertical * std::hypot(1.0, view.aspect);
}

// Cascade `level` for a camera; desc and view are valid.
inline PlacedCascade placeCascade(const CascadeDesc& desc, const CameraView& view, int level) {
    PlacedCascade placed{.resolution = desc.resolution, .cellSize = cascadeCellSize(desc, level)};
    glm::dvec3 centre = view.position;
    if (desc.fit == CascadeFit::frustum) {
        centre += view.forward * sliceOfRadius(heldRadius(desc, level), frustumSlope(view)).centre;
    }
    for (int axis = 0; axis < 3; ++axis) {
        placed.lowest[axis] = std::llround(centre[axis] / placed.cellSize) - desc.resolution[axis] / 2;
    }
    return placed;
}

// An anchor near the camera on the lattice of the coarsest cascade: positions relative to it are small and stay put while the
// camera moves within a cell.
inline glm::dvec3 anchorNear(const CascadeDesc& desc, const CameraView& view) {
    double step = cascadeCellSize(desc, desc.count - 1);
    return {std::round(view.position.x / step) * step, std::round(view.position.y / step) * step,
            std::round(view.position.z / step) * step};
}

// Storage coordinate of a lattice cell: its remainder by the resolution, so that a cell never moves in memory.
inline ivec3 storageFromLattice(const LatticeCell& cell, const ivec3& resolution) {
    ivec3 stored;
    for (int axis = 0; axis < 3; ++axis) {
        std::int64_t remainder = cell[axis] % resolution[axis];
        stored[axis] = int(remainder < 0 ? remainder + resolution[axis] : remainder);
    }
    return stored;
}

// The inverse: the one lattice cell inside the cascade that is stored there.
inline LatticeCell latticeFromStorage(const PlacedCascade& placed, const ivec3& stored) {
    ivec3 lowest = storageFromLattice(placed.lowest, placed.resolution);
    LatticeCell cell = placed.lowest;
    for (int axis = 0; axis < 3; ++axis) cell[axis] += clvWrap(stored[axis] - lowest[axis], placed.resolution[axis]);
    return cell;
}

// The cascade as the core sees it, relative to the anchor.
inline ClvVolume volumeFromCascade(const PlacedCascade& placed, const glm::dvec3& anchor, uint storage) {
    ClvVolume volume{};
    volume.origin = vec3(glm::dvec3(placed.lowest) * placed.cellSize - anchor);
    volume.cellSize = float(placed.cellSize);
    volume.resolution = placed.resolution;
    volume.storage = storage;
    volume.scroll = storageFromLattice(placed.lowest, placed.resolution);
    return volume;
}

// All cascades for a camera. blendCells: width of the zone where neighbours mix, cells.
inline ClvCascades placeCascades(const CascadeDesc& desc, const CameraView& view, const glm::dvec3& anchor, uint storage,
                                 float blendCells) {
    ClvCascades cascades{};
    cascades.count = uint(desc.count);
    cascades.marginCells = float(desc.marginCells);
    cascades.blendCells = blendCells;
    for (int level = 0; level < desc.count; ++level) {
        cascades.volumes[level] = volumeFromCascade(placeCascade(desc, view, level), anchor, storage);
    }
    return cascades;
}

// How many cells a cascade moved along each axis, cut to its resolution: as far, and all of it is new.
// So it is too when the lattice itself changed.
inline ivec3 cascadeScroll(const PlacedCascade& before, const PlacedCascade& after) {
    if (before.cellSize != after.cellSize || before.resolution != after.resolution) return after.resolution;
    ivec3 moved;
    for (int axis = 0; axis < 3; ++axis) {
        std::int64_t size = after.resolution[axis];
        moved[axis] = int(std::clamp(after.lowest[axis] - before.lowest[axis], -size, size));
    }
    return moved;
}

// The cells that a scroll exposed, each in exactly one box: a slab for each axis, less what earlier slabs hold. Boxes may be empty.
inline std::array<CellBox, 3> exposedCells(const ivec3& resolution, const ivec3& moved) {
    std::array<CellBox, 3> boxes;
    CellBox rest{ivec3(0), resolution};  // what no slab has taken yet
    for (int axis = 0; axis < 3; ++axis) {
        boxes[axis] = rest;
        if (moved[axis] >= 0) {
            rest.hi[axis] -= moved[axis];
            boxes[axis].lo[axis] = rest.hi[axis];
        } else {
            rest.lo[axis] -= moved[axis];
            boxes[axis].hi[axis] = rest.lo[axis];
        }
    }
    return boxes;
}

}  // namespace clv
#endif
