// Cascades at the ends of their range: far from the origin, in one huge step, or without a camera that makes sense.
#include <cmath>

#include "bindings/cli/stress/stress_case.h"
#include "clv/cpu/moving_lighting.h"
#include "clv/math/hash.h"

namespace clv {
namespace {

// Snapping at a distance: cells must stay on their lattice to the bit, and hold the camera.
std::vector<StressFigure> farFromOrigin(double distance, const StressSettings& settings) {
    const CascadeDesc desc;
    CameraView view;
    double outside = 0.0, offLattice = 0.0, moved = 0.0;
    for (uint k = 0; k < 2000; ++k) {
        for (int axis = 0; axis < 3; ++axis) view.position[axis] = distance + 50.0 * double(clvUnitFloat(clvHashCombine(settings.seed, 3 * k + uint(axis))));
        const glm::dvec3 anchor = anchorNear(desc, view);
        for (int level = 0; level < desc.count; ++level) {
            const PlacedCascade placed = placeCascade(desc, view, level);
            const ClvVolume volume = volumeFromCascade(placed, anchor, kClvStorageCube9);
            const vec3 local(view.position - anchor);
            outside += clvCellInside(volume, clvCellFromPosition(volume, local)) == 0;
            // The lowest corner is a whole number of cells from the anchor, which is itself on the lattice.
            const glm::dvec3 cells = glm::dvec3(volume.origin) / placed.cellSize;
            for (int axis = 0; axis < 3; ++axis) offLattice = largerOf(offLattice, std::abs(cells[axis] - std::round(cells[axis])));
            // A move by much less than a cell from its middle changes nothing.
            CameraView near = view;
            near.position = (glm::dvec3(placed.lowest) + 0.5 * glm::dvec3(desc.resolution)) * placed.cellSize + 1e-3 * placed.cellSize;
            CameraView nearer = near;
            nearer.position -= 2e-3 * placed.cellSize;
            moved += placeCascade(desc, near, level).lowest != placeCascade(desc, nearer, level).lowest;
        }
    }
    return {{"cameras outside of their cascade", outside, 0.0}, {"cells off the lattice", offLattice, 0.0}, {"cascades that moved within a cell", moved, 0.0}};
}

// A camera that jumps: all cells are new, and each is asked for once.
std::vector<StressFigure> jumps(const StressSettings&) {
    const CascadeDesc desc;
    CameraView view;
    double wrong = 0.0;
    for (double step : {1.0, 31.0, 32.0, 33.0, 1e6, 1e12}) {
        for (int axis = 0; axis < 3; ++axis) {
            const PlacedCascade before = placeCascade(desc, view, 0);
            CameraView after = view;
            after.position[axis] += step * desc.finestCellSize;
            const ivec3 moved = cascadeScroll(before, placeCascade(desc, after, 0));
            std::size_t exposed = 0;
            for (const CellBox& box : exposedCells(desc.resolution, moved)) exposed += cellsInBox(box);
            const auto expected = std::size_t(std::min(step, 32.0)) * 32 * 32;
            wrong += exposed != expected;
        }
    }
    return {{"jumps with a wrong number of new cells", wrong, 0.0}};
}

// What cannot work must be said, in words, before anything is made of it.
std::vector<StressFigure> badDescriptions(const StressSettings&) {
    const double nan = std::nan(""), inf = HUGE_VAL;
    std::vector<std::string> said;
    const auto desc = [&](auto&& change) {
        CascadeDesc d;
        change(d);
        said.push_back(validate(d));
    };
    const auto camera = [&](auto&& change) {
        CameraView v;
        change(v);
        said.push_back(validate(CascadeDesc{}, v));
    };
    const auto light = [&](auto&& change) {
        MovingLightingSettings s;
        change(s);
        said.push_back(validate(s));
    };
    desc([](CascadeDesc& d) { d.count = 0; });
    desc([](CascadeDesc& d) { d.count = 1 << 30; });
    desc([](CascadeDesc& d) { d.resolution = ivec3(0); });
    desc([](CascadeDesc& d) { d.resolution = ivec3(-5, 32, 32); });
    desc([](CascadeDesc& d) { d.resolution = ivec3(1 << 30); });
    desc([](CascadeDesc& d) { d.resolution = ivec3(2, 32, 32); });
    desc([&](CascadeDesc& d) { d.finestCellSize = nan; });
    desc([&](CascadeDesc& d) { d.finestCellSize = inf; });
    desc([](CascadeDesc& d) { d.finestCellSize = 0.0; });
    desc([](CascadeDesc& d) { d.finestCellSize = 1e-320; });
    desc([&](CascadeDesc& d) { d.growth = nan; });
    desc([](CascadeDesc& d) { d.growth = 0.5; });
    desc([](CascadeDesc& d) { d.growth = 1e30; });
    desc([](CascadeDesc& d) { d.marginCells = -1; });
    desc([](CascadeDesc& d) { d.marginCells = 1 << 30; });
    camera([&](CameraView& v) { v.position.x = nan; });
    camera([&](CameraView& v) { v.position.y = inf; });
    camera([](CameraView& v) { v.position.z = 1e300; });
    camera([](CameraView& v) { v.forward = glm::dvec3(0.0); });
    camera([&](CameraView& v) { v.forward.x = nan; });
    camera([&](CameraView& v) { v.yfov = nan; });
    camera([](CameraView& v) { v.yfov = 4.0; });
    camera([&](CameraView& v) { v.aspect = inf; });
    camera([](CameraView& v) { v.aspect = -1.0; });
    light([](MovingLightingSettings& s) { s.blendCells = -1.0f; });
    light([](MovingLightingSettings& s) { s.blendCells = HUGE_VALF; });
    light([](MovingLightingSettings& s) { s.chunks = 0; });
    light([](MovingLightingSettings& s) { s.linesPerCell = 0; });
    light([](MovingLightingSettings& s) { s.slotsPerCell = std::nanf(""); });
    light([](MovingLightingSettings& s) { s.slotsPerCell = HUGE_VALF; });
    light([](MovingLightingSettings& s) { s.originOffset = std::nanf(""); });
    light([](MovingLightingSettings& s) { s.originOffset = -1.0f; });
    light([](MovingLightingSettings& s) { s.anchor.x = std::nan(""); });
    light([](MovingLightingSettings& s) { s.merge.timestep = std::nanf(""); });
    light([](MovingLightingSettings& s) { s.merge.timestep = 0.0f; });
    light([](MovingLightingSettings& s) { s.merge.timestep = HUGE_VALF; });
    light([](MovingLightingSettings& s) { s.merge.movingTime = 0.0f; });
    light([](MovingLightingSettings& s) { s.merge.stillTime = std::nanf(""); });
    light([](MovingLightingSettings& s) { s.guessFrames = HUGE_VALF; });
    light([](MovingLightingSettings& s) { s.newCellDynamicity = 2.0f; });
    double unsaid = 0.0;
    for (const std::string& words : said) unsaid += words.empty();
    return {{"descriptions", double(said.size())}, {"that were not refused", unsaid, 0.0}};
}

}  // namespace

std::vector<StressCase> gridCases() {
    std::vector<StressCase> cases;
    for (double distance : {1e3, 1e6, 1e7, 1e9}) {
        char name[64];
        std::snprintf(name, sizeof name, "cascades %g m from the origin", distance);
        cases.push_back({"grid", name, "the camera is inside, and cells stay on their lattice", [distance](const StressSettings& s) { return farFromOrigin(distance, s); }});
    }
    cases.push_back({"grid", "jumps of 1 to 1e12 cells in a frame", "each new cell is asked for once", jumps});
    cases.push_back({"grid", "descriptions that cannot work", "each is refused in words", badDescriptions});
    return cases;
}

}  // namespace clv
