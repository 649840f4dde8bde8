// The walk of a ray through a grid: it conserves length, visits no cell twice and ends, whatever the ray.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "bindings/cli/stress/stress_case.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/inject.h"
#include "clv/cpu/partial_volume.h"
#include "clv/math/hash.h"

namespace clv {
namespace {

// Numbers drawn one after the other.
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(clvHash(seed + 0x51ed270bu)) {}
    uint bits() { return state_ = clvHash(state_ + 0x9e3779b9u); }
    float unit() { return clvUnitFloat(bits()); }
    float signedUnit() { return 2.0f * unit() - 1.0f; }
    int below(int n) { return int(unit() * float(n)); }

private:
    uint state_;
};

// Kinds of rays that a walk may stumble over.
enum class Kind { kAnywhere, kAlongAxis, kAlongEdge, kThroughCorners, kFromBoundary, kToBoundary, kFromOutside, kPastTheGrid, kTinyComponents, kShort, kEndless, kCount };

vec3 somewhere(Random& random, const ClvVolume& v, float margin) {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = v.origin[axis] + v.cellSize * (float(v.resolution[axis]) * (random.unit() * (1.0f + 2.0f * margin) - margin));
    return p;
}
// A corner of the grid's cells.
vec3 corner(Random& random, const ClvVolume& v) {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = v.origin[axis] + v.cellSize * float(random.below(v.resolution[axis] + 1));
    return p;
}
vec3 direction(Random& random) {
    for (;;) {
        const vec3 d(random.signedUnit(), random.signedUnit(), random.signedUnit());
        if (dot(d, d) > 1e-4f) return glm::normalize(d);
    }
}
vec3 axisDirection(Random& random) {
    vec3 d(0.0f);
    d[random.below(3)] = random.unit() < 0.5f ? -1.0f : 1.0f;
    return d;
}

ClvRay makeRay(Kind kind, Random& random, const ClvVolume& v) {
    ClvRay ray{};
    const float size = v.cellSize * float(std::max({v.resolution.x, v.resolution.y, v.resolution.z}));
    ray.flux = vec3(1.0f);
    ray.origin = somewhere(random, v, 0.0f);
    ray.direction = direction(random);
    ray.maxDistance = size * 2.0f * random.unit();
    switch (kind) {
        case Kind::kAlongAxis: ray.direction = axisDirection(random); break;
        case Kind::kAlongEdge: ray.origin = corner(random, v), ray.direction = axisDirection(random); break;
        case Kind::kThroughCorners: {
            ray.origin = corner(random, v);
            vec3 d(float(random.below(7) - 3), float(random.below(7) - 3), float(random.below(7) - 3));
            if (dot(d, d) == 0.0f) d.x = 1.0f;
            ray.direction = glm::normalize(d);
            break;
        }
        case Kind::kFromBoundary: {
            const int axis = random.below(3);
            ray.origin[axis] = corner(random, v)[axis];
            break;
        }
        case Kind::kToBoundary: {
            const int axis = random.below(3);
            vec3 end = somewhere(random, v, 0.0f);
            end[axis] = corner(random, v)[axis];
            const float length = glm::length(end - ray.origin);
            if (length > 0.0f) ray.direction = (end - ray.origin) / length, ray.maxDistance = length;
            break;
        }
        case Kind::kFromOutside: ray.origin = somewhere(random, v, 4.0f), ray.maxDistance = 20.0f * size; break;
        case Kind::kPastTheGrid: {
            const int axis = random.below(3);
            ray.origin[axis] = v.origin[axis] - size * (0.001f + random.unit());
            ray.direction[axis] = -std::abs(ray.direction[axis]);
            break;
        }
        case Kind::kTinyComponents: {
            const float tiny[] = {0.0f, -0.0f, 1e-45f, -1e-42f, 1e-38f, -1e-30f, 1e-21f, -1e-19f, 1e-12f, -1e-8f};
            ray.direction = axisDirection(random);
            for (int axis = 0; axis < 3; ++axis) {
                if (ray.direction[axis] == 0.0f) ray.direction[axis] = tiny[random.below(10)];
            }
            if (random.unit() < 0.5f) ray.origin = corner(random, v);
            break;
        }
        case Kind::kShort: {
            const float lengths[] = {0.0f, 1e-45f, 1e-38f, 1e-30f, 1e-20f, 1e-7f, 1e-5f};
            ray.maxDistance = lengths[random.below(7)] * (random.unit() < 0.5f ? 1.0f : v.cellSize);
            if (random.unit() < 0.5f) ray.origin = corner(random, v);
            break;
        }
        case Kind::kEndless: ray.maxDistance = random.unit() < 0.5f ? 1e30f : kClvFar; break;
        default: break;
    }
    return ray;
}

// Length of a ray inside the grid, in cells, in double precision: inside a grid that is smaller, or larger, by the rounding of float
// coordinates. A ray that runs in a face of the grid may count as inside or as outside.
struct Clipped {
    double least = 0.0, most = 0.0;
    double unit = 0.0;  // the last place of the largest coordinate or distance
};
Clipped clip(const ClvVolume& v, const ClvRay& ray) {
    const double scale = 1.0 / double(v.cellSize), reach = double(ray.maxDistance) * scale;
    double farthest = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        farthest = std::max({farthest, double(v.resolution[axis]), (std::abs(double(ray.origin[axis])) + std::abs(double(v.origin[axis]))) * scale});
    }
    const double rounding = 2.0 * 0x1p-23 * farthest;
    Clipped clipped;
    const auto lengthIn = [&](double margin) {
        double begin = 0.0, end = reach;
        for (int axis = 0; axis < 3; ++axis) {
            const double origin = (double(ray.origin[axis]) - double(v.origin[axis])) * scale, d = ray.direction[axis];
            const double lo = -margin, hi = v.resolution[axis] + margin;
            if (std::abs(d) <= double(kClvParallel)) {
                if (origin < lo || origin > hi) return 0.0;
                continue;
            }
            begin = std::max(begin, std::min((lo - origin) / d, (hi - origin) / d));
            end = std::min(end, std::max((lo - origin) / d, (hi - origin) / d));
        }
        if (end > begin) clipped.unit = std::max(clipped.unit, 0x1p-23 * end);
        return std::max(0.0, end - begin);
    };
    clipped.unit = 0x1p-23 * farthest;
    clipped.least = lengthIn(-rounding);
    clipped.most = lengthIn(rounding);
    return clipped;
}
// How far a length lies outside of [least, most].
double excess(const Clipped& clipped, double length) { return std::max({0.0, clipped.least - length, length - clipped.most}); }

struct WalkErrors {
    double length = 0.0;       // of the sum of pieces, in units of clip() a cell
    double revisits = 0.0, outside = 0.0, endless = 0.0, negative = 0.0;
    void take(const WalkErrors& o) {
        length = std::max(length, o.length);
        revisits += o.revisits, outside += o.outside, endless += o.endless, negative += o.negative;
    }
};

WalkErrors walkOne(const ClvVolume& v, const ClvRay& ray) {
    WalkErrors errors;
    const Clipped clipped = clip(v, ray);
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
        // Each step goes to a neighbour, forwards along one axis, so no cell comes twice.
        if (cells > 0) {
            const ivec3 step = crossing.cell - last;
            int moved = 0, back = 0;
            for (int axis = 0; axis < 3; ++axis) moved += std::abs(step[axis]), back += float(step[axis]) * ray.direction[axis] < 0.0f;
            errors.revisits += moved != 1 || back != 0;
        }
        last = crossing.cell;
        ++cells;
    }
    errors.endless += walk.running != 0;
    errors.length = excess(clipped, sum) / (clipped.unit * std::max(cells, 1));
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
        for (std::size_t k = 0; k < kPiece; ++k) mine.take(walkOne(volume, makeRay(Kind(int(k % std::size_t(Kind::kCount))), random, volume)));
        const std::lock_guard lock(mutex);
        all.take(mine);
    });
    return {{"rays", double(pieces * kPiece)},
            {"length, last places a cell", all.length, 4.0},
            {"steps to other than the next cell", all.revisits, 0.0},
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
        ClvRay rays[16];
        Clipped expected;
        for (int i = 0; i < 16; ++i) {
            rays[i] = makeRay(Kind((round + i) % int(Kind::kCount)), random, volume);
            // The sides add up to the sum of the components.
            const vec3 d = abs(rays[i].direction);
            const Clipped clipped = clip(volume, rays[i]);
            const double perCell = double(volume.cellSize) * double(d.x + d.y + d.z);
            expected.least += clipped.least * perCell, expected.most += clipped.most * perCell;
            expected.unit += clipped.unit * perCell * 75.0;  // cells that a ray crosses at most
        }
        partial.clear();
        inject(level, layout, kClvInjectTrackLength, rays, partial.target());
        double sum = 0.0;
        for (float value : partial.target().deposits) sum += value, notFinite += !std::isfinite(value);
        worst = std::max(worst, excess(expected, sum) / expected.unit);
    }
    return {{"packets of 16 rays", double(rounds)}, {"deposited length, last places a cell", worst, 4.0}, {"deposits that are not finite", notFinite, 0.0}};
}

}  // namespace

std::vector<StressCase> walkCases() {
    const std::string claim = "pieces add up to the clipped length within 4 last places a cell, and no cell comes twice";
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
