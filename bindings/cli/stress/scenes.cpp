// Whole runs in scenes that nobody builds on purpose.
#include <cmath>

#include "bindings/cli/pipeline.h"
#include "bindings/cli/stress/stress_case.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"

namespace clv {
namespace {

struct Run {
    std::vector<ReferencePoint> points;
    std::vector<glm::vec3> irradiance;
    PipelineReport report;
    double mean = 0.0, notFinite = 0.0, negative = 0.0;
};

Run light(const Scene& scene, std::vector<ReferencePoint> points, const StressSettings& settings, const LightOptions& options) {
    Run run;
    run.points = std::move(points);
    run.irradiance.resize(run.points.size());
    run.report = lightPoints(scene, options, settings.seed, settings.parallelFor, run.points, run.irradiance);
    for (const glm::vec3& e : run.irradiance) {
        for (int c = 0; c < 3; ++c) run.notFinite += !std::isfinite(e[c]), run.negative += e[c] < 0.0f;
        run.mean += (double(e.x) + double(e.y) + double(e.z)) / (3.0 * double(run.irradiance.size()));
    }
    return run;
}

LightOptions quickOptions(std::uint64_t rays = 64 << 10) {
    LightOptions options;
    options.rays = rays;
    return options;
}

// Points on the triangles, on both sides.
std::vector<ReferencePoint> pointsOn(const Scene& scene) {
    std::vector<ReferencePoint> points;
    for (const glm::uvec3& t : scene.triangles) {
        const glm::vec3 a = scene.positions[t.x], b = scene.positions[t.y], c = scene.positions[t.z], n = glm::normalize(glm::cross(b - a, c - a));
        for (float side : {1.0f, -1.0f}) points.push_back({(a + b + c) / 3.0f, side * n});
        if (points.size() >= 200) break;
    }
    return points;
}

// lit: some of the points see others that are lit.
std::vector<StressFigure> sane(const Run& run, bool lit) {
    // No light where there should be some must at least be said.
    const bool silent = run.mean == 0.0 && run.report.warnings.empty() && lit;
    return {{"values that are not finite", run.notFinite, 0.0}, {"irradiances below 0", run.negative, 0.0}, {"darkness without a word", silent ? 1.0 : 0.0, 0.0}, {"mean irradiance, W/m^2", run.mean}};
}

struct Place {
    std::string name;
    std::function<void(SceneBuilder&, std::uint32_t material)> fill;
    glm::dvec3 lamp{0.0, 2.0, 0.0};
    bool lit = true;  // one surface sees another one
};

void addFloor(SceneBuilder& b, std::uint32_t m, double size = 4.0) {
    b.addQuad({-size, 0, size}, {size, 0, size}, {size, 0, -size}, {-size, 0, -size}, m);
}
void addRoom(SceneBuilder& b, std::uint32_t m, double half = 1.0) {
    BlockGrid grid{{-half, half}, {-half, half}, {-half, half}, [](const glm::ivec3&) { return false; }, true};
    addBlocks(b, grid, [=](const glm::ivec3&, const glm::ivec3&) { return m; });
}

std::vector<Place> places() {
    return {
        {"one triangle", [](SceneBuilder& b, std::uint32_t m) { b.addTriangle(b.addVertex({-1, 0, 1}), b.addVertex({1, 0, 1}), b.addVertex({0, 0, -1}), m); }, {0.0, 2.0, 0.0}, false},
        {"all in one plane", [](SceneBuilder& b, std::uint32_t m) { addFloor(b, m); addFloor(b, m, 2.0); }, {0.0, 2.0, 0.0}, false},
        {"coincident faces, front to back", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m);
             b.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, m);
             b.addQuad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, m);
         }, {0.3, 0.5, 0.2}},
        {"boxes that run through each other", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m);
             for (int k = 0; k < 5; ++k) addBox(b, {0.1 * k - 0.2, -0.6, 0.05 * k}, {0.3, 0.02 * k, 0}, {-0.02 * k, 0.3, 0}, {0, 0, 0.3}, m);
         }, {0.0, 0.5, 0.0}},
        {"a lamp inside a solid", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m, 2.0); addBox(b, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m); }, {0.0, 0.0, 0.0}},
        {"a solid that fills all cells", [](SceneBuilder& b, std::uint32_t m) { addBox(b, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, m); }, {0.0, 3.0, 0.5}, false},
        {"a room within rock, and points inside of a solid in it", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m, 2.0);
             addBox(b, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m);
             addBox(b, {0, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}, m);
         }, {1.0, 1.0, 1.0}},
        {"a lamp on a surface", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m); }, {0.1, -1.0, 0.2}},
        {"a lamp in a corner", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m); }, {1.0, 1.0, 1.0}},
        {"a lamp 1 mm from a wall", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m); }, {0.999, 0.1, 0.2}},
        {"a lamp 1e4 m away", [](SceneBuilder& b, std::uint32_t m) { addFloor(b, m); addBox(b, {0, 1, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m); }, {0.0, 1e4, 0.0}},
        {"a lamp 1e9 m away", [](SceneBuilder& b, std::uint32_t m) { addFloor(b, m); addBox(b, {0, 1, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m); }, {0.0, 1e9, 0.0}},
        {"a room of 1 mm", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m, 0.0005); }, {0.0001, 0.0002, 0.0}},
        {"a room of 100 km", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m, 5e4); }, {100.0, 200.0, 0.0}},
        {"needles of 1 : 1e5", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m);
             for (int k = 0; k < 40; ++k) addBox(b, {0.02 * k - 0.4, 0, 0}, {1e-5, 0, 0}, {0, 0.9, 0}, {0, 0, 1e-5}, m);
         }, {0.5, 0.5, 0.5}},
    };
}

std::vector<StressFigure> runPlace(const Place& place, const StressSettings& settings) {
    SceneBuilder builder(place.name);
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});
    builder.beginNode("all");
    place.fill(builder, grey);
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), place.lamp);
    const Scene scene = std::move(builder).finish(place.name);
    std::vector<StressFigure> figures;
    for (bool all : {false, true}) {
        LightOptions options = quickOptions();
        options.resolution = 16;
        options.allBounces = all;
        for (StressFigure& figure : sane(light(scene, pointsOn(scene), settings, options), place.lit)) {
            figure.name += all ? ", all bounces" : ", one bounce";
            figures.push_back(std::move(figure));
        }
    }
    return figures;
}

// Cones of no and of half the sphere's width, and lamps that are off.
std::vector<StressFigure> lamps(const StressSettings& settings) {
    std::vector<StressFigure> figures;
    const auto add = [&](const std::string& name, const ClvLight& lamp, const glm::dvec3& position) {
        SceneBuilder builder(name);
        const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});
        builder.beginNode("room");
        addRoom(builder, grey);
        builder.addLight("lamp", lamp, position);
        const Scene scene = std::move(builder).finish(name);
        LightOptions options = quickOptions();
        options.resolution = 16;
        const Run run = light(scene, pointsOn(scene), settings, options);
        figures.push_back({name + ": bad values", run.notFinite + run.negative, 0.0});
        // Beyond the floats, light is cut off: that must be said.
        const bool bright = lamp.intensity.x > 1e28f, on = lamp.intensity.x > 0.0f;
        figures.push_back({name + ": darkness or a cut without a word", run.report.warnings.empty() && (bright || (on && run.mean == 0.0)) ? 1.0 : 0.0, 0.0});
    };
    add("cone of 1e-6 rad", makeSpotLight({0, -1, 0}, glm::vec3(1.0f), 0.0f, 1e-6f), {0.1, 0.5, 0.2});
    add("cone of a half sphere", makeSpotLight({0, -1, 0}, glm::vec3(1.0f), 0.0f, 1.5707963f), {0.1, 0.5, 0.2});
    add("lamp that is off", makePointLight(glm::vec3(0.0f)), {0.1, 0.5, 0.2});
    add("lamp of 1e30 W/sr", makePointLight(glm::vec3(1e30f)), {0.1, 0.5, 0.2});
    add("lamp of 1e-30 W/sr", makePointLight(glm::vec3(1e-30f)), {0.1, 0.5, 0.2});
    add("lamp of 3e38 W/sr", makePointLight(glm::vec3(3e38f)), {0.1, 0.5, 0.2});
    add("sun along an axis", makeDirectionalLight({0, -1, 0}, glm::vec3(1.0f)), {0.0, 0.0, 0.0});
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
    const auto meanOf = [&](std::vector<float> intensities, const glm::dvec3& first) {
        SceneBuilder builder("room");
        const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});
        builder.beginNode("room");
        addRoom(builder, grey);
        for (std::size_t k = 0; k < intensities.size(); ++k) {
            builder.addLight("lamp", makePointLight(glm::vec3(intensities[k])), k == 0 ? first : glm::dvec3(0.5, 0.4, 0.3));
        }
        const Scene scene = std::move(builder).finish("room");
        LightOptions options = quickOptions(256 << 10);
        options.resolution = 16;
        return light(scene, pointsOn(scene), settings, options).mean;
    };
    const glm::dvec3 here(-0.5, 0.2, 0.1);
    const double bright = meanOf({1e6f}, here);
    return {{"both against the bright one, off by", std::abs(meanOf({1e6f, 1e-6f}, here) / bright - 1.0), 0.005},
            {"the dim one in its place, over a 1e-12th of its light, off by", std::abs(meanOf({1e-6f}, here) / bright * 1e12 - 1.0), 1e-5}};
}

// A room whose walls face outwards gives the light of one whose walls face inwards, and says what it made of it.
std::vector<StressFigure> insideOut(const StressSettings& settings) {
    const auto room = [](bool outwards) {
        SceneBuilder builder("room");
        const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});
        builder.beginNode("room");
        if (outwards) addBox(builder, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, grey);
        else addRoom(builder, grey);
        builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {0.2, 0.3, 0.1});
        return std::move(builder).finish("room");
    };
    const Scene good = room(false), bad = room(true);
    std::vector<StressFigure> figures;
    for (bool all : {false, true}) {
        LightOptions options = quickOptions(256 << 10);
        options.resolution = 16, options.allBounces = all;
        const double expected = light(good, pointsOn(good), settings, options).mean;
        const Run run = light(bad, pointsOn(good), settings, options);
        figures.push_back({all ? "all bounces, off by" : "one bounce, off by", std::abs(run.mean / expected - 1.0), 0.02});
        figures.push_back({"not a word of it", run.report.warnings.empty() ? 1.0 : 0.0, 0.0});
    }
    return figures;
}

// A closed room whose surfaces all reflect `albedo`: the mean over its area is rho / (1 - rho) of the power over the area.
std::vector<StressFigure> furnace(double albedo, const StressSettings& settings) {
    SceneBuilder builder("furnace");
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(float(albedo)), -1});
    builder.beginNode("room");
    addRoom(builder, grey);
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {0.2, 0.1, -0.3});
    const Scene scene = std::move(builder).finish("furnace");
    // Evenly over the six walls.
    std::vector<ReferencePoint> points;
    constexpr int kSteps = 16;
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < 2 * kSteps * kSteps; ++k) {
            glm::vec3 p(0.0f), n(0.0f);
            const float side = k % 2 == 0 ? -1.0f : 1.0f;
            p[axis] = side, n[axis] = -side;
            p[(axis + 1) % 3] = (float(k / 2 % kSteps) + 0.5f) * 2.0f / kSteps - 1.0f;
            p[(axis + 2) % 3] = (float(k / 2 / kSteps) + 0.5f) * 2.0f / kSteps - 1.0f;
            points.push_back({p, n});
        }
    }
    LightOptions options = quickOptions(settings.exhaustive ? 16 << 20 : 1 << 20);
    options.allBounces = true;
    options.resolution = 16;
    const Run run = light(scene, points, settings, options);
    const StressFigure contraction{"share of the power from bounce to bounce, off the albedo by", std::abs(run.report.contraction - albedo), 0.01};
    if (albedo >= 1.0) {
        return {contraction, {"values that are not finite", run.notFinite, 0.0}, {"warnings that there is no limit, missing", run.report.warnings.empty() ? 1.0 : 0.0, 0.0}, {"bounces traced", double(run.report.sweeps)}, {"mean irradiance, W/m^2", run.mean}};
    }
    const double exact = albedo / (1.0 - albedo) * 4.0 * 3.14159265358979 / 24.0;
    return {contraction, {"bias against rho / (1 - rho), %", 100.0 * std::abs(run.mean / exact - 1.0), 1.0}, {"bounces traced", double(run.report.sweeps), 100.0}, {"values that are not finite", run.notFinite, 0.0}};
}

}  // namespace

std::vector<StressCase> bounceCases() {
    std::vector<StressCase> cases;
    for (double albedo : {0.5, 0.9, 0.99, 0.999, 1.0, 1.1}) {
        char name[64];
        std::snprintf(name, sizeof name, "a closed room of albedo %g", albedo);
        const char* claim = albedo < 1.0 ? "all bounces reach the closed form in at most 100 sweeps" : "no limit exists: the sum stays finite, and that is said";
        cases.push_back({"bounces", name, claim, [albedo](const StressSettings& s) { return furnace(albedo, s); }});
    }
    return cases;
}

std::vector<StressCase> brightnessCases() {
    return {{"brightness", "lamps of 1e-6 and 1e6 W/sr in one room", "the sum is that of the bright one, and the dim one alone is not lost", twoLamps},
            {"brightness", "cones and powers at the ends of their range", "what is read is finite and not negative", lamps}};
}

std::vector<StressCase> sceneCases() {
    std::vector<StressCase> cases = {{"scene", "a room inside out", "its light is that of the room the right way round, and that is said", insideOut}};
    for (const Place& place : places()) {
        cases.push_back({"scene", place.name, "irradiance is finite and not negative", [place](const StressSettings& s) { return runPlace(place, s); }});
    }
    return cases;
}

}  // namespace clv
