// A scene with one level and receivers: all steps of the library's frame on the device, and the same light on the CPU.
#ifndef CLV_TESTS_VULKAN_WHOLE_FRAME_H
#define CLV_TESTS_VULKAN_WHOLE_FRAME_H
#include "bindings/embree/rsm.h"
#include "bindings/embree/visible_points.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/still_lighting.h"
#include "vulkan/level_scene.h"
#include "vulkan/traced_scene.h"

namespace clv::test {

struct WholeFrame : TracedScene {
    static constexpr std::uint32_t kSeed = 3;
    static constexpr std::uint32_t kRsmSide = 64, kReceivers = 500, kHalves = 2;

    Level level;
    BrickSlots bricks;
    std::vector<ClvReceiver> receivers;
    LookupTable table;
    float largestFlux;  // W

    // About n^3 cells.
    WholeFrame(const std::string& name, int n, std::uint32_t rays)
        : TracedScene(makeBuiltinScene(name), kRsmSide, rays, false),
          level(buildLevel(volumeOverBounds(scene.bounds.lo, scene.bounds.hi, n, kClvStorageCube9, vec3(0.3f, 0.6f, 0.1f)), embree.probe(), {}, serialFor())),
          bricks(brickSlots(level)), receivers(visiblePoints(embree, kReceivers, 1)), table(level, receivers, {}, serialFor()) {
        constants.seed = clvHashCombine(kSeed, 0u);  // as FrameRays does
        constants.halves = std::uint32_t(settings.halves = kHalves);
        constants.receiverCount = std::uint32_t(settings.receivers = receivers.size());
        settings.levels = {describeLevel(level, bricks)};
        settings.levels[0].lookupEntries = table.slots().size();
        largestFlux = fluxOfTheCpusRays();
    }

    void uploadTo(VulkanFrame& frame) const {
        uploadScene(frame);
        uploadLevel(frame, settings, 0, level, bricks);
        uploadLookup(frame, 0, table);
        frame.upload("receivers", std::span(receivers));
        uploadConstants(frame, 0);
    }
    // What changes from frame to frame; `number` counts them.
    void uploadConstants(VulkanFrame& frame, std::uint32_t number) const {
        ClvFrame changed = constants;
        changed.firstIndex = number * constants.rayCount;
        frame.upload("frame", changed);
        frame.upload("level 0", levelConstants(level, bricks, settings, 1.0f / float(number + 1), largestFlux));
    }

    // Irradiance at the receivers after one frame by each half, W/m^2.
    std::vector<vec3> onDevice(InjectWay way, ShaderLanguage language = ShaderLanguage::glsl) {
        settings.inject = way;
        VulkanFrame frame(device, lightFrame(settings), language);
        uploadTo(frame);
        frame.run({"rsm", "light", "evaluate"});
        std::vector<vec4> read(kHalves * receivers.size());
        frame.download("irradiance 0", std::span(read));
        return {read.begin(), read.end()};
    }

    std::vector<vec3> onCpu() const {
        const std::vector<ClvRsmTexel> texels = cpuTexels();
        TexelSampler sampler;
        sampler.build(texels, kRsmSide, serialFor());
        StillLightingSettings still;
        still.layout = {settings.storage, int(settings.channels)};
        still.parts = {.halves = kHalves, .chunks = 1};
        still.seed = kSeed, still.originOffset = constants.originOffset;
        StillLighting lighting(still, [this](std::span<ClvRay> rays) { embree.trace(rays); }, serialFor());
        const Volume& volume = lighting.addLevel(level);
        lighting.rays(sampler, settings.rays);
        lighting.trace();
        lighting.inject();
        lighting.merge();
        std::vector<vec3> irradiance;
        for (int half = 0; half < int(kHalves); ++half) {
            for (std::size_t i = 0; i < receivers.size(); ++i) {
                irradiance.push_back(table.irradiance(i, still.layout, volume.history(half), still.layout.read(receivers[i].normal)));
            }
        }
        return irradiance;
    }

private:
    std::vector<ClvRsmTexel> cpuTexels() const {
        const std::size_t each = std::size_t(kRsmSide) * kRsmSide;
        std::vector<ClvRsmTexel> texels(lights.size() * each);
        for (std::size_t k = 0; k < lights.size(); ++k) {
            renderRsm(embree, lights[k], int(kRsmSide), constants.rsmPass, clvHashCombine(constants.rsmSeed, uint(k)), serialFor(), std::span(texels).subspan(k * each, each));
        }
        return texels;
    }
    // Texels are picked in proportion to their flux, summed over the channels: no channel of a ray carries more than all of it.
    float fluxOfTheCpusRays() const {
        const std::vector<ClvRsmTexel> texels = cpuTexels();
        TexelSampler sampler;
        sampler.build(texels, kRsmSide, serialFor());
        return float(sampler.totalFlux());
    }
};

}  // namespace clv::test
#endif
