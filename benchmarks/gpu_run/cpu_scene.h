// A scene on the CPU, from which cases are stored: its maps and rays by Embree, a level, and receivers.
#pragma once
#include <cmath>
#include <cstring>

#include "benchmarks/gpu_run/stored.h"
#include "bindings/embree/bvh.h"
#include "bindings/embree/rsm.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/surface_rows.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/still_lighting.h"
#include "clv/stages/pick_texel.h"

namespace clv {

inline constexpr std::uint32_t kRsmSide = 32, kHalves = 1, kSeed = 3, kReceivers = 500;
inline constexpr int kCells = 8;
inline constexpr std::uint64_t kFewRays = 2048, kManyRays = 65536;
// Of the numbers of a check: rays next to an edge, pieces next to a plane.
inline constexpr double kExceptions = 2e-3;

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

inline std::uint64_t exceptionsOf(std::size_t numbers, double share = kExceptions) { return std::uint64_t(share * double(numbers)); }

// A scene, its maps and rays by Embree, a level, and receivers.
struct CpuScene {
    Scene scene;
    EmbreeScene embree;
    Bvh bvh;
    SurfaceRows surfaces;
    std::vector<ClvLight> lights;
    std::vector<ClvRsmTexel> texels;
    TexelSampler sampler;
    Level level;
    BrickSlots bricks;
    std::vector<ClvReceiver> receivers;
    LookupTable table;

    explicit CpuScene(Scene source)
        : scene(std::move(source)), embree(scene), bvh(buildBvh(scene)), surfaces(surfaceRowsOf(scene)),
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
        settings.triangles = scene.triangles.size(), settings.bvhNodes = bvh.children.size(), settings.textureTexels = surfaces.textureTexels.size();
    }

    ClvFrame constants(const LightFrameSettings& settings) const {
        ClvFrame constants{};
        constants.boundsLo = scene.bounds.lo, constants.boundsHi = scene.bounds.hi;
        constants.rayCount = uint(settings.rays), constants.halves = kHalves, constants.seed = clvHashCombine(kSeed, 0u), constants.rsmSeed = kSeed;
        constants.rsmSide = kRsmSide, constants.texelRows = uint(settings.lights) * kRsmSide, constants.receiverCount = uint(settings.receivers);
        constants.originOffset = embree.surfaceOffset(), constants.triangleCount = uint(bvh.triangles.size() / kClvTriangleRows);
        return constants;
    }
    std::vector<StoredBuffer> sceneBuffers() const {
        std::vector<StoredBuffer> buffers{buffer("lights", lights), buffer("bvh boxes", bvh.boxes), buffer("bvh children", bvh.children), buffer("triangles", bvh.triangles),
                                          buffer("surfaces", surfaces.surfaces)};
        if (surfaces.textureTexels.empty()) return buffers;
        buffers.push_back(buffer("texture rows", surfaces.textureRows));
        buffers.push_back(buffer("texture texels", surfaces.textureTexels));
        return buffers;
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
    std::vector<ClvRay> rays(std::uint64_t count, std::vector<ClvHit>* hits = nullptr) const { return rays(sampler, count, hits); }
    std::vector<ClvRay> rays(const TexelSampler& from, std::uint64_t count, std::vector<ClvHit>* hits = nullptr) const {
        std::vector<ClvRay> drawn(count), rays;
        makeRays(from, 0, clvHashCombine(kSeed, 0u), embree.surfaceOffset(), drawn);
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

}  // namespace clv
