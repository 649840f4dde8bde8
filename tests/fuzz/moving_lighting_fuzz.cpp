// Whatever description of moving light `validate` lets through, frames of it are finite and stay within memory.
#include "cpu/moving_scene.h"
#include "fuzz/bytes.h"

using namespace clv;
using namespace clv::test;

namespace {

// Frames beyond this are right, but too slow to try many of.
constexpr double kMostLines = 3e4;
constexpr std::size_t kMostBytes = std::size_t(64) << 20;

glm::dvec3 place(FuzzBytes& bytes) { return {bytes.number(-20.0, 20.0), bytes.number(-20.0, 20.0), bytes.number(-20.0, 20.0)}; }

MovingLightingSettings settingsFrom(FuzzBytes& bytes) {
    MovingLightingSettings s;
    s.cascades.count = bytes.integer(1, 3);
    for (int axis = 0; axis < 3; ++axis) s.cascades.resolution[axis] = bytes.integer(4, 12);
    s.cascades.finestCellSize = bytes.number(0.1, 4.0);
    s.cascades.growth = bytes.number(1.0, 4.0);
    s.cascades.marginCells = bytes.integer(0, 3);
    s.cascades.fit = bytes.flag() ? CascadeFit::frustum : CascadeFit::camera;
    s.blendCells = bytes.number(0.0f, 4.0f);
    s.anchor = place(bytes);
    s.layout.storage = uint(bytes.integer(0, 3));
    s.layout.channels = bytes.flag() ? 3 : bytes.integer(1, 3);
    if (bytes.flag()) s.layout.frame[bytes.byte() % 3][bytes.byte() % 3] = bytes.number(-1.0f, 1.0f);
    s.chunks = bytes.integer(1, 4);
    s.rule = uint(bytes.integer(0, 1));
    s.seed = bytes.take<uint>();
    s.originOffset = bytes.number(0.0f, 0.1f);
    s.linesPerCell = bytes.integer(1, 4);
    s.slotsPerCell = bytes.number(0.1f, 4.0f);
    s.movingLights = bytes.flag();
    s.guessFrames = bytes.number(0.0f, 16.0f);
    s.slidOutFrames = bytes.number(0.0f, 4.0f);
    s.newCellDynamicity = bytes.number(0.0f, 1.0f);
    s.merge.timestep = bytes.number(0.0f, 1.0f);
    s.merge.stillTime = bytes.number(0.0f, 1000.0f);
    s.merge.movingTime = bytes.number(0.0f, 1.0f);
    s.merge.dynamicityTime = bytes.number(0.0f, 10.0f);
    s.lookup.lookup = uint(bytes.integer(0, 2));
    s.lookup.planeCulling = bytes.flag(), s.lookup.visibility = bytes.flag();
    s.lookup.ridge = bytes.number(0.0f, 1.0f);
    return s;
}

CameraView viewFrom(FuzzBytes& bytes) {
    CameraView view;
    view.position = place(bytes);
    const glm::dvec3 forward = place(bytes);
    view.forward = bytes.flag() ? forward : glm::normalize(forward);
    view.yfov = bytes.number(0.0, 3.2);
    view.aspect = bytes.number(0.1, 4.0);
    return view;
}

bool isLight(const vec3& irradiance) { return clvIsFinite(irradiance) && irradiance.x >= 0.0f && irradiance.y >= 0.0f && irradiance.z >= 0.0f; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FuzzBytes bytes(data, size);
    const MovingLightingSettings settings = settingsFrom(bytes);
    if (!validate(settings).empty()) return 0;
    const double lines = double(settings.cascades.count) * settings.cascades.resolution.x * settings.cascades.resolution.y * settings.cascades.resolution.z * settings.linesPerCell * settings.linesPerCell;
    if (lines > kMostLines || MovingLighting::bytes(settings) > kMostBytes) return 0;

    static const LitHall hall;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    for (int frame = 0; frame < 3; ++frame) {
        const CameraView view = viewFrom(bytes);
        if (!validate(settings, view).empty()) continue;
        lighting.moveTo(view);
        lighting.rays(hall.sampler, 200);
        lighting.trace();
        lighting.inject();
        lighting.merge(settings.merge.timestep);
        for (const MovingVolume& volume : lighting.volumes()) {
            for (float value : volume.history()) require(clvIsFinite(value), "history is finite");
        }
        for (int k = 0; k < 4; ++k) {
            const vec3 position(place(bytes));
            const vec3 normal(place(bytes));
            if (!clvIsFinite(position) || !(dot(normal, normal) > 1e-30f && dot(normal, normal) < 1e30f)) continue;
            require(isLight(lighting.irradiance({position, 0.0f, glm::normalize(normal), 0.0f})), "irradiance is finite and not negative");
        }
    }
    return 0;
}
