// Cascades with their light around cameras that nobody can follow: whole frames, in a hall.
#include <algorithm>
#include <cmath>

#include "bindings/cli/stress/stress_case.h"
#include "bindings/cli/stress/walk_rays.h"
#include "bindings/embree/rsm.h"
#include "bindings/scene/scene.h"
#include "clv/cpu/moving_lighting.h"

namespace clv {
namespace {

struct Hall {
    Scene scene = makeBuiltinScene("cornell");
    EmbreeScene embree{scene};
    TexelSampler sampler;
    std::vector<ClvRsmTexel> texels, lit;  // of the lamp as it is, and as it shines

    explicit Hall(const StressSettings& settings) : texels(64 * 64) {
        renderRsm(embree, scene.lights[0].light, 64, 0, settings.seed, settings.parallelFor, texels);
        sampler.build(texels, 64, settings.parallelFor);
    }
    // From here on the lamp is this much brighter than the scene's own, and has this dynamicity.
    void shine(float brightness, float dynamicity, const StressSettings& settings) {
        lit = texels;
        for (ClvRsmTexel& texel : lit) texel.flux *= brightness, texel.dynamicity = dynamicity;
        sampler.build(lit, 64, settings.parallelFor);
    }
    MovingLighting lighting(const MovingLightingSettings& settings, const StressSettings& stress) const {
        return {settings, embree.probe(), [this](std::span<ClvRay> rays) { embree.trace(rays); }, stress.parallelFor};
    }
    void frame(MovingLighting& lighting, float timestep) const {
        lighting.rays(sampler, 4096);
        lighting.trace();
        lighting.inject();
        lighting.merge(timestep);
    }
};

double notFinite(const MovingLighting& lighting) {
    double count = 0.0;
    for (const MovingVolume& volume : lighting.volumes()) {
        for (float value : volume.history()) count += !clvIsFinite(value);
        for (float value : volume.frames()) count += !clvIsFinite(value);
        for (float value : volume.dynamicity()) count += !(value >= 0.0f && value <= 1.0f);
    }
    return count;
}

double meanLight(const MovingLighting& lighting, const Scene& scene) {
    const vec3 middle = scene.bounds.center();
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 normal(0.0f);
        normal[axis] = 1.0f;
        sum += double(lighting.irradiance({middle, 0.0f, normal, 0.0f}).x) + double(lighting.irradiance({middle, 0.0f, -normal, 0.0f}).x);
    }
    return sum / 6.0;
}

// Light in motion: history wears off in 2 s where it stands still, and in a twentieth of a second where it moves.
MovingLightingSettings smallCascades(const Scene& scene) {
    MovingLightingSettings settings;
    settings.cascades.count = 2, settings.cascades.resolution = ivec3(16);
    settings.cascades.finestCellSize = double(scene.bounds.extent().x) / 12.0;
    settings.linesPerCell = 2;
    settings.movingLights = true;
    settings.merge.stillTime = 2.0f;
    return settings;
}

// Away by a million cells and back, frame by frame, under a lamp that changes, with steps of time of seven orders of magnitude: the last
// of them leaves nothing of what was before.
std::vector<StressFigure> farJumps(const StressSettings& settings) {
    Hall hall(settings);
    const MovingLightingSettings cascades = smallCascades(hall.scene);
    MovingLighting moved = hall.lighting(cascades, settings), stayed = hall.lighting(cascades, settings);
    const glm::dvec3 home(hall.scene.bounds.center());
    CameraView here;
    here.position = home;
    stayed.moveTo(here);
    for (int frame = 0; frame < 64; ++frame) hall.frame(stayed, 1.0f / 60.0f);
    const double usual = meanLight(stayed, hall.scene);
    double bad = 0.0, ghosts = 0.0, away = 0.0, off = 0.0;
    float brightness = 1.0f;
    for (double cells : {0.0, 1e6, 0.0, -1e6, 0.0, 4e6, 0.0, 17.0, 0.0}) {
        CameraView view;
        view.position = home + glm::dvec3(cells * cascades.cascades.finestCellSize, 0.0, 0.0);
        if (const std::string problem = validate(cascades, view); !problem.empty()) throw std::runtime_error(problem);
        moved.moveTo(view);
        hall.shine(brightness, 1.0f, settings);
        for (float timestep : {1e-4f, 1.0f / 60.0f, 1e3f}) hall.frame(moved, timestep), bad += notFinite(moved);
        const double light = meanLight(moved, hall.scene);
        if (std::abs(cells) > 100.0) {
            for (const MovingVolume& volume : moved.volumes()) {
                away += double(volume.history().size());
                for (float value : volume.history()) ghosts += value != 0.0f;
            }
        } else if (cells == 0.0) {
            off = largerOf(off, std::abs(light / (usual * double(brightness)) - 1.0));
        }
        brightness = brightness == 1.0f ? 1e4f : 1.0f;
    }
    hall.shine(1.0f, 0.0f, settings);
    hall.frame(moved, 1e3f);
    for (int frame = 0; frame < 64; ++frame) hall.frame(moved, 1.0f / 60.0f);
    bad += notFinite(moved);
    return {{"values that are not finite, dynamicities outside of [0, 1]", bad, 0.0},
            {"deposits looked at where there is no scene", away},
            {"deposits that are not 0 where there is no scene", ghosts, 0.0},
            {"light of one frame at home after 1e3 s, off by at most", off, 0.5},
            {"light after the way back, off by", std::abs(meanLight(moved, hall.scene) / usual - 1.0), 0.05}};
}

// A lamp that jumps by factors of up to a million, at steps of time from 1e-4 s to 1e3 s: no deposit of any history leaves the range of those of
// the frames that it has seen, and each comes as near to the new frame as its dynamicity asks.
std::vector<StressFigure> changingLamp(const StressSettings& settings) {
    Hall hall(settings);
    const MovingLightingSettings cascades = smallCascades(hall.scene);
    // `single` forgets before each frame: the light of that frame alone, of the same rays.
    MovingLighting lit = hall.lighting(cascades, settings), single = hall.lighting(cascades, settings);
    CameraView here;
    here.position = glm::dvec3(hall.scene.bounds.center());
    lit.moveTo(here), single.moveTo(here);
    const std::size_t stride = std::size_t(cascades.layout.stride());
    std::vector<std::vector<float>> lowest, highest, before;
    double bad = 0.0, beyond = 0.0, slow = 0.0, kept = 0.0, changes = 0.0;
    Random random(settings.seed);
    const int frames = settings.exhaustive ? 3000 : 150;
    for (int frame = 0; frame < frames; ++frame) {
        const bool changed = random.below(4) == 0, long_ = random.below(10) == 0;
        const float timestep = long_ ? 1e3f : std::pow(10.0f, -4.0f + 7.0f * random.unit());
        changes += changed;
        if (changed) hall.shine(std::pow(10.0f, -3.0f + 6.0f * random.unit()), random.unit(), settings);
        single.reset();
        hall.frame(lit, timestep), hall.frame(single, timestep);
        bad += notFinite(lit);
        lowest.resize(lit.volumes().size()), highest.resize(lit.volumes().size()), before.resize(lit.volumes().size());
        for (std::size_t v = 0; v < lit.volumes().size(); ++v) {
            const std::span<const float> history = lit.volumes()[v].history(), now = single.volumes()[v].history(), dynamicity = lit.volumes()[v].dynamicity();
            if (frame == 0) lowest[v].assign(now.begin(), now.end()), highest[v] = before[v] = lowest[v];
            for (std::size_t slot = 0; slot < history.size() / stride; ++slot) {
                const double largest = *std::ranges::max_element(dynamicity.subspan(slot * kSides, kSides));
                const ClvMergeSettings& merge = cascades.merge;
                const double rate = 1.0 / double(merge.stillTime) + (1.0 / double(merge.movingTime) - 1.0 / double(merge.stillTime)) * largest;
                const double left = std::exp(-rate * double(timestep));
                for (std::size_t k = slot * stride; k < (slot + 1) * stride; ++k) {
                    lowest[v][k] = std::min(lowest[v][k], now[k]), highest[v][k] = std::max(highest[v][k], now[k]);
                    beyond += !(history[k] >= lowest[v][k] && history[k] <= highest[v][k]);
                    const double was = std::abs(double(before[v][k]) - double(now[k])), is = std::abs(double(history[k]) - double(now[k]));
                    // Rounding is that of the larger of the two.
                    slow += !(is <= left * was + 0x1p-20 * std::max(std::abs(double(before[v][k])), std::abs(double(now[k]))));
                    if (timestep == 1e3f) kept += history[k] != now[k];
                    before[v][k] = history[k];
                }
            }
        }
    }
    return {{"changes of the lamp", changes},
            {"values that are not finite, dynamicities outside of [0, 1]", bad, 0.0},
            {"deposits beyond those of all frames so far", beyond, 0.0},
            {"deposits that follow more slowly than their dynamicity asks", slow, 0.0},
            {"deposits that a step of 1e3 s leaves something of", kept, 0.0}};
}

// A camera of NaN or beyond all cells is refused in words, and the light stays as it was.
std::vector<StressFigure> badCameras(const StressSettings& settings) {
    const Hall hall(settings);
    const MovingLightingSettings cascades = smallCascades(hall.scene);
    double unsaid = 0.0;
    for (double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, 4.3e6}) {
        for (int axis = 0; axis < 3; ++axis) {
            CameraView view;
            view.position[axis] = bad * (std::abs(bad) < 1e7 ? cascades.cascades.finestCellSize : 1.0);
            unsaid += validate(cascades, view).empty();
        }
    }
    return {{"cameras that were not refused", unsaid, 0.0}};
}

}  // namespace

std::vector<StressCase> movingCases() {
    return {{"moving", "a camera that moves a million cells a frame, and back", "no light is taken along, and it comes back", farJumps},
            {"moving", "a lamp that jumps a millionfold, steps of 1e-4 s to 1e3 s", "no history overshoots, and each follows as fast as its dynamicity asks", changingLamp},
            {"moving", "cameras of NaN, infinite and out of reach", "each is refused in words", badCameras}};
}

}  // namespace clv
