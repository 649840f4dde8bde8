// Light that is reflected on and on in closed rooms, where the answer is a series in closed form.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "bindings/cli/stress/whole_run.h"

namespace clv {
namespace {

constexpr double kRoomArea = 24.0;        // m^2, of a room of 2 m
constexpr int kBouncesWithoutLimit = 24;  // that are given where the series has no sum

// A room of 2 m whose surfaces all reflect `albedo`, with a lamp of 1 W/sr in it.
struct ClosedRoom {
    glm::dvec3 albedo;
    glm::dvec3 center{0.0};
    bool hasRug = false;  // 1 mm above the floor, 1.8 m wide; points are not on the floor then
};

struct FurnaceRun {
    std::vector<glm::dvec3> mean;       // W/m^2, over the walls of each room
    std::vector<glm::vec3> irradiance;  // W/m^2, at each point of the walls
    PipelineReport report;
    double raysOfBudget = 0.0;
};

// A wide square. With one the library chooses the resolution.
struct Ground {
    double width = 0.0;     // m; 0: none
    bool isFloor = false;   // of the rooms, which have none of their own; else it lies a metre below them
};

// The walls and the ceiling of a room, seen from inside.
void addRoomWithoutFloor(SceneBuilder& builder, std::uint32_t material, const glm::dvec3& center) {
    for (int axis = 0; axis < 3; ++axis) {
        for (double side : {-1.0, 1.0}) {
            if (axis == 1 && side < 0.0) continue;
            glm::dvec3 out(0.0), x(0.0), y(0.0);
            out[axis] = side, x[(axis + 1) % 3] = side, y[(axis + 2) % 3] = 1.0;
            builder.addQuad(center + out + x - y, center + out - x - y, center + out - x + y, center + out + x + y, material);
        }
    }
}

FurnaceRun lightRooms(std::span<const ClosedRoom> rooms, const StressSettings& settings, const Ground& ground = {}) {
    SceneBuilder builder("furnace");
    std::vector<ReferencePoint> points;
    for (const ClosedRoom& room : rooms) {
        const std::uint32_t material = builder.addMaterial({"wall", glm::vec3(room.albedo), -1});
        builder.beginNode("room");
        if (ground.isFloor) addRoomWithoutFloor(builder, material, room.center);
        else addRoom(builder, material, 1.0, room.center);
        builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), room.center + glm::dvec3(0.2, 0.1, -0.3));
        if (room.hasRug) addBox(builder, room.center - glm::dvec3(0.0, 0.989, 0.0), {0.9, 0.0, 0.0}, {0.0, 0.01, 0.0}, {0.0, 0.0, 0.9}, material);
        for (const ReferencePoint& point : pointsOnWalls(1.0, room.center)) {
            if (!room.hasRug || point.normal.y < 0.5f) points.push_back(point);
        }
    }
    if (ground.width > 0.0) {
        builder.beginNode("ground");
        const double half = 0.5 * ground.width, height = ground.isFloor ? -1.0 : -2.0;
        builder.addQuad({-half, height, half}, {half, height, half}, {half, height, -half}, {-half, height, -half}, 0);
    }
    const Scene scene = std::move(builder).finish("furnace");
    for (ReferencePoint& point : points) point.position -= glm::vec3(scene.anchor);
    LightOptions options = smallRun(settings.exhaustive ? 16 << 20 : 1 << 20, true);
    if (ground.width > 0.0) options.resolution = 0;
    WholeRun run = wholeRun(scene, points, options, settings);
    FurnaceRun furnace{{}, std::move(run.irradiance), std::move(run.report), 0.0};
    furnace.raysOfBudget = double(furnace.report.rays) / double(options.rays);
    const std::size_t count = points.size() / rooms.size();
    for (std::size_t k = 0; k < rooms.size(); ++k) {
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < count; ++i) sum += glm::dvec3(furnace.irradiance[k * count + i]) / double(count);
        furnace.mean.push_back(sum);
    }
    return furnace;
}

// What a closed room receives after `bounces` of them, 0 for all: rho + rho^2 + ... of the power over the area, W/m^2.
double series(double albedo, int bounces = 0) {
    if (bounces == 0) return albedo / (1.0 - albedo) * kLampPower / kRoomArea;
    double sum = 0.0;
    for (int k = 1; k <= bounces; ++k) sum += std::pow(albedo, k);
    return sum * kLampPower / kRoomArea;
}

// How fast it is: bounces of a slow series must take no more rays than those of a fast one.
void addPace(const FurnaceRun& run, std::vector<StressFigure>& figures) {
    figures.push_back({"bounces that are followed", double(run.report.sweeps)});
    figures.push_back({"rays traced, of those allowed", run.raysOfBudget, 1.01});
    figures.push_back({"share of the power from bounce to bounce", run.report.contraction});
}

std::vector<StressFigure> grey(double albedo, const StressSettings& settings) {
    const ClosedRoom room{glm::dvec3(albedo)};
    const FurnaceRun run = lightRooms({&room, 1}, settings);
    std::vector<StressFigure> figures;
    if (albedo < 1.0) {
        figures.push_back({"bias against rho / (1 - rho), %", percentOff(run.mean[0].x, series(albedo)), 1.0});
        addPace(run, figures);
    } else {
        figures.push_back({"off the sum of 24 bounces, %", percentOff(run.mean[0].x, series(albedo, kBouncesWithoutLimit)), 1.0});
        figures.push_back({"bounces given, beside 24", std::abs(double(run.report.sweeps) - kBouncesWithoutLimit), 0.0});
        figures.push_back({"warnings that there is no limit, missing", run.report.warnings.empty() ? 1.0 : 0.0, 0.0});
        figures.push_back({"share of the power from bounce to bounce", run.report.contraction});
    }
    return figures;
}

// Each channel loses light at its own pace.
std::vector<StressFigure> coloured(const StressSettings& settings) {
    const ClosedRoom room{{0.99, 0.9, 0.5}};
    const FurnaceRun run = lightRooms({&room, 1}, settings);
    std::vector<StressFigure> figures;
    for (int c = 0; c < 3; ++c) figures.push_back({fmt::format("bias of the channel of {:g}, %", room.albedo[c]), percentOff(run.mean[0][c], series(room.albedo[c])), 2.0});
    addPace(run, figures);
    return figures;
}

// And so does each room. How much of the light is in which of them is drawn from bounce to bounce, which leaves noise: so the mean of some runs.
std::vector<StressFigure> twoRooms(const StressSettings& settings) {
    const ClosedRoom rooms[] = {{glm::dvec3(0.99), {-1.5, 0.0, 0.0}}, {glm::dvec3(0.9), {1.5, 0.0, 0.0}}};
    constexpr int kRuns = 4;
    std::array<std::array<double, kRuns>, 2> off{};  // %
    std::vector<StressFigure> figures;
    for (int run = 0; run < kRuns; ++run) {
        StressSettings other = settings;
        other.seed = settings.seed * kRuns + std::uint32_t(run);
        const FurnaceRun lit = lightRooms(rooms, other);
        for (std::size_t k = 0; k < 2; ++k) off[k][std::size_t(run)] = 100.0 * (lit.mean[k].x / series(rooms[k].albedo.x) - 1.0);
        if (run == 0) addPace(lit, figures);
    }
    for (std::size_t k = 0; k < 2; ++k) {
        double mean = 0.0, squares = 0.0;
        for (double one : off[k]) mean += one / kRuns;
        for (double one : off[k]) squares += (one - mean) * (one - mean) / (kRuns - 1);
        const double error = std::sqrt(squares / kRuns), albedo = rooms[k].albedo.x;
        figures.push_back({fmt::format("bias of the room of {:g}, %", albedo), std::abs(mean)});
        figures.push_back({fmt::format("bias of the room of {:g} beyond three standard errors, %", albedo), largerOf(0.0, std::abs(mean) - 3.0 * error), 3.0});
        figures.push_back({fmt::format("noise of a run in the room of {:g}, %", albedo), std::sqrt(squares), 5.0});
    }
    return figures;
}

// The gap below it is narrower than cells, which would say that it is as bright as what is above it.
std::vector<StressFigure> withRug(const StressSettings& settings) {
    const ClosedRoom room{glm::dvec3(0.8), glm::dvec3(0.0), true};
    const FurnaceRun run = lightRooms({&room, 1}, settings);
    return {{"off rho / (1 - rho) of the room without it, %", percentOff(run.mean[0].x, series(0.8)), 3.0}};
}

// Standard deviation of one point's irradiance from run to run, of two of them, %.
double noiseOfAPoint(const FurnaceRun& a, const FurnaceRun& b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.irradiance.size(); ++i) squares += std::pow(double(a.irradiance[i].x) - double(b.irradiance[i].x), 2.0);
    return 100.0 * std::sqrt(0.5 * squares / double(a.irradiance.size())) / a.mean[0].x;
}

// Few of evenly spread samples of surfaces are in the room, and it is a few cells wide, or less than one. A few cells cost
// some per cent, as the grid happens to lie: it lies the same for every seed.
std::vector<StressFigure> onWideGround(bool isFloor, const StressSettings& settings) {
    const ClosedRoom room{glm::dvec3(0.95)};
    std::vector<StressFigure> figures;
    for (double width : {60.0, 200.0, 600.0}) {
        StressSettings other = settings;
        other.seed = settings.seed + 1000;
        const FurnaceRun run = lightRooms({&room, 1}, settings, {width, isFloor});
        figures.push_back({fmt::format("bias on a ground of {:g} m, %", width), percentOff(run.mean[0].x, series(0.95)), 5.0});
        figures.push_back({fmt::format("noise of a point on a ground of {:g} m, %", width), noiseOfAPoint(run, lightRooms({&room, 1}, other, {width, isFloor})), 3.0});
    }
    const FurnaceRun lost = lightRooms({&room, 1}, settings, {6000.0, isFloor});
    figures.push_back({"bias on a ground of 6 km, %", percentOff(lost.mean[0].x, series(0.95))});
    const bool isSaid = std::ranges::any_of(lost.report.warnings, [](const std::string& warning) { return warning.find("where the smallest cells are") != std::string::npos; });
    figures.push_back({"warnings that cells are too wide for it, missing", isSaid ? 0.0 : 1.0, 0.0});
    return figures;
}

}  // namespace

std::vector<StressCase> bounceCases() {
    std::vector<StressCase> cases;
    for (double albedo : {0.5, 0.9, 0.99, 0.999, 1.0, 1.1}) {
        const char* claim = albedo < 1.0 ? "all bounces reach the closed form, at the cost of a room that is dark" : "no limit exists: that is said, and the light is that of 24 bounces";
        cases.push_back({"bounces", fmt::format("a closed room of albedo {:g}", albedo), claim, [albedo](const StressSettings& s) { return grey(albedo, s); }});
    }
    cases.push_back({"bounces", "a closed room of albedo 0.99, 0.9 and 0.5", "each channel reaches its own series", coloured});
    cases.push_back({"bounces", "closed rooms of albedo 0.99 and 0.9 in one scene", "each room reaches its own series", twoRooms});
    cases.push_back({"bounces", "a closed room of albedo 0.8 with a rug 1 mm above its floor", "it is as bright as a room without one", withRug});
    for (bool isFloor : {false, true}) {
        cases.push_back({"bounces", fmt::format("a closed room of 2 m {} a ground of 60 m to 6 km", isFloor ? "whose floor is part of" : "on"),
                         "all bounces reach the closed form, or cells are said to be too wide", [isFloor](const StressSettings& s) { return onWideGround(isFloor, s); }});
    }
    return cases;
}

}  // namespace clv
