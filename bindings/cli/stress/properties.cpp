// Symmetries and sums that light in a grid must keep, whatever the rays.
#include <algorithm>
#include <array>
#include <cmath>

#include "bindings/cli/stress/stress_case.h"
#include "bindings/cli/stress/walk_rays.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/inject.h"
#include "clv/cpu/partial_volume.h"

namespace clv {
namespace {

constexpr double kFloatStep = 0x1p-23;

// Sides are powers of two and the corner is a whole number of them, so that grids can be turned and moved without rounding.
ClvVolume exactGrid() {
    ClvVolume volume{};
    volume.origin = vec3(-2.0f, 1.0f, -4.0f), volume.cellSize = 0.25f, volume.resolution = ivec3(12, 9, 15), volume.storage = kClvStorageCube9;
    return volume;
}
Level openLevel(const ClvVolume& volume) { return buildLevel(volume, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false}); }

// Rays inside the grid and from around it, on a lattice that is fine but exact.
std::vector<ClvRay> raysIn(const ClvVolume& volume, std::uint32_t seed, int count) {
    Random random(seed);
    std::vector<ClvRay> rays;
    for (int k = 0; k < count; ++k) {
        ClvRay ray = rayOfKind(k % 2 == 0 ? RayKind::kAnywhere : RayKind::kFromOutside, random, volume);
        ray.origin = floor(ray.origin * 4096.0f) / 4096.0f;
        ray.flux = vec3(0.5f + random.unit(), 0.5f + random.unit(), 0.5f + random.unit());
        rays.push_back(ray);
    }
    return rays;
}

struct Deposited {
    Level level;
    PartialVolume sums;

    Deposited(const ClvVolume& volume, std::span<const ClvRay> rays) : Deposited(openLevel(volume), rays) {}
    Deposited(Level made, std::span<const ClvRay> rays) : level(std::move(made)) {
        const DepositLayout layout;
        sums.resize(level.slots.size(), layout, false);
        inject(level, layout, kClvInjectTrackLength, rays, sums.target());
    }
    std::span<const float> record(const ivec3& cell) const {
        const std::size_t stride = std::size_t(DepositLayout().stride());
        return std::span<const float>(sums.deposits).subspan(level.table[clvCellIndex(level.volume, cell)] * stride, stride);
    }
    vec3 irradiance(const ClvReceiver& receiver) const {
        SlotWeights weights;
        lookupWeights(level, receiver, {}, weights);
        return readIrradiance(DepositLayout(), sums.deposits, weights, DepositLayout().read(receiver.normal));
    }
};

// One of the 48 maps of the axes onto themselves: axis i of the image is axis from[i], with this sign.
struct AxisMap {
    ivec3 from;
    vec3 sign;
    vec3 operator()(const vec3& v) const { return sign * vec3(v[from.x], v[from.y], v[from.z]); }
    ClvVolume operator()(const ClvVolume& v) const {
        ClvVolume image = v;
        for (int i = 0; i < 3; ++i) {
            image.resolution[i] = v.resolution[from[i]];
            image.origin[i] = sign[i] > 0.0f ? v.origin[from[i]] : -(v.origin[from[i]] + v.cellSize * float(v.resolution[from[i]]));
        }
        return image;
    }
};
std::vector<AxisMap> axisMaps() {
    std::vector<AxisMap> maps;
    for (const ivec3& from : {ivec3(0, 1, 2), ivec3(1, 2, 0), ivec3(2, 0, 1), ivec3(0, 2, 1), ivec3(2, 1, 0), ivec3(1, 0, 2)}) {
        for (int signs = 0; signs < 8; ++signs) maps.push_back({from, vec3(signs & 1 ? -1.0f : 1.0f, signs & 2 ? -1.0f : 1.0f, signs & 4 ? -1.0f : 1.0f)});
    }
    return maps;
}

std::vector<ClvReceiver> receiversIn(const ClvVolume& volume, std::uint32_t seed) {
    Random random(seed);
    std::vector<ClvReceiver> receivers;
    for (int k = 0; k < 300; ++k) receivers.push_back({floor(placeAround(random, volume, 0.0f) * 4096.0f) / 4096.0f, 0.0f, anyDirection(random), 0.0f});
    return receivers;
}

// How far two lists of irradiance differ, over the largest of the first.
double difference(std::span<const vec3> a, std::span<const vec3> b) {
    double worst = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        for (int c = 0; c < 3; ++c) worst = largerOf(worst, std::abs(double(a[k][c]) - double(b[k][c]))), largest = largerOf(largest, double(a[k][c]));
    }
    return worst / largest;
}

std::vector<vec3> irradianceAt(const Deposited& light, std::span<const ClvReceiver> receivers) {
    std::vector<vec3> all;
    for (const ClvReceiver& receiver : receivers) all.push_back(light.irradiance(receiver));
    return all;
}

std::vector<StressFigure> symmetry(const StressSettings& settings) {
    const ClvVolume volume = exactGrid();
    const std::vector<ClvRay> rays = raysIn(volume, settings.seed, 20000);
    const std::vector<ClvReceiver> receivers = receiversIn(volume, settings.seed + 1u);
    const std::vector<vec3> expected = irradianceAt(Deposited(volume, rays), receivers);
    double worst = 0.0;
    for (const AxisMap& map : axisMaps()) {
        std::vector<ClvRay> turned = rays;
        for (ClvRay& ray : turned) ray.origin = map(ray.origin), ray.direction = map(ray.direction);
        std::vector<ClvReceiver> images = receivers;
        for (ClvReceiver& receiver : images) receiver.position = map(receiver.position), receiver.normal = map(receiver.normal);
        worst = largerOf(worst, difference(expected, irradianceAt(Deposited(map(volume), turned), images)));
    }
    return {{"maps of the axes", double(axisMaps().size())}, {"difference, of the largest irradiance", worst, 1e-5}};
}

// A room with a block in it, whose faces cut cells.
struct Boxes {
    struct Box {
        vec3 lo, hi;  // m
        bool room;    // its faces show inwards
    };
    std::vector<Box> all = {{vec3(-1.83f, 1.19f, -3.71f), vec3(0.87f, 3.07f, -0.41f), true}, {vec3(-0.66f, 1.07f, -2.57f), vec3(0.12f, 2.03f, -1.62f), false}};

    bool isOpen(const vec3& p) const {
        return std::ranges::all_of(all, [&](const Box& box) { return (glm::all(glm::greaterThan(p, box.lo)) && glm::all(glm::lessThan(p, box.hi))) == box.room; });
    }
    Boxes mapped(const AxisMap& map) const {
        Boxes image = *this;
        for (Box& box : image.all) {
            const vec3 a = map(box.lo), b = map(box.hi);
            box.lo = min(a, b), box.hi = max(a, b);
        }
        return image;
    }
    void lineHits(const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits) const {
        hits.clear();
        for (const Box& box : all) {
            float enter = -kClvFar, leave = kClvFar;
            vec3 enterNormal(0.0f), leaveNormal(0.0f);
            bool missed = false;
            for (int axis = 0; axis < 3; ++axis) {
                const float d = direction[axis], side = d > 0.0f ? 1.0f : -1.0f;
                if (d == 0.0f) {
                    missed = missed || origin[axis] < box.lo[axis] || origin[axis] > box.hi[axis];
                    continue;
                }
                const float in = ((d > 0.0f ? box.lo : box.hi)[axis] - origin[axis]) / d, out = ((d > 0.0f ? box.hi : box.lo)[axis] - origin[axis]) / d;
                vec3 normal(0.0f);
                normal[axis] = side;
                if (in > enter) enter = in, enterNormal = -normal;
                if (out < leave) leave = out, leaveNormal = normal;
            }
            if (missed || enter > leave) continue;
            const float outwards = box.room ? -1.0f : 1.0f;
            if (enter > 0.0f && enter < maxDistance) hits.push_back({enter, !box.room, enterNormal * outwards});
            if (leave > 0.0f && leave < maxDistance) hits.push_back({leave, box.room, leaveNormal * outwards});
        }
        std::ranges::sort(hits, {}, &LineHit::distance);
    }
    Level level(const ClvVolume& volume) const {
        SceneProbe probe;
        probe.lineHits = [this](const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits) { lineHits(origin, direction, maxDistance, hits); };
        probe.occluded = [this](const vec3& from, const vec3& to) {
            std::vector<LineHit> hits;
            lineHits(from, normalize(to - from), length(to - from), hits);
            return !hits.empty();
        };
        return buildLevel(volume, probe, {}, serialFor(), {.linesPerCell = 4});
    }
};

// The same with a room and a block in the grid: what is open of a cell is turned and mirrored with the rest. Lines that measure it do not lie
// alike on both sides, so that receivers near faces read a little else.
std::vector<StressFigure> symmetryOfCutCells(const StressSettings& settings) {
    const ClvVolume volume = exactGrid();
    const Boxes boxes;
    const std::vector<ClvRay> rays = raysIn(volume, settings.seed, 20000);
    std::vector<ClvReceiver> receivers = receiversIn(volume, settings.seed + 1u);
    std::erase_if(receivers, [&](const ClvReceiver& receiver) { return !boxes.isOpen(receiver.position); });
    const Deposited light(boxes.level(volume), rays);
    const std::vector<vec3> expected = irradianceAt(light, receivers);
    double worst = 0.0, mean = 0.0, rms = 0.0, slots = 0.0;
    for (const AxisMap& map : axisMaps()) {
        std::vector<ClvRay> turned = rays;
        for (ClvRay& ray : turned) ray.origin = map(ray.origin), ray.direction = map(ray.direction);
        std::vector<ClvReceiver> images = receivers;
        for (ClvReceiver& receiver : images) receiver.position = map(receiver.position), receiver.normal = map(receiver.normal);
        const Deposited image(boxes.mapped(map).level(map(volume)), turned);
        slots += image.level.slots.size() != light.level.slots.size();
        const std::vector<vec3> turnedLight = irradianceAt(image, images);
        worst = largerOf(worst, difference(expected, turnedLight));
        double before = 0.0, after = 0.0, squares = 0.0;
        for (std::size_t k = 0; k < expected.size(); ++k) {
            before += double(expected[k].x), after += double(turnedLight[k].x);
            squares += std::pow(double(turnedLight[k].x) - double(expected[k].x), 2.0);
        }
        mean = largerOf(mean, std::abs(after / before - 1.0));
        rms = largerOf(rms, std::sqrt(squares * double(expected.size())) / before);
    }
    return {{"receivers in the open", double(receivers.size())},
            {"slots", double(light.level.slots.size())},
            {"maps with another number of slots", slots, 0.0},
            {"difference of the mean irradiance, %", 100.0 * mean, 0.5},
            {"difference, root mean square, % of the mean", 100.0 * rms, 4.0},
            {"difference at a receiver, % of the largest irradiance", 100.0 * worst, 25.0}};
}

// Moved by whole cells, with its storage scrolled: the same light, to the bit.
std::vector<StressFigure> translation(const StressSettings& settings) {
    const ClvVolume volume = exactGrid();
    const std::vector<ClvRay> rays = raysIn(volume, settings.seed, 20000);
    const Deposited here(volume, rays);
    double differing = 0.0;
    for (const ivec3& cells : {ivec3(1, 0, 0), ivec3(0, -7, 3), ivec3(100, 64, -200)}) {
        ClvVolume moved = volume;
        moved.origin += volume.cellSize * vec3(cells);
        for (int axis = 0; axis < 3; ++axis) moved.scroll[axis] = ((cells[axis] % volume.resolution[axis]) + volume.resolution[axis]) % volume.resolution[axis];
        std::vector<ClvRay> shifted = rays;
        for (ClvRay& ray : shifted) ray.origin += volume.cellSize * vec3(cells);
        const Deposited there(moved, shifted);
        for (std::size_t i = 0; i < here.level.cellCount(); ++i) {
            const ivec3 cell = clvCellFromIndex(volume, uint(i));
            differing += !std::ranges::equal(here.record(cell), there.record(cell));
        }
    }
    return {{"cells that differ", differing, 0.0}};
}

// Light of two sets of rays is the sum of the light of each, and of a ray m times as bright m times as much.
std::vector<StressFigure> superposition(const StressSettings& settings) {
    const ClvVolume volume = exactGrid();
    const std::vector<ClvRay> first = raysIn(volume, settings.seed, 5000), second = raysIn(volume, settings.seed + 1u, 5000);
    std::vector<ClvRay> both = first;
    for (ClvRay ray : second) ray.flux *= 3.0f, both.push_back(ray);
    const Deposited a(volume, first), b(volume, second), sum(volume, both);
    double worst = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < sum.sums.deposits.size(); ++k) {
        const double expected = double(a.sums.deposits[k]) + 3.0 * double(b.sums.deposits[k]);
        worst = largerOf(worst, std::abs(double(sum.sums.deposits[k]) - expected)), largest = largerOf(largest, std::abs(expected));
    }
    return {{"difference, of the largest deposit", worst / largest, 8.0 * kFloatStep}};
}

// The sides hold flux times length times the sum of the direction's components, over all cells what the rays carry through the grid.
std::vector<StressFigure> energy(const StressSettings& settings) {
    const ClvVolume volume = exactGrid();
    const std::vector<ClvRay> rays = raysIn(volume, settings.seed, 20000);
    double expected = 0.0;
    for (const ClvRay& ray : rays) {
        const glm::dvec3 d(ray.direction), from = (glm::dvec3(volume.origin) - glm::dvec3(ray.origin)) / d, to = from + glm::dvec3(volume.resolution) * double(volume.cellSize) / d;
        double begin = 0.0, end = ray.maxDistance;
        for (int axis = 0; axis < 3; ++axis) begin = std::max(begin, std::min(from[axis], to[axis])), end = std::min(end, std::max(from[axis], to[axis]));
        expected += std::max(0.0, end - begin) * (std::abs(d.x) + std::abs(d.y) + std::abs(d.z)) * (double(ray.flux.x) + double(ray.flux.y) + double(ray.flux.z));
    }
    const Deposited light(volume, rays);
    double sum = 0.0;
    for (std::size_t i = 0; i < light.level.cellCount(); ++i) {
        const std::span<const float> record = light.record(clvCellFromIndex(volume, uint(i)));
        for (std::size_t k = 0; k < 3 * kSides; ++k) sum += double(record[k]);
    }
    return {{"energy lost or made, of all", std::abs(sum / expected - 1.0), 2e-8}};
}

// Four times the rays: half the error, or nearly, against the mean of many more.
std::vector<StressFigure> convergence(const StressSettings& settings) {
    const ClvVolume volume = exactGrid();
    const std::vector<ClvReceiver> receivers = receiversIn(volume, settings.seed + 1u);
    const auto estimate = [&](std::uint32_t seed, int count) {
        std::vector<vec3> all = irradianceAt(Deposited(volume, raysIn(volume, seed, count)), receivers);
        for (vec3& e : all) e = e / float(count);
        return all;
    };
    const std::vector<vec3> truth = estimate(settings.seed + 1000u, 1 << 20);
    std::vector<StressFigure> figures;
    double before = 0.0;
    for (int count = 1 << 10; count <= 1 << 16; count *= 4) {
        double squares = 0.0, sum = 0.0;
        constexpr int kRuns = 4;
        for (std::uint32_t run = 0; run < kRuns; ++run) {
            const std::vector<vec3> e = estimate(settings.seed + 2000u + run, count);
            for (std::size_t k = 0; k < e.size(); ++k) squares += double(dot(e[k] - truth[k], e[k] - truth[k])) / kRuns, sum += double(dot(truth[k], truth[k])) / kRuns;
        }
        const double error = std::sqrt(squares / sum);
        if (before > 0.0) figures.push_back({"error over that of a quarter of the rays, " + std::to_string(count) + " rays", error / before, 0.65});
        before = error;
    }
    return figures;
}

}  // namespace

std::vector<StressCase> propertyCases() {
    return {{"properties", "the 48 maps of the axes onto themselves", "grid, rays and receivers turned or mirrored give the same light", symmetry},
            {"properties", "the 48 maps of the axes, with a room and a block in the grid", "what is open of cut cells is turned and mirrored with the rest", symmetryOfCutCells},
            {"properties", "a grid moved by whole cells", "it holds the same light, to the bit, wherever its cells are stored", translation},
            {"properties", "two sets of rays, one three times as bright", "their light adds up", superposition},
            {"properties", "energy in the grid", "the cells hold what the rays carry through them", energy},
            {"properties", "four times the rays", "the error falls as their square root, or nearly", convergence}};
}

}  // namespace clv
