#include "benchmarks/gpu_run/stored_cases.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>

#include "bindings/embree/bvh.h"
#include "bindings/embree/rsm.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/surface_rows.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/still_lighting.h"
#include "clv/plan/map_faces.h"
#include "clv/stages/pick_texel.h"

namespace clv {
namespace {

constexpr std::uint32_t kRsmSide = 32, kHalves = 1, kSeed = 3, kReceivers = 500;
constexpr int kCells = 8;
constexpr std::uint64_t kFewRays = 2048, kManyRays = 65536;
constexpr double kUnit = 0x1p-24;     // rounding of a float
// Devices may round a division to within 2.5 units in the last place, and sines and square roots to some more.
constexpr double kDeviceUnits = 16.0;
// Of the numbers of a check: rays next to an edge, pieces next to a plane.
constexpr double kExceptions = 2e-3;
// Where maps are drawn, texels at outlines differ, with pictures of kFaceSide^2 texels.
constexpr std::uint32_t kFaceSide = 192;
constexpr double kOutlines = 0.03;

template <class T>
StoredBuffer buffer(const std::string& name, std::span<const T> items) {
    const auto bytes = std::as_bytes(items);
    return {name, {bytes.begin(), bytes.end()}};
}
template <class T>
StoredBuffer buffer(const std::string& name, const std::vector<T>& items) { return buffer(name, std::span<const T>(items)); }
template <class T>
StoredBuffer buffer(const std::string& name, const T& item) { return buffer(name, std::span<const T>(&item, 1)); }

template <class T>
std::vector<float> floatsOf(const std::vector<T>& items) {
    std::vector<float> floats(items.size() * sizeof(T) / sizeof(float));
    std::memcpy(floats.data(), items.data(), floats.size() * sizeof(float));
    return floats;
}

std::uint64_t exceptionsOf(std::size_t numbers, double share = kExceptions) { return std::uint64_t(share * double(numbers)); }

// A scene, its maps and rays by Embree, a level, and receivers.
struct CpuScene {
    Scene scene;
    StoredScene rows;
    EmbreeScene embree;
    std::vector<ClvLight> lights;
    std::vector<ClvRsmTexel> texels;
    TexelSampler sampler;
    Level level;
    BrickSlots bricks;
    std::vector<ClvReceiver> receivers;
    LookupTable table;

    explicit CpuScene(const std::string& name)
        : scene(makeBuiltinScene(name)), rows(storedScene(name)), embree(scene),
          level(buildLevel(volumeOverBounds(scene.bounds.lo, scene.bounds.hi, kCells, kClvStorageCube9, vec3(0.3f, 0.6f, 0.1f)), embree.probe(), {}, serialFor())),
          bricks(brickSlots(level)), receivers(visiblePoints(embree, kReceivers, 1)), table(level, receivers, {}, serialFor()) {
        for (const NamedLight& light : scene.lights) lights.push_back(light.light);
        const std::size_t each = std::size_t(kRsmSide) * kRsmSide;
        texels.resize(lights.size() * each);
        for (std::size_t k = 0; k < lights.size(); ++k) {
            renderRsm(embree, lights[k], int(kRsmSide), 0, clvHashCombine(kSeed, uint(k)), serialFor(), std::span(texels).subspan(k * each, each));
        }
        sampler.build(texels, kRsmSide, serialFor());
    }

    LightFrameSettings settings(std::uint64_t rays) const {
        LightFrameSettings settings;
        settings.rays = rays, settings.halves = kHalves;
        return settings;
    }
    void addLevel(LightFrameSettings& settings) const {
        settings.receivers = receivers.size();
        settings.levels = {describeLevel(level, bricks)};
        settings.levels[0].lookupEntries = table.slots().size();
    }
    void addScene(LightFrameSettings& settings) const {
        settings.lights = lights.size(), settings.rsmSide = kRsmSide;
        settings.triangles = scene.triangles.size(), settings.bvhNodes = rows.children.size();
    }

    ClvFrame constants(const LightFrameSettings& settings) const {
        ClvFrame constants{};
        constants.boundsLo = scene.bounds.lo, constants.boundsHi = scene.bounds.hi;
        constants.rayCount = uint(settings.rays), constants.halves = kHalves, constants.seed = clvHashCombine(kSeed, 0u), constants.rsmSeed = kSeed;
        constants.rsmSide = kRsmSide, constants.texelRows = uint(settings.lights) * kRsmSide, constants.receiverCount = uint(settings.receivers);
        constants.originOffset = embree.surfaceOffset(), constants.triangleCount = uint(rows.triangles.size() / kClvTriangleRows);
        return constants;
    }
    std::vector<StoredBuffer> sceneBuffers() const {
        return {buffer("lights", lights), buffer("bvh boxes", rows.boxes), buffer("bvh children", rows.children), buffer("triangles", rows.triangles), buffer("surfaces", rows.surfaces)};
    }
    std::vector<StoredBuffer> levelBuffers(const LightFrameSettings& settings) const {
        const std::vector<uint> ends(table.ends().begin(), table.ends().end());
        return {buffer("level 0", levelConstants(level, bricks, settings, 1.0f, float(sampler.totalFlux()))), buffer("table 0", level.table), buffer("splits 0", level.splits),
                buffer("slots 0", level.slots), buffer("brick slots 0", bricks.slots), buffer("brick mask 0", bricks.mask), buffer("receivers", receivers), buffer("lookup ends 0", ends),
                buffer("lookup slots 0", table.slots()), buffer("lookup weights 0", table.weights())};
    }

    // Items of which flux is three numbers from offset `flux` on. exceptions: a share of all numbers.
    template <class T>
    StoredCheck check(const std::string& name, const std::vector<T>& items, std::size_t flux, double exceptions) const {
        StoredCheck check{.buffer = name, .expected = floatsOf(items)};
        const float reach = length(scene.bounds.extent());
        for (std::size_t i = 0; i < check.expected.size(); ++i) {
            const std::size_t offset = i * sizeof(float) % sizeof(T);
            // Flux is that of a ray's probability, a difference of running sums.
            const bool isFlux = offset >= flux && offset < flux + sizeof(vec3);
            check.bounds.push_back(isFlux ? 1e-3f * std::abs(check.expected[i]) : 1e-4f * reach);
        }
        check.exceptions = exceptionsOf(check.expected.size(), exceptions);
        return check;
    }
    StoredCheck mapCheck(double exceptions) const { return check("texels", texels, offsetof(ClvRsmTexel, flux), exceptions); }

    // Drawn from the maps, and cut; in the order in which the device's threads take them.
    std::vector<ClvRay> rays(std::uint64_t count, std::vector<ClvHit>* hits = nullptr) const {
        std::vector<ClvRay> drawn(count), rays;
        makeRays(sampler, 0, clvHashCombine(kSeed, 0u), embree.surfaceOffset(), drawn);
        for (uint i = 0; i < count; ++i) rays.push_back(drawn[clvNeighbourIndex(i, uint(count))]);
        if (hits) {
            hits->resize(count);
            embree.trace(rays, *hits);
        } else {
            embree.trace(rays);
        }
        return rays;
    }
};

// Maps, rays where they begin and end, and what they meet.
StoredCase traceCase(const CpuScene& cpu) {
    StoredCase stored{.name = "trace", .settings = cpu.settings(kFewRays), .steps = {"rsm", "light"}, .buffers = cpu.sceneBuffers()};
    cpu.addScene(stored.settings);
    stored.settings.keepHits = true;
    stored.buffers.push_back(buffer("frame", cpu.constants(stored.settings)));
    std::vector<ClvHit> hits;
    const std::vector<ClvRay> rays = cpu.rays(kFewRays, &hits);
    stored.checks = {cpu.mapCheck(kExceptions), cpu.check("rays", rays, offsetof(ClvRay, flux), kExceptions), cpu.check("hits", hits, sizeof(ClvHit), kExceptions)};
    return stored;
}

// The same maps, drawn.
StoredCase drawnCase(const CpuScene& cpu) {
    StoredCase stored{.name = "drawn_maps", .settings = cpu.settings(kFewRays), .steps = {"rsm", "light"}, .buffers = cpu.sceneBuffers()};
    const std::vector<ClvMapFace> faces = mapFaces(cpu.lights, cpu.scene.bounds.lo, cpu.scene.bounds.hi, kFaceSide);
    cpu.addScene(stored.settings);
    stored.settings.mapFaces = std::uint32_t(faces.size()), stored.settings.faceSide = kFaceSide;
    ClvFrame constants = cpu.constants(stored.settings);
    constants.faceCount = stored.settings.mapFaces, constants.faceSide = kFaceSide;
    stored.buffers.push_back(buffer("frame", constants));
    stored.buffers.push_back(buffer("map faces", faces));
    stored.checks = {cpu.mapCheck(kOutlines)};
    return stored;
}

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
        const ClvRecord record = clvRecordOfRay(layout.storage, uint(layout.channels), ray, layout.frame * ray.direction);
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

// From the lights to the receivers, beside the CPU's own pipeline with Embree.
StoredCase wholeCase(const CpuScene& cpu) {
    StoredCase stored{.name = "whole_frame", .settings = cpu.settings(kManyRays), .steps = {"rsm", "light", "evaluate"}, .buffers = cpu.sceneBuffers()};
    cpu.addScene(stored.settings);
    cpu.addLevel(stored.settings);
    for (StoredBuffer& more : cpu.levelBuffers(stored.settings)) stored.buffers.push_back(std::move(more));
    stored.buffers.push_back(buffer("frame", cpu.constants(stored.settings)));
    StillLightingSettings still;
    still.parts = {.halves = int(kHalves), .chunks = 1}, still.seed = kSeed, still.originOffset = cpu.embree.surfaceOffset();
    StillLighting lighting(still, [&](std::span<ClvRay> rays) { cpu.embree.trace(rays); }, serialFor());
    const Volume& volume = lighting.addLevel(cpu.level);
    lighting.rays(cpu.sampler, kManyRays);
    lighting.trace();
    lighting.inject();
    lighting.merge();
    StoredCheck check{.buffer = "irradiance 0", .largestRmse = 1e-3f};
    for (std::size_t i = 0; i < cpu.receivers.size(); ++i) {
        const vec3 expected = cpu.table.irradiance(i, still.layout, volume.history(0), still.layout.read(cpu.receivers[i].normal));
        check.expected.insert(check.expected.end(), {expected.x, expected.y, expected.z, 0.0f});
    }
    stored.checks = {check};
    return stored;
}

}  // namespace

StoredScene storedScene(const std::string& name) {
    const Scene scene = makeBuiltinScene(name);
    const Bvh bvh = buildBvh(scene);
    const SurfaceRows rows = surfaceRowsOf(scene);
    if (!rows.textureTexels.empty()) throw std::runtime_error("the scene " + name + " has textures, which are not stored");
    StoredScene stored{.name = name, .boxes = bvh.boxes, .children = bvh.children, .triangles = bvh.triangles, .surfaces = rows.surfaces};
    for (const NamedLight& light : scene.lights) stored.lights.push_back(light.light);
    stored.boundsLo = scene.bounds.lo, stored.boundsHi = scene.bounds.hi;
    stored.originOffset = EmbreeScene(scene).surfaceOffset();
    const Camera& camera = scene.cameras.front();
    stored.camera = {camera.position, camera.forward, camera.up, camera.yfov};
    return stored;
}

std::vector<StoredCase> storedCases() {
    const CpuScene cpu("two_rooms");
    const mat3 turned(glm::rotate(glm::mat4(1.0f), 0.5f, normalize(vec3(1.0f, 2.0f, 3.0f))));
    return {traceCase(cpu), drawnCase(cpu), injectCase(cpu, "inject_turned", {kClvStorageCube9, 3, turned}, kClvInjectTrackLength),
            injectCase(cpu, "inject_cube9_colour", {kClvStorageCube9, 3}, kClvInjectTrackLength),
            injectCase(cpu, "inject_cube_grey", {kClvStorageCube, 1}, kClvInjectTrackLength), injectCase(cpu, "inject_sh2_colour", {kClvStorageSh2, 3}, kClvInjectTrackLength),
            injectCase(cpu, "inject_thesis", {kClvStorageCube, 3}, kClvInjectThesis), wholeCase(cpu)};
}

}  // namespace clv
