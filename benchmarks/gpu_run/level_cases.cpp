#include "benchmarks/gpu_run/level_cases.h"

#include <glm/gtc/matrix_transform.hpp>

#include "benchmarks/gpu_run/cpu_scene.h"
#include "benchmarks/gpu_run/line_cells.h"
#include "clv/cpu/partial_volume.h"
#include "clv/plan/map_faces.h"
#include "clv/stages/deferred.h"

namespace clv {
namespace {

constexpr double kUnit = 0x1p-24;     // rounding of a float
// Devices may round a division to within 2.5 units in the last place, and sines and square roots to some more.
constexpr double kDeviceUnits = 16.0;

// Rays that are cut already, into the level and on to the receivers.
StoredCase injectCase(const CpuScene& cpu, const std::string& name, const DepositLayout& layout, std::uint32_t rule) {
    StoredCase stored{.name = name, .settings = cpu.settings(kFewRays), .steps = {"light", "evaluate"}};
    LightFrameSettings& settings = stored.settings;
    settings.storage = layout.storage, settings.channels = std::uint32_t(layout.channels), settings.rule = rule;
    cpu.addLevel(settings);
    const std::vector<ClvRay> rays = cpu.rays(kFewRays);
    stored.buffers = cpu.levelBuffers(settings);
    settings.turned = layout.frame != mat3(1.0f);
    ClvFrame constants = cpu.constants(settings);
    keepDirectionsAlong(layout.frame, constants);
    stored.buffers.push_back(buffer("frame", constants));
    stored.buffers.push_back(buffer("rays", rays));

    // Sums in double precision, and how far a device can be from them: its additions, the roundings of each term, and lengths rounded by
    // the distances that they are the difference of.
    const ClvVolume& volume = cpu.level.volume;
    const std::size_t stride = std::size_t(layout.stride()), count = cpu.level.slots.size() * stride;
    std::vector<double> sum(count), magnitude(count), terms(cpu.level.slots.size());
    const float largestFlux = float(cpu.sampler.totalFlux());
    for (const ClvRay& ray : rays) {
        const ClvRecord record = clvRecordOfRay(layout.storage, uint(layout.channels), ray, layout.frame * ray.direction, clvMostFlux(settings.rule, volume.cellSize));
        for (ClvWalk walk = clvWalkBegin(volume, ray); walk.running == 1;) {
            const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
            const float middle = 0.5f * (crossing.tBegin + crossing.tEnd) * volume.cellSize;
            const uint slot = slotAtPosition(cpu.level, cpu.level.table[clvCellIndex(volume, crossing.cell)], ray.origin + ray.direction * middle);
            if (slot == kClvNoSlot) continue;
            ++terms[slot];
            for (int k = 0; k < layout.values(); ++k) {
                const double value = double(clvRecordValue(record, uint(layout.channels), uint(k))) * clvCrossingWeight(rule, crossing, volume.cellSize);
                sum[slot * stride + std::size_t(k)] += value;
                magnitude[slot * stride + std::size_t(k)] += std::abs(value);
            }
        }
    }
    const double fixedUnit = 1.0 / clvFixedScale(largestFlux, uint(kFewRays), clvLargestDeposit(rule, 0u, volume.cellSize));
    const double longest = double(length(vec3(volume.resolution))) * (rule == kClvInjectThesis ? 1.0 : double(volume.cellSize));
    StoredCheck history{.buffer = "history 0", .exceptions = exceptionsOf(count)};
    for (std::size_t k = 0; k < count; ++k) {
        const double n = terms[k / stride];
        const double bound = (n + kDeviceUnits) * kUnit * magnitude[k] + (n + 1.0) * (kDeviceUnits * kUnit * largestFlux * longest + 0.5 * fixedUnit);
        history.expected.push_back(float(sum[k] / double(kFewRays)));
        history.bounds.push_back(float(bound / double(kFewRays)));
    }
    StoredCheck irradiance{.buffer = "irradiance 0", .exceptions = exceptionsOf(4 * cpu.receivers.size())};
    for (std::size_t i = 0; i < cpu.receivers.size(); ++i) {
        const ClvCoefficients read = layout.read(cpu.receivers[i].normal);
        const vec3 expected = cpu.table.irradiance(i, layout, history.expected, read);
        // The error of what is read and of the sum over it; no coefficient is read more than about once.
        double bound = 0.0;
        const std::size_t begin = i == 0 ? 0 : cpu.table.ends()[i - 1], end = cpu.table.ends()[i];
        for (std::size_t k = begin; k < end; ++k) {
            for (std::size_t j = 0; j < stride; ++j) {
                const std::size_t number = cpu.table.slots()[k] * stride + j;
                bound += std::abs(double(cpu.table.weights()[k])) * (history.bounds[number] + (double(end - begin) + kDeviceUnits) * kUnit * std::abs(history.expected[number]));
            }
        }
        for (const float value : {expected.x, expected.y, expected.z, 0.0f}) irradiance.expected.push_back(value), irradiance.bounds.push_back(float(bound));
    }
    stored.checks = {history, irradiance};
    return stored;
}

// Two frames of the same rays, some of which come from a light that has moved.
StoredCase movingCase(const CpuScene& cpu) {
    constexpr ClvMergeSettings kMerge{.timestep = 0.1f, .stillTime = 20.0f, .movingTime = 0.05f, .dynamicityTime = 0.5f};
    StoredCase stored{.name = "moving_lights", .settings = cpu.settings(kFewRays), .steps = {"light", "light"}};
    stored.settings.movingLights = true;
    cpu.addLevel(stored.settings);
    stored.settings.receivers = 0;
    std::vector<ClvRay> rays = cpu.rays(kFewRays);
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i].dynamicity = i % 64 < 4 ? 0.2f + 0.2f * float(i % 64) : 0.0f;
    stored.buffers = cpu.levelBuffers(stored.settings);
    stored.buffers.push_back(buffer("frame", cpu.constants(stored.settings)));
    stored.buffers.push_back(buffer("rays", rays));
    stored.buffers.push_back(buffer("merge settings 0", kMerge));

    const DepositLayout layout;
    const std::size_t slots = cpu.level.slots.size(), stride = std::size_t(layout.stride());
    StoredCheck history{.buffer = "history 0", .expected = std::vector<float>(slots * stride)}, dynamicity{.buffer = "kept dynamicity 0", .expected = std::vector<float>(slots * kSides)},
        frames{.buffer = "slot frames 0", .expected = std::vector<float>(slots)};
    for (std::size_t frame = 0; frame < stored.steps.size(); ++frame) {
        std::vector<PartialVolume> partials(1);
        partials[0].resize(slots, layout, true);
        inject(cpu.level, layout, kClvInjectTrackLength, rays, partials[0].target());
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const float largest = mergeDynamicity(kMerge, partials, slot, &dynamicity.expected[slot * kSides]);
            const float weight = clvMergeWeight(kMerge, largest, frames.expected[slot] + 1.0f);
            frames.expected[slot] = clvFramesFromWeight(weight);
            mergeDeposits(partials, slot, stride, 1.0f / float(kFewRays), weight, history.expected.data() + slot * stride);
        }
    }
    float largest = 0.0f;
    for (const float deposit : history.expected) largest = std::max(largest, std::abs(deposit));
    // A device's exponential errs by 4e-6, and weights are differences to 1 of it.
    history.bounds.assign(history.expected.size(), 1e-4f * largest), dynamicity.bounds.assign(dynamicity.expected.size(), 1e-5f);
    for (const float number : frames.expected) frames.bounds.push_back(2e-5f * number * number);
    for (StoredCheck* check : {&history, &dynamicity, &frames}) check->exceptions = exceptionsOf(check->expected.size());
    stored.checks = {history, dynamicity, frames};
    return stored;
}

// The thesis' lines: each cell holds what passes through its middle, and perhaps what passes on the border to the next.
StoredCase slicesCase(const CpuScene& cpu) {
    StoredCase stored{.name = "slices", .settings = cpu.settings(kFewRays), .steps = {"light"}};
    LightFrameSettings& settings = stored.settings;
    settings.storage = kClvStorageCube, settings.rule = kClvInjectThesis, settings.inject = InjectWay::slices;
    cpu.addLevel(settings);
    settings.receivers = 0;
    const std::vector<ClvRay> rays = cpu.rays(kFewRays);
    stored.buffers = cpu.levelBuffers(settings);
    stored.buffers.push_back(buffer("frame", cpu.constants(settings)));
    stored.buffers.push_back(buffer("rays", rays));

    const DepositLayout layout{settings.storage, int(settings.channels)};
    const std::size_t stride = std::size_t(layout.stride()), count = cpu.level.slots.size() * stride;
    std::vector<double> sure(count), most(count), lines(cpu.level.slots.size());
    for (const ClvRay& ray : rays) {
        const ClvRecord record = clvRecordOfRay(layout.storage, uint(layout.channels), ray, ray.direction, clvMostFlux(kClvInjectThesis, cpu.level.volume.cellSize));
        const ClvSlices slices = clvSlicesOfRay(cpu.level.volume, ray);
        for (int s = 0; s < slices.count; ++s) {
            const int z = slices.first + s * slices.step;
            const auto add = [&](const ivec2& cell, bool isSure) {
                const uint entry = cpu.level.table[clvCellIndex(cpu.level.volume, ivec3(cell, z))];
                if (entry == kClvNoSlot) return;
                const CellSlots cellSlots = slotsOfCell(cpu.level, entry);
                for (uint slot = cellSlots.first; slot < cellSlots.first + cellSlots.count; ++slot) {
                    ++lines[slot];
                    for (int k = 0; k < layout.values(); ++k) {
                        const double value = clvRecordValue(record, uint(layout.channels), uint(k));
                        most[slot * stride + std::size_t(k)] += value;
                        if (isSure) sure[slot * stride + std::size_t(k)] += value;
                    }
                }
            };
            forCellsOfLine(clvSlicePiece(cpu.level.volume, ray, z), [&](const ivec2& cell) { add(cell, true); }, [&](const ivec2& cell) { add(cell, false); });
        }
    }
    StoredCheck history{.buffer = "history 0", .exceptions = exceptionsOf(count)};
    for (std::size_t k = 0; k < count; ++k) {
        const double rounding = (lines[k / stride] + kDeviceUnits) * kUnit * most[k];
        history.expected.push_back(float(0.5 * (sure[k] + most[k]) / double(kFewRays)));
        history.bounds.push_back(float((0.5 * (most[k] - sure[k]) + rounding) / double(kFewRays)));
    }
    stored.checks = {history};
    return stored;
}

// What the CPU's own pipeline with Embree leaves in the level.
std::vector<float> historyOfCpu(const CpuScene& cpu, const DepositLayout& layout) {
    StillLightingSettings still;
    still.layout = layout, still.parts = {.halves = int(kHalves), .chunks = 1}, still.seed = kSeed, still.originOffset = cpu.embree.surfaceOffset();
    StillLighting lighting(still, [&](std::span<ClvRay> rays) { cpu.embree.trace(rays); }, serialFor());
    const Volume& volume = lighting.addLevel(cpu.level);
    lighting.rays(cpu.sampler, kManyRays);
    lighting.trace();
    lighting.inject();
    lighting.merge();
    return {volume.history(0).begin(), volume.history(0).end()};
}

// All that a frame from the lights on takes.
StoredCase litCase(const CpuScene& cpu, const std::string& name, const std::vector<std::string>& steps) {
    StoredCase stored{.name = name, .settings = cpu.settings(kManyRays), .steps = steps, .buffers = cpu.sceneBuffers()};
    cpu.addScene(stored.settings);
    cpu.addLevel(stored.settings);
    for (StoredBuffer& more : cpu.levelBuffers(stored.settings)) stored.buffers.push_back(std::move(more));
    stored.buffers.push_back(buffer("frame", cpu.constants(stored.settings)));
    return stored;
}

// From the lights to the receivers.
StoredCase wholeCase(const CpuScene& cpu) {
    StoredCase stored = litCase(cpu, "whole_frame", {"rsm", "light", "evaluate"});
    const DepositLayout layout;
    const std::vector<float> history = historyOfCpu(cpu, layout);
    StoredCheck check{.buffer = "irradiance 0", .largestRmse = 1e-3f};
    for (std::size_t i = 0; i < cpu.receivers.size(); ++i) {
        const vec3 expected = cpu.table.irradiance(i, layout, history, layout.read(cpu.receivers[i].normal));
        check.expected.insert(check.expected.end(), {expected.x, expected.y, expected.z, 0.0f});
    }
    stored.checks = {check};
    return stored;
}

// From the lights to a picture.
StoredCase pictureCase(const CpuScene& cpu) {
    constexpr uvec2 kSize(80, 48);
    constexpr double kOutlinePixels = 0.005;  // whose middles lie on an outline
    StoredCase stored = litCase(cpu, "picture", {"rsm", "light", "picture"});
    stored.settings.picture = kSize;
    stored.settings.receivers = 0;
    const Camera& view = cpu.scene.cameras.front();
    const ClvMapFace camera = cameraFace(view.position, view.forward, view.up, view.yfov, float(kSize.x) / float(kSize.y), 1e-4f * length(cpu.scene.bounds.extent()));
    const ClvPicture picture{.ambient = vec3(0.01f, 0.02f, 0.03f), .ambientThreshold = 0.5f, .width = kSize.x, .height = kSize.y, .pad0 = 0, .pad1 = 0};
    stored.buffers.push_back(buffer("camera", camera));
    stored.buffers.push_back(buffer("picture", picture));

    const DepositLayout layout;
    const std::vector<float> history = historyOfCpu(cpu, layout);
    StoredCheck check{.buffer = "radiance"};
    for (uint i = 0; i < kSize.x * kSize.y; ++i) {
        ClvRay ray = clvPixelRay(camera, uvec2(i % kSize.x, i / kSize.x), kSize);
        ClvHit hit;
        cpu.embree.trace(std::span(&ray, 1), std::span(&hit, 1));
        vec4 radiance(0.0f);
        if (hit.primitive != kClvNoPrimitive) {
            const ClvReceiver receiver = clvReceiverOfHit(ray, hit);
            SlotWeights weights;
            lookupWeights(cpu.level, receiver, {.lookup = kClvLookupTrilinear}, weights);
            radiance = vec4(clvDeferredRadiance(hit.albedo, readIrradiance(layout, history, weights, layout.read(receiver.normal)), picture), 1.0f);
        }
        for (int k = 0; k < 4; ++k) check.expected.push_back(radiance[k]);
    }
    float brightest = 0.0f;
    for (std::size_t k = 0; k < check.expected.size(); ++k) brightest = std::max(brightest, k % 4 < 3 ? check.expected[k] : 0.0f);
    check.bounds.assign(check.expected.size(), 1e-3f * brightest);
    check.exceptions = exceptionsOf(check.expected.size(), kOutlinePixels);
    stored.checks = {check};
    return stored;
}

}  // namespace

std::vector<StoredCase> levelCases() {
    const CpuScene cpu(makeBuiltinScene("two_rooms"));
    const mat3 turned(glm::rotate(glm::mat4(1.0f), 0.5f, normalize(vec3(1.0f, 2.0f, 3.0f))));
    return {injectCase(cpu, "inject_turned", {kClvStorageCube9, 3, turned}, kClvInjectTrackLength),
            injectCase(cpu, "inject_cube9_colour", {kClvStorageCube9, 3}, kClvInjectTrackLength),
            injectCase(cpu, "inject_cube_grey", {kClvStorageCube, 1}, kClvInjectTrackLength), injectCase(cpu, "inject_sh2_colour", {kClvStorageSh2, 3}, kClvInjectTrackLength),
            injectCase(cpu, "inject_thesis", {kClvStorageCube, 3}, kClvInjectThesis), movingCase(cpu), slicesCase(cpu), wholeCase(cpu), pictureCase(cpu)};
}

}  // namespace clv
