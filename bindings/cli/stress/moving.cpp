// Cascades with their light around cameras that nobody can follow: whole frames, in a hall.
#include <cmath>

#include "bindings/cli/stress/stress_case.h"
#include "bindings/embree/rsm.h"
#include "bindings/scene/scene.h"
#include "clv/cpu/moving_lighting.h"

namespace clv {
namespace {

struct Hall {
    Scene scene = makeBuiltinScene("cornell");
    EmbreeScene embree{scene};
    TexelSampler sampler;
    std::vector<ClvRsmTexel> texels;

    explicit Hall(const StressSettings& settings) : texels(64 * 64) {
        renderRsm(embree, scene.lights[0].light, 64, 0, settings.seed, settings.parallelFor, texels);
        sampler.build(texels, 64, settings.parallelFor);
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

struct Badness {
    double notFinite = 0.0, negative = 0.0;
    void look(const MovingLighting& lighting, const glm::dvec3& around) {
        for (int k = 0; k < 64; ++k) {
            const vec3 offset(float(k % 4) - 1.5f, float(k / 4 % 4) - 1.5f, float(k / 16) - 1.5f);
            const vec3 e = lighting.irradiance({vec3(around) + 0.1f * offset, 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
            for (int c = 0; c < 3; ++c) notFinite += !isFinite(double(e[c])), negative += e[c] < 0.0f;
        }
        for (const MovingVolume& volume : lighting.volumes()) {
            for (float value : volume.history()) notFinite += !isFinite(double(value));
        }
    }
};

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

MovingLightingSettings smallCascades(const Scene& scene) {
    MovingLightingSettings settings;
    settings.cascades.count = 2, settings.cascades.resolution = ivec3(16);
    settings.cascades.finestCellSize = double(scene.bounds.extent().x) / 12.0;
    settings.linesPerCell = 2;
    return settings;
}

// Away by a million cells and back, frame by frame, with steps of time of seven orders of magnitude: the light of a camera that stayed.
std::vector<StressFigure> jumps(const StressSettings& settings) {
    const Hall hall(settings);
    const MovingLightingSettings cascades = smallCascades(hall.scene);
    MovingLighting moved = hall.lighting(cascades, settings), stayed = hall.lighting(cascades, settings);
    const glm::dvec3 home(hall.scene.bounds.center());
    Badness bad;
    for (double cells : {0.0, 1e6, 0.0, -1e6, 0.0, 4e6, 0.0, 17.0, 0.0}) {
        CameraView view;
        view.position = home + glm::dvec3(cells * cascades.cascades.finestCellSize, 0.0, 0.0);
        if (const std::string problem = validate(cascades, view); !problem.empty()) throw std::runtime_error(problem);
        moved.moveTo(view);
        for (float timestep : {1e-4f, 1.0f / 60.0f, 1e3f}) hall.frame(moved, timestep);
        bad.look(moved, view.position);
    }
    CameraView here;
    here.position = home;
    stayed.moveTo(here);
    for (int frame = 0; frame < 64; ++frame) hall.frame(moved, 1.0f / 60.0f), hall.frame(stayed, 1.0f / 60.0f);
    bad.look(moved, home);
    return {{"values that are not finite", bad.notFinite, 0.0},
            {"irradiances below 0", bad.negative, 0.0},
            {"light after the way back, off by", std::abs(meanLight(moved, hall.scene) / meanLight(stayed, hall.scene) - 1.0), 0.05}};
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
    return {{"moving", "a camera that moves a million cells a frame, and back", "all is finite, and the light comes back", jumps},
            {"moving", "cameras of NaN, infinite and out of reach", "each is refused in words", badCameras}};
}

}  // namespace clv
