// Lamps as dim and as bright as floats are, and cones at the ends of their range.
#include <cmath>

#include "bindings/cli/stress/whole_run.h"

namespace clv {
namespace {

// A closed room of 2 m and the mean irradiance on its walls after one bounce.
struct LitRoom {
    double mean = 0.0;  // W/m^2
    bool warned = false;
};
LitRoom lightRoom(std::span<const std::pair<ClvLight, glm::dvec3>> lamps, std::uint64_t rays, const StressSettings& settings) {
    SceneBuilder builder("room");
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(float(kAlbedo)), -1});
    builder.beginNode("room");
    addRoom(builder, grey);
    for (const auto& [lamp, position] : lamps) builder.addLight("lamp", lamp, position);
    const Scene scene = std::move(builder).finish("room");
    const WholeRun run = wholeRun(scene, pointsOnWalls(1.0, -scene.anchor), smallRun(rays, false), settings);
    return {meanOf(run.irradiance), !run.report.warnings.empty()};
}

// Cones of no and of half the sphere's width, and lamps that are off or as bright as floats are: the mean is albedo * power / area.
std::vector<StressFigure> lamps(const StressSettings& settings) {
    std::vector<StressFigure> figures;
    // power: W, of the lamp; mustWarn: where floats do not reach it.
    const auto add = [&](const std::string& name, const ClvLight& lamp, double power, bool mustWarn) {
        const std::pair<ClvLight, glm::dvec3> one{lamp, {0.1, 0.5, 0.2}};
        const LitRoom room = lightRoom({&one, 1}, 64 << 10, settings);
        const double expected = kAlbedo * power / 24.0;
        // What cannot be shown may be missing, if that is said, and must not be more.
        if (mustWarn) figures.push_back({name + ": light over that of its power", room.mean / expected, 1.03});
        else if (power > 0.0) figures.push_back({name + ": off albedo * power / area, %", percentOff(room.mean, expected), 3.0});
        else figures.push_back({name + ": light, W/m^2", room.mean, 0.0});
        figures.push_back({name + ": not a word of what is missing", mustWarn && !room.warned ? 1.0 : 0.0, 0.0});
    };
    // A spot light's falloff is the square of a ramp: a third of the power of an even one.
    add("cone of 1e-6 rad", makeSpotLight({0, -1, 0}, glm::vec3(1.0f), 0.0f, 1e-6f), 0.25 * kLampPower * 1e-12, true);
    add("cone of 0.1 rad", makeSpotLight({0, -1, 0}, glm::vec3(1.0f), 0.0f, 0.1f), 0.5 * kLampPower * (1.0 - std::cos(0.1)) / 3.0, false);
    add("cone of a half sphere", makeSpotLight({0, -1, 0}, glm::vec3(1.0f), 0.0f, 1.5707963f), 0.5 * kLampPower / 3.0, false);
    add("lamp that is off", makePointLight(glm::vec3(0.0f)), 0.0, false);
    add("lamp of 1e-30 W/sr", makePointLight(glm::vec3(1e-30f)), 1e-30 * kLampPower, false);
    add("lamp of 1e25 W/sr", makePointLight(glm::vec3(1e25f)), 1e25 * kLampPower, false);
    add("lamp of 1e30 W/sr", makePointLight(glm::vec3(1e30f)), 1e30 * kLampPower, true);
    add("lamp of 3e38 W/sr", makePointLight(glm::vec3(3e38f)), 3e38 * kLampPower, true);
    // Its light falls on backs, so the scene is turned around: the walls then face into a solid.
    const std::pair<ClvLight, glm::dvec3> sun{makeDirectionalLight({0, -1, 0}, glm::vec3(1.0f)), glm::dvec3(0.0)};
    const LitRoom outside = lightRoom({&sun, 1}, 64 << 10, settings);
    figures.push_back({"sun outside of a closed room: not a word of it", outside.warned ? 0.0 : 1.0, 0.0});
    figures.push_back({"sun outside of a closed room: light on the walls' inner side, W/m^2", outside.mean});
    // Cones of no width, of the whole sphere and inside out: refused in words.
    double unsaid = 0.0;
    for (const auto& [inner, outer] : {std::pair{0.0f, 0.0f}, {0.0f, 3.14159265f}, {0.0f, 6.2831853f}, {0.5f, 0.4f}, {-0.1f, 0.5f}, {0.0f, std::nanf("")}}) {
        try {
            checkLight(makeSpotLight({0, -1, 0}, glm::vec3(1.0f), inner, outer), "lamp");
            ++unsaid;
        } catch (const InputError&) {
        }
    }
    figures.push_back({"cones that cannot be and are not refused", unsaid, 0.0});
    return figures;
}

// Lamps of 1e-6 and 1e6 W/sr in one room: together they give what the bright one gives, and either alone gives the same light but for
// the factor of 1e12.
std::vector<StressFigure> twoLamps(const StressSettings& settings) {
    const auto meanOf = [&](std::vector<float> intensities) {
        std::vector<std::pair<ClvLight, glm::dvec3>> lamps;
        for (float intensity : intensities) lamps.push_back({makePointLight(glm::vec3(intensity)), lamps.empty() ? glm::dvec3(-0.5, 0.2, 0.1) : glm::dvec3(0.5, 0.4, 0.3)});
        return lightRoom(lamps, 256 << 10, settings).mean;
    };
    const double bright = meanOf({1e6f}), exact = kAlbedo * kLampPower / 24.0;
    return {{"the bright one, off albedo * power / area, %", percentOff(bright, 1e6 * exact), 1.0},
            {"both against the bright one, off by", std::abs(meanOf({1e6f, 1e-6f}) / bright - 1.0), 1e-6},
            {"the dim one in its place, over a 1e-12th of its light, off by", std::abs(meanOf({1e-6f}) / bright * 1e12 - 1.0), 1e-6},
            {"a lamp of a thousandth beside it, both against their power, off by %", percentOff(meanOf({1e6f, 1e3f}), (1e6 + 1e3) * exact), 1.0}};
}

}  // namespace

std::vector<StressCase> brightnessCases() {
    return {{"brightness", "lamps of 1e-6 and 1e6 W/sr in one room", "the sum is that of the bright one, and the dim one alone is not lost", twoLamps},
            {"brightness", "cones and powers at the ends of their range", "walls get the lamp's power over their area, or what is missing is said", lamps}};
}

}  // namespace clv
