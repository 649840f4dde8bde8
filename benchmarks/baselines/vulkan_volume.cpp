#include "benchmarks/baselines/vulkan_volume.h"

#include <algorithm>
#include <optional>

#include "bindings/embree/bvh.h"
#include "bindings/embree/light_maps.h"
#include "bindings/scene/scene_facts.h"
#include "bindings/scene/surface_rows.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/cpu/build_level.h"
#include "clv/plan/largest_flux.h"
#include "clv/plan/triangle_corners.h"

namespace clv {
namespace {

constexpr std::uint64_t kMostRays = 64 << 10;  // of a submission

class VulkanVolume : public Method {
public:
    explicit VulkanVolume(const VulkanVolumeSettings& settings) : settings_(settings) {}

    std::string name() const override { return "clv_vulkan"; }
    MethodSettings settings() const override {
        return {{"device", settings_.device}, {"resolution", std::to_string(settings_.resolution)}, {"readers", readersName(settings_.readers)}};
    }

    void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) override {
        const Scene& scene = world.scene.scene();
        device_.emplace(VulkanOptions{.device = settings_.device, .rayQueries = true, .rayPipelines = true});
        buildLevelFor(world, receivers);
        std::vector<ClvReceiver> points;
        for (const ReferencePoint& p : receivers) points.push_back({p.position, 0.0f, p.normal, 0.0f});
        const LookupTable lookups(level_, points, {}, world.parallelFor);
        const Bvh bvh = buildBvh(scene);
        const SurfaceRows surfaces = surfaceRowsOf(scene);
        const std::vector<ClvLight> lights = lightsThatSend(scene);
        const Needs needs = planNeeds(sceneFacts(scene));
        describe(needs, lights.size(), bvh, surfaces, points.size(), lookups.slots().size());

        const Frame frame = lightFrame(frame_);
        for (const FrameBuffer& buffer : frame.buffers) bytes_ += buffer.name.ends_with(" 0") ? buffer.bytes : 0;  // those of the level
        run_.emplace(*device_, frame);
        run_->upload("lights", std::span(lights));
        run_->upload("triangles", std::span(bvh.triangles));
        if (frame_.trace == TraceWay::walk) {
            run_->upload("bvh boxes", std::span(bvh.boxes));
            run_->upload("bvh children", std::span(bvh.children));
        } else {
            run_->upload("corners", std::span<const vec3>(triangleCorners(bvh.triangles, frame_.triangles)));
            run_->run("scene");
        }
        run_->upload("surfaces", std::span(surfaces.surfaces));
        if (frame_.textureTexels > 0) {
            run_->upload("texture rows", std::span(surfaces.textureRows));
            run_->upload("texture texels", std::span(surfaces.textureTexels));
        }
        uploadLevel(*run_, frame_, 0, level_, bricks_);
        uploadLookup(*run_, 0, lookups);
        run_->upload("receivers", std::span<const ClvReceiver>(points));

        constants_.boundsLo = scene.bounds.lo, constants_.boundsHi = scene.bounds.hi;
        constants_.halves = 1, constants_.receiverCount = uint(points.size());
        constants_.rsmSide = uint(frame_.rsmSide), constants_.texelRows = uint(lights.size() * frame_.rsmSide);
        constants_.triangleCount = uint(frame_.triangles), constants_.originOffset = world.scene.surfaceOffset();
        keepDirectionsAlong(needs.frame, constants_);
        largestFlux_ = largestRayFlux(lights, scene.bounds.lo, scene.bounds.hi);
        irradiance_.resize(points.size());
        restart(1);
    }

    void restart(std::uint32_t seed) override {
        constants_.seed = clvHashCombine(seed, 0u), constants_.rsmSeed = clvHashCombine(seed, 0x3u);
        constants_.firstIndex = 0, pass_ = 0;
        rays_ = 0;
    }

    void renderMaps() override {
        constants_.rsmPass = pass_++;
        run_->upload("frame", constants_);
        run_->run("rsm");
    }

    void frame(std::size_t rays) override {
        for (std::size_t left = rays; left > 0; left -= constants_.rayCount) {
            constants_.rayCount = uint(std::min<std::size_t>(left, frame_.rays));
            rays_ += constants_.rayCount;
            // The first rays after a restart leave nothing of what was there: they weigh 1.
            run_->upload("frame", constants_);
            LightFrameSettings settings = frame_;
            settings.rays = constants_.rayCount;
            run_->upload("level 0", levelConstants(level_, bricks_, settings, float(double(constants_.rayCount) / double(rays_)), largestFlux_));
            run_->run("light");
            constants_.firstIndex += constants_.rayCount;
        }
    }

    void irradiance(std::span<glm::vec3> out) override {
        std::fill(out.begin(), out.end(), glm::vec3(0.0f));
        if (rays_ == 0) return;
        run_->run("evaluate");
        run_->download("irradiance 0", std::span(irradiance_));
        std::ranges::transform(irradiance_, out.begin(), [](const vec4& e) { return vec3(e); });
    }

    std::size_t bytes() const override { return bytes_; }
    std::uint64_t raysTraced() const override { return rays_; }

private:
    void buildLevelFor(const MethodWorld& world, std::span<const ReferencePoint> receivers) {
        const Bounds& bounds = world.scene.scene().bounds;
        const ClvVolume volume = volumeOverBounds(bounds.lo, bounds.hi, settings_.resolution, kClvStorageCube9);
        const std::vector<ClvReceiver> readers = readingPoints(settings_.readers, world, receivers);
        const auto needed = settings_.readers == Readers::anywhere ? std::vector<std::uint8_t>() : neededCells(volume, readers);
        level_ = buildLevel(volume, world.scene.probe(), needed, world.parallelFor);
        bricks_ = brickSlots(level_);
    }

    void describe(const Needs& needs, std::size_t lights, const Bvh& bvh, const SurfaceRows& surfaces, std::size_t receivers, std::size_t lookupEntries) {
        frame_.lights = lights, frame_.rsmSide = std::uint64_t(mapSide(lights));
        frame_.triangles = surfaces.surfaces.size() / kClvSurfaceRows, frame_.bvhNodes = bvh.children.size();
        frame_.textureTexels = surfaces.textureTexels.size();
        frame_.receivers = receivers;
        frame_.channels = std::uint32_t(needs.channels), frame_.turned = needs.frame != mat3(1.0f);
        frame_.trace = defaultTrace(device_->info());
        if (frame_.trace != TraceWay::walk) frame_.accelerationBytes = device_->accelerationBytes(frame_.triangles);
        frame_.inject = defaultInject(device_->info().features);
        frame_.levels = {describeLevel(level_, bricks_)};
        frame_.levels[0].lookupEntries = lookupEntries;
        frame_.rays = std::min(kMostRays, largestFrameRays(frame_, device_->info().limits));
    }

    const VulkanVolumeSettings settings_;
    std::optional<VulkanDevice> device_;
    Level level_;
    BrickSlots bricks_;
    LightFrameSettings frame_;
    std::optional<VulkanFrame> run_;
    ClvFrame constants_{};
    float largestFlux_ = 0.0f;  // W, of any channel of any ray
    std::vector<vec4> irradiance_;
    std::size_t bytes_ = 0;
    std::uint32_t pass_ = 0;
    std::uint64_t rays_ = 0;
};

}  // namespace

std::unique_ptr<Method> makeVulkanVolume(const VulkanVolumeSettings& settings) { return std::make_unique<VulkanVolume>(settings); }

}  // namespace clv
