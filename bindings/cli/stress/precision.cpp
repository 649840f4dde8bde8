// The stages beside the same formulas in double precision, on random input: how many last places of a float they lose.
#include <algorithm>
#include <array>
#include <cmath>

#include "bindings/cli/stress/stress_case.h"
#include "bindings/cli/stress/walk_rays.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/inject.h"
#include "clv/cpu/partial_volume.h"
#include "clv/stages/merge.h"

namespace clv {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double kLastPlace = 0x1p-23;

// Coefficients of the ambient cube with its terms of second order, and how they are read.
std::array<double, 9> depositOf(const dvec3& d) {
    return {std::max(-d.x, 0.0), std::max(d.x, 0.0), std::max(-d.y, 0.0), std::max(d.y, 0.0), std::max(-d.z, 0.0), std::max(d.z, 0.0), d.x * d.y, d.y * d.z, d.x * d.z};
}
std::array<double, 9> readOf(const dvec3& n) {
    std::array<double, 9> read{};
    for (int axis = 0; axis < 3; ++axis) read[std::size_t(2 * axis)] = 0.5 * (n[axis] * n[axis] + n[axis]), read[std::size_t(2 * axis + 1)] = 0.5 * (n[axis] * n[axis] - n[axis]);
    read[6] = 15.0 / 16.0 * n.x * n.y, read[7] = 15.0 / 16.0 * n.y * n.z, read[8] = 15.0 / 16.0 * n.x * n.z;
    return read;
}

struct Piece {
    double length = 0.0;       // m
    double sensitivity = 0.0;  // m that its ends move by, over the relative change of the coordinates that they follow from
};

// What of a ray lies inside a box. A ray that grazes a face crosses it at a distance that follows from few digits.
Piece pieceIn(const ClvRay& ray, const dvec3& lo, const dvec3& hi) {
    struct End {
        double distance, sensitivity;
    } begin{0.0, 0.0}, end{ray.maxDistance, 0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const double from = ray.origin[axis], direction = ray.direction[axis];
        auto at = [&](double plane) { return End{(plane - from) / direction, (std::abs(plane) + std::abs(from)) / std::abs(direction)}; };
        const End first = at(direction > 0.0 ? lo[axis] : hi[axis]), last = at(direction > 0.0 ? hi[axis] : lo[axis]);
        if (first.distance > begin.distance) begin = first;
        if (last.distance < end.distance) end = last;
    }
    return {std::max(0.0, end.distance - begin.distance), begin.sensitivity + end.sensitivity};
}

ClvVolume smallGrid() {
    ClvVolume volume{};
    volume.origin = vec3(-1.3f, 0.7f, 2.1f), volume.cellSize = 0.37f, volume.resolution = ivec3(6, 5, 7), volume.storage = kClvStorageCube9;
    return volume;
}

// Every ray against every cell, so that nothing is shared with the walk.
std::vector<StressFigure> injectBeside(const StressSettings& settings) {
    const ClvVolume volume = smallGrid();
    const Level level = buildLevel(volume, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
    const DepositLayout layout;
    Random random(settings.seed);
    std::vector<ClvRay> rays;
    for (int k = 0; k < 20000; ++k) {
        ClvRay ray = rayOfKind(k % 2 == 0 ? RayKind::kAnywhere : RayKind::kFromOutside, random, volume);
        ray.flux = vec3(random.unit(), random.unit(), random.unit());
        rays.push_back(ray);
    }
    PartialVolume partial;
    partial.resize(level.slots.size(), layout, false);
    inject(level, layout, kClvInjectTrackLength, rays, partial.target());

    double worst = 0.0, most = 0.0;
    for (std::size_t i = 0; i < level.cellCount(); ++i) {
        const dvec3 lo = dvec3(volume.origin) + double(volume.cellSize) * dvec3(clvCellFromIndex(volume, uint(i)));
        std::array<double, 27> sum{}, magnitude{};
        double crossings = 0.0;
        for (const ClvRay& ray : rays) {
            const Piece piece = pieceIn(ray, lo, lo + double(volume.cellSize));
            if (piece.length == 0.0) continue;
            ++crossings;
            const std::array<double, 9> f = depositOf(dvec3(ray.direction));
            for (std::size_t k = 0; k < 27; ++k) {
                const double perMetre = f[k / 3] * double(ray.flux[int(k % 3)]);
                sum[k] += perMetre * piece.length, magnitude[k] += std::abs(perMetre) * (piece.length + piece.sensitivity);
            }
        }
        most = std::max(most, crossings);
        const float* record = partial.deposits.data() + level.table[i] * std::size_t(layout.stride());
        for (std::size_t k = 0; k < 27; ++k) worst = largerOf(worst, std::abs(double(record[k]) - sum[k]) / (kLastPlace * magnitude[k]));
    }
    return {{"most rays in a cell", most}, {"sum of a cell, last places of what its pieces follow from", worst, 1.0}};
}

// Powers of ten in [10^least, 10^most].
double anyPower(Random& random, double least, double most) { return std::pow(10.0, least + (most - least) * double(random.unit())); }

std::vector<StressFigure> mergeBeside(const StressSettings& settings) {
    Random random(settings.seed);
    double step = 0.0, decayed = 0.0, alpha = 0.0;
    for (int k = 0; k < 200000; ++k) {
        const auto history = float(anyPower(random, -6, 6)), current = float(anyPower(random, -6, 6));
        const float weight = k % 2 == 0 ? random.unit() : float(anyPower(random, -7, 0));
        const double exact = double(history) + double(weight) * (double(current) - double(history));
        step = largerOf(step, std::abs(double(clvMergeStep(history, current, weight)) - exact) / (kLastPlace * std::max(double(history), double(current))));
        const auto timestep = float(anyPower(random, -4, 3)), rate = float(anyPower(random, -4, 2));
        const double share = -std::expm1(-double(timestep) * double(rate));
        decayed = largerOf(decayed, std::abs(double(clvDecayed(timestep, rate)) - share) / (kLastPlace * share));
        ClvMergeSettings merge{timestep, float(anyPower(random, 0, 3)), float(anyPower(random, -3, 0)), 1.0f};
        const float dynamicity = random.unit();
        const double still = 1.0 / double(merge.stillTime), mixed = still + (1.0 / double(merge.movingTime) - still) * double(dynamicity);
        const double expected = -std::expm1(-double(timestep) * mixed);
        alpha = largerOf(alpha, std::abs(double(clvMergeAlpha(merge, dynamicity)) - expected) / (kLastPlace * expected));
    }
    return {{"a step, last places of the larger value", step, 2.0}, {"a decay, last places", decayed, 8.0}, {"a weight, last places", alpha, 8.0}};
}

struct ExactWeights {
    std::vector<double> weight;  // of each slot that is read, 1/m^3
    double magnitude = 0.0;      // of their sum without signs
};

// The local linear fit around a receiver, from the weights of interpolation on.
ExactWeights exactWeights(const Level& level, const ClvReceiver& receiver, const SlotWeights& read) {
    const double h = level.volume.cellSize;
    // Interpolation is centred half a cell in front of the surface.
    const dvec3 centre = dvec3(receiver.position) + dvec3(receiver.normal) * (0.5 * h);
    std::vector<double> spline;
    std::vector<dvec3> x;
    double sum = 0.0;
    dvec3 mean(0.0);
    for (int i = 0; i < read.count; ++i) {
        const ClvSlot& slot = level.slots[read.slot[std::size_t(i)]];
        const dvec3 middle = dvec3(level.volume.origin) + h * (dvec3(clvCellFromIndex(level.volume, slot.cell)) + 0.5);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = std::abs(middle[axis] - centre[axis]) / h;
            weight *= d < 0.5 ? 0.75 - d * d : 0.5 * std::pow(std::max(0.0, 1.5 - d), 2.0);
        }
        spline.push_back(weight);
        x.push_back((dvec3(slot.openCentroid) - dvec3(receiver.position)) / h);
        sum += weight * double(slot.openVolume);
        mean += weight * double(slot.openVolume) * x.back();
    }
    mean /= sum;
    dmat3 covariance(0.0);
    for (std::size_t i = 0; i < x.size(); ++i) covariance += spline[i] * double(level.slots[read.slot[i]].openVolume) / sum * glm::outerProduct(x[i] - mean, x[i] - mean);
    const dvec3 slope = glm::inverse(covariance + dmat3(double(kClvFitRidge))) * mean;
    ExactWeights exact;
    for (std::size_t i = 0; i < x.size(); ++i) {
        exact.weight.push_back(spline[i] / sum * (1.0 - glm::dot(x[i] - mean, slope)));
        exact.magnitude += std::abs(exact.weight.back());
    }
    return exact;
}

std::vector<StressFigure> evaluateBeside(const StressSettings& settings) {
    Level level = buildLevel(smallGrid(), {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
    Random random(settings.seed);
    const float h = level.volume.cellSize;
    // Cells that are cut: open volumes and centroids of all kinds.
    for (ClvSlot& slot : level.slots) {
        slot.openVolume *= 0.05f + 0.95f * random.unit();
        slot.openCentroid += 0.3f * h * vec3(random.signedUnit(), random.signedUnit(), random.signedUnit());
    }
    const DepositLayout layout;
    std::vector<float> deposits(level.slots.size() * std::size_t(layout.stride()));
    for (float& value : deposits) value = random.unit();

    double weights = 0.0, light = 0.0;
    SlotWeights read;
    for (int k = 0; k < 20000; ++k) {
        const ClvReceiver receiver{placeAround(random, level.volume, -0.2f), 0.0f, anyDirection(random), 0.0f};
        lookupWeights(level, receiver, {}, read);
        const ExactWeights exact = exactWeights(level, receiver, read);
        for (std::size_t i = 0; i < exact.weight.size(); ++i) weights = largerOf(weights, std::abs(double(read.weight[i]) - exact.weight[i]) / (kLastPlace * exact.magnitude));
        const std::array<double, 9> r = readOf(dvec3(receiver.normal));
        double sum = 0.0, magnitude = 0.0;
        for (std::size_t i = 0; i < exact.weight.size(); ++i) {
            for (std::size_t c = 0; c < 9; ++c) {
                const double term = exact.weight[i] * r[c] * double(deposits[read.slot[i] * std::size_t(layout.stride()) + 3 * c]);
                sum += term, magnitude += std::abs(term);
            }
        }
        const vec3 e = readIrradiance(layout, deposits, read, layout.read(receiver.normal));
        light = largerOf(light, std::abs(double(e.x) - std::max(sum, 0.0)) / (kLastPlace * magnitude));
    }
    return {{"weights, last places of their sum", weights, 64.0}, {"irradiance, last places of the terms' sum", light, 64.0}};
}

}  // namespace

std::vector<StressCase> precisionCases() {
    return {{"precision", "inject beside double precision", "a cell's sum is off by less than a last place of the coordinates that its pieces follow from", injectBeside},
            {"precision", "merge beside double precision", "a step is right within 2 last places, a weight within 8", mergeBeside},
            {"precision", "evaluate beside double precision", "weights and irradiance are right within 64 last places of what they are sums of", evaluateBeside}};
}

}  // namespace clv
