// Whole runs in scenes that nobody builds on purpose.
#include <algorithm>
#include <cmath>

#include "bindings/cli/stress/walk_rays.h"
#include "bindings/cli/stress/whole_run.h"

namespace clv {
namespace {

// On the triangles, on both sides.
std::vector<ReferencePoint> pointsOn(const Scene& scene) {
    std::vector<ReferencePoint> points;
    for (const glm::uvec3& t : scene.triangles) {
        const glm::vec3 a = scene.positions[t.x], b = scene.positions[t.y], c = scene.positions[t.z], n = glm::normalize(glm::cross(b - a, c - a));
        for (float side : {1.0f, -1.0f}) points.push_back({(a + b + c) / 3.0f, side * n});
        if (points.size() >= 200) break;
    }
    return points;
}

// Whether a point faces the open or the inside of a solid: there it sees backs of surfaces only. Between solids that run into each other
// it may see both.
enum class Side { kOpen, kSolid, kBoth };
Side sideOf(const EmbreeScene& embree, const ReferencePoint& point) {
    Random random(1);
    std::vector<LineHit> hits;
    int met = 0, backs = 0;
    for (int k = 0; k < 64; ++k) {
        glm::vec3 direction = anyDirection(random);
        if (glm::dot(direction, point.normal) < 0.0f) direction = -direction;
        embree.lineHits(point.position + embree.surfaceOffset() * point.normal, direction, kClvFar, hits);
        if (!hits.empty()) ++met, backs += !hits[0].front;
    }
    return backs == 0 ? Side::kOpen : backs == met ? Side::kSolid : Side::kBoth;
}

// What is known of the light in a place.
enum class Truth {
    kDark,         // no surface sees another one
    kClosedForm,   // a closed room without anything in it
    kPathTraced,   // where no bright spot is so small that paths miss it
};

struct Place {
    std::string name;
    std::function<void(SceneBuilder&, std::uint32_t material)> fill;
    glm::dvec3 lamp{0.0, 2.0, 0.0};
    Truth truth = Truth::kPathTraced;
    double half = 1.0;         // m, of a room of closed form
    double lampShare = 1.0;    // of the lamp's light, that shines into it
    bool litInside = false;    // the lamp shines in a solid: there is the light, and the scene is turned around
};

void addFloor(SceneBuilder& b, std::uint32_t m, double size = 4.0) {
    b.addQuad({-size, 0, size}, {size, 0, size}, {size, 0, -size}, {-size, 0, -size}, m);
}

std::vector<Place> places() {
    return {
        {"one triangle", [](SceneBuilder& b, std::uint32_t m) { b.addTriangle(b.addVertex({-1, 0, 1}), b.addVertex({1, 0, 1}), b.addVertex({0, 0, -1}), m); }, {0.0, 2.0, 0.0}, Truth::kDark},
        {"all in one plane", [](SceneBuilder& b, std::uint32_t m) { addFloor(b, m); addFloor(b, m, 2.0); }, {0.0, 2.0, 0.0}, Truth::kDark},
        {"coincident faces, front to back", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m);
             b.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, m);
             b.addQuad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, m);
         }, {0.3, 0.5, 0.2}},
        {"boxes that run through each other", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m);
             for (int k = 0; k < 5; ++k) addBox(b, {0.1 * k - 0.2, -0.6, 0.05 * k}, {0.3, 0.02 * k, 0}, {-0.02 * k, 0.3, 0}, {0, 0, 0.3}, m);
         }, {0.0, 0.5, 0.0}},
        {"a lamp inside a solid", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m, 2.0); addBox(b, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m); }, {0.0, 0.0, 0.0}, Truth::kPathTraced, 1.0, 1.0, true},
        {"a solid that fills all cells", [](SceneBuilder& b, std::uint32_t m) { addBox(b, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, m); }, {0.0, 3.0, 0.5}, Truth::kDark},
        {"a room within rock, and points inside of a solid in it", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m, 2.0);
             addBox(b, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m);
             addBox(b, {0, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}, m);
         }, {1.0, 1.0, 1.0}},
        {"a lamp on a surface", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m); }, {0.1, -1.0, 0.2}, Truth::kClosedForm, 1.0, 0.5},
        {"a lamp in a corner", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m); }, {1.0, 1.0, 1.0}, Truth::kClosedForm, 1.0, 0.125},
        {"a lamp 1 mm from a wall", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m); }, {0.999, 0.1, 0.2}, Truth::kClosedForm},
        {"a lamp 1e4 m away", [](SceneBuilder& b, std::uint32_t m) { addFloor(b, m); addBox(b, {0, 1, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m); }, {0.0, 1e4, 0.0}},
        {"a lamp 1e9 m away", [](SceneBuilder& b, std::uint32_t m) { addFloor(b, m); addBox(b, {0, 1, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m); }, {0.0, 1e9, 0.0}},
        {"a room of 1 mm", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m, 0.0005); }, {0.0001, 0.0002, 0.0}, Truth::kClosedForm, 0.0005},
        {"a room of 100 km", [](SceneBuilder& b, std::uint32_t m) { addRoom(b, m, 5e4); }, {100.0, 200.0, 0.0}, Truth::kClosedForm, 5e4},
        {"needles of 1 : 1e5", [](SceneBuilder& b, std::uint32_t m) {
             addRoom(b, m);
             for (int k = 0; k < 40; ++k) addBox(b, {0.02 * k - 0.4, 0, 0}, {1e-5, 0, 0}, {0, 0.9, 0}, {0, 0, 1e-5}, m);
         }, {0.5, 0.5, 0.5}},
    };
}

// A closed room with walls of kAlbedo: the mean over them is known.
void compareWithClosedForm(const Place& place, const Scene& scene, const LightOptions& options, const StressSettings& settings, const std::string& of, std::vector<StressFigure>& figures) {
    const WholeRun run = wholeRun(scene, pointsOnWalls(place.half, -scene.anchor), options, settings);
    const double exact = kAlbedo / (options.allBounces ? 1.0 - kAlbedo : 1.0) * place.lampShare * kLampPower / (24.0 * place.half * place.half);
    figures.push_back({"mean off the closed form, %" + of, percentOff(meanOf(run.irradiance), exact), 2.0});
}

// Points in the open, beside path tracing; those in solids are only stated.
void compareWithPaths(const Place& place, const Scene& scene, const LightOptions& options, const StressSettings& settings, const std::string& of, std::vector<StressFigure>& figures) {
    const EmbreeScene embree(scene);
    const std::vector<ReferencePoint> points = pointsOn(scene);
    const std::vector<glm::vec3> irradiance = wholeRun(scene, points, options, settings).irradiance;
    std::vector<ReferenceResult> truth(points.size());
    referenceIrradiance(embree, points, {.allBounces = options.allBounces, .samplesPerPoint = 2048, .seed = settings.seed}, settings.parallelFor, truth);
    double compared = 0.0, mean = 0.0, expected = 0.0, variance = 0.0, brightest = 0.0, worst = 0.0, inSolids = 0.0, solids = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double e = double(irradiance[k].x), exact = double(truth[k].irradiance.x), error = double(truth[k].standardError.x);  // all is grey
        const Side side = sideOf(embree, points[k]);
        if (side == (place.litInside ? Side::kSolid : Side::kOpen)) {
            ++compared, mean += e, expected += exact, variance += error * error;
            brightest = std::max(brightest, exact), worst = largerOf(worst, std::abs(e - exact) - 3.0 * error);
        } else if (side != Side::kBoth) {
            ++solids, inSolids += e;
        }
    }
    figures.push_back({"points" + of, compared});
    if (place.truth == Truth::kDark) {
        figures.push_back({"light where there is none, W/m^2" + of, largerOf(mean, expected), 0.0});
    } else {
        figures.push_back({"mean off that of path tracing, %" + of, largerOf(0.0, percentOff(mean, expected) - 300.0 * std::sqrt(variance) / expected), 4.0});
        figures.push_back({"a point off it, % of the brightest" + of, 100.0 * worst / brightest, 25.0});
    }
    if (solids > 0.0) figures.push_back({"mean on the other side, W/m^2" + of, inSolids / solids});
}

std::vector<StressFigure> runPlace(const Place& place, const StressSettings& settings) {
    SceneBuilder builder(place.name);
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(float(kAlbedo)), -1});
    builder.beginNode("all");
    place.fill(builder, grey);
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), place.lamp);
    const Scene scene = std::move(builder).finish(place.name);
    std::vector<StressFigure> figures;
    for (bool all : {false, true}) {
        const auto compare = place.truth == Truth::kClosedForm ? compareWithClosedForm : compareWithPaths;
        compare(place, scene, smallRun(place.truth == Truth::kClosedForm ? 64 << 10 : 256 << 10, all), settings, all ? ", all bounces" : ", one bounce", figures);
    }
    return figures;
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
        const LightOptions options = smallRun(64 << 10, all);
        const std::vector<ReferencePoint> points = pointsOnWalls();
        const double expected = meanOf(wholeRun(good, points, options, settings).irradiance);
        const WholeRun run = wholeRun(bad, points, options, settings);
        figures.push_back({all ? "all bounces, off by" : "one bounce, off by", std::abs(meanOf(run.irradiance) / expected - 1.0), 0.005});
        figures.push_back({"not a word of it", run.report.warnings.empty() ? 1.0 : 0.0, 0.0});
    }
    return figures;
}

}  // namespace

std::vector<StressCase> sceneCases() {
    std::vector<StressCase> cases = {{"scene", "a room inside out", "its light is that of the room the right way round, and that is said", insideOut}};
    for (const Place& place : places()) {
        const char* claim = place.truth == Truth::kDark ? "no light is where there can be none" : "the light is that of the closed form, or of path tracing";
        cases.push_back({"scene", place.name, claim, [place](const StressSettings& s) { return runPlace(place, s); }});
    }
    return cases;
}

}  // namespace clv
