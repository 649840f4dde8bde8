// The walk of a ray through a grid: it conserves length, visits no cell twice and ends, whatever the ray.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "bindings/cli/stress/clipped_length.h"
#include "bindings/cli/stress/stress_case.h"
#include "bindings/cli/stress/walk_rays.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/inject.h"
#include "clv/cpu/partial_volume.h"

namespace clv {
namespace {

struct WalkErrors {
    double length = 0.0;       // of the sum of pieces, in last places
    double displaced = 0.0;    // how far a piece lies outside of its cell, in last places
    double steps = 0.0, outside = 0.0, endless = 0.0, negative = 0.0;
    void take(const WalkErrors& o) {
        length = largerOf(length, o.length), displaced = largerOf(displaced, o.displaced);
        steps += o.steps, outside += o.outside, endless += o.endless, negative += o.negative;
    }
};

WalkErrors walkOne(const ClvVolume& v, const ClvRay& ray) {
    WalkErrors errors;
    const ExactRay exact = exactRay(v, ray);
    const int most = v.resolution.x + v.resolution.y + v.resolution.z;
    double sum = 0.0;
    int cells = 0;
    ivec3 last(0);
    ClvWalk walk = clvWalkBegin(v, ray);
    while (walk.running != 0 && cells <= most) {
        const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        const double piece = double(crossing.tEnd) - double(crossing.tBegin);
        sum += piece;
        errors.negative += !(piece >= 0.0);
        errors.outside += clvCellInside(v, crossing.cell) == 0;
        for (float t : {crossing.tBegin, crossing.tEnd}) errors.displaced = largerOf(errors.displaced, cellsOutside(exact, crossing.cell, t) / exact.place);
        // Each step goes to a neighbour, forwards along one axis, so no cell comes twice.
        if (cells > 0) {
            const ivec3 step = crossing.cell - last;
            int moved = 0, back = 0;
            for (int axis = 0; axis < 3; ++axis) moved += std::abs(step[axis]), back += float(step[axis]) * ray.direction[axis] < 0.0f;
            errors.steps += moved != 1 || back != 0;
        }
        last = crossing.cell;
        ++cells;
    }
    errors.endless += walk.running != 0;
    const ClippedLength clipped = clippedLength(v, exact);
    errors.length = clipped.excess(sum) / clipped.place;
    return errors;
}

std::vector<StressFigure> walks(const ClvVolume& volume, const StressSettings& settings, std::size_t rays) {
    constexpr std::size_t kPiece = 16384;
    const std::size_t pieces = (rays + kPiece - 1) / kPiece;
    WalkErrors all;
    std::mutex mutex;
    settings.parallelFor(pieces, [&](std::size_t piece) {
        Random random(clvHashCombine(settings.seed, uint(piece)));
        WalkErrors mine;
        for (std::size_t k = 0; k < kPiece; ++k) mine.take(walkOne(volume, rayOfKind(RayKind(int(k % std::size_t(RayKind::kCount))), random, volume)));
        const std::lock_guard lock(mutex);
        all.take(mine);
    });
    return {{"rays", double(pieces * kPiece)},
            {"length, last places", all.length, 4.0},
            {"pieces outside of their cells, last places", all.displaced, 4.0},
            {"steps to other than the next cell", all.steps, 0.0},
            {"crossings outside of the grid", all.outside, 0.0},
            {"pieces of negative length", all.negative, 0.0},
            {"walks that do not end", all.endless, 0.0}};
}

ClvVolume grid(const ivec3& resolution, float cellSize, const vec3& origin) {
    ClvVolume volume{};
    volume.origin = origin, volume.cellSize = cellSize, volume.resolution = resolution, volume.storage = kClvStorageCube;
    return volume;
}

// What 16 rays at once deposit into open cells is what one ray after the other is clipped to: no length is lost in the vector code.
std::vector<StressFigure> packets(const StressSettings& settings) {
    const ClvVolume volume = grid(ivec3(33, 17, 25), 0.37f, vec3(-3.1f, 0.7f, -9.2f));
    const Level level = buildLevel(volume, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
    DepositLayout layout;
    layout.storage = kClvStorageCube, layout.channels = 1;
    double worst = 0.0, notFinite = 0.0;
    Random random(settings.seed);
    PartialVolume partial;
    partial.resize(level.slots.size(), layout, false);
    const int rounds = settings.exhaustive ? 20000 : 200;
    for (int round = 0; round < rounds; ++round) {
        ClvRay rays[kPacketLanes];
        double least = 0.0, most = 0.0, place = 0.0;
        for (int i = 0; i < kPacketLanes; ++i) {
            rays[i] = rayOfKind(RayKind((round + i) % int(RayKind::kCount)), random, volume);
            // The sides add up to the sum of the components.
            const vec3 d = abs(rays[i].direction);
            const double perCell = double(volume.cellSize) * double(d.x + d.y + d.z);
            const ClippedLength clipped = clippedLength(volume, exactRay(volume, rays[i]));
            least += clipped.least * perCell, most += clipped.most * perCell, place += clipped.place * perCell;
        }
        partial.clear();
        inject(level, layout, kClvInjectTrackLength, rays, partial.target());
        double sum = 0.0;
        for (float value : partial.target().deposits) sum += value, notFinite += !clvIsFinite(value);
        worst = largerOf(worst, ClippedLength{least, most}.excess(sum) / place);
    }
    return {{"packets of 16 rays", double(rounds)}, {"deposited length, last places a ray", worst, 4.0}, {"deposits that are not finite", notFinite, 0.0}};
}

}  // namespace

std::vector<StressCase> walkCases() {
    const std::string claim = "pieces add up to the clipped length and lie in their cells, within 4 last places; no cell comes twice";
    struct Grid {
        const char* name;
        ClvVolume volume;
        std::size_t share;  // of the rays
    };
    const std::vector<Grid> grids = {{"32 x 32 x 32 cells", grid(ivec3(32), 0.5f, vec3(-8.0f)), 4},
                                     {"cells of 0.1 m, which no float is", grid(ivec3(61, 23, 40), 0.1f, vec3(0.3f, -1.7f, 2.9f)), 2},
                                     {"one cell", grid(ivec3(1), 1.0f, vec3(0.0f)), 8},
                                     {"1 x 1 x 500 cells", grid(ivec3(1, 1, 500), 0.25f, vec3(0.0f)), 8},
                                     {"1024 x 1 x 1 cells", grid(ivec3(1024, 1, 1), 0.25f, vec3(-128.0f, 0.0f, 0.0f)), 8},
                                     {"cells of 1 nm", grid(ivec3(16), 1e-9f, vec3(-8e-9f)), 8},
                                     {"cells of 100 km", grid(ivec3(16), 1e5f, vec3(-8e5f)), 8},
                                     {"an origin 1e7 m away", grid(ivec3(16), 4.0f, vec3(1e7f, -1e7f, 1e7f)), 8}};
    std::vector<StressCase> cases;
    for (const Grid& g : grids) {
        cases.push_back({"walk", g.name, claim, [g](const StressSettings& s) { return walks(g.volume, s, (s.exhaustive ? 100'000'000u : 1'000'000u) / g.share); }});
    }
    cases.push_back({"walk", "16 rays at once", "deposits hold the clipped length", packets});
    return cases;
}

}  // namespace clv
