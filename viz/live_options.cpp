// The options of live mode: what its sliders and the mouse do.
#include <map>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include "bindings/cli/options.h"
#include "clv/data/cascades.h"
#include "viz/options.h"

namespace clv {
namespace {

constexpr int kLeastResolution = 8, kMostResolution = 256, kMostFrames = 1000000, kMostCascades = int(kClvMaxCascades);
constexpr double kMostTime = 1e6;  // s

LampPlace lampOf(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    LampPlace lamp{text.substr(0, equals), {}};
    char rest = 0;
    if (equals == std::string::npos || std::sscanf(text.c_str() + equals, "=%lf,%lf,%lf%c", &lamp.position.x, &lamp.position.y, &lamp.position.z, &rest) != 3 ||
        !std::isfinite(glm::length(lamp.position)))
        throw InputError(fmt::format("--lamp: expected a light and its place, NAME=x,y,z, found \"{}\"", text));
    return lamp;
}

}  // namespace

void addLiveOptions(CLI::App& app, LiveOptions& options) {
    LiveSettings& settings = options.settings;
    auto* live = app.add_flag("--live", options.on, "Compute the light of the scene here, frame by frame; needs no file with --scene");
    const auto group = [live](CLI::Option* option) { return option->needs(live)->group("Live light"); };
    live->group("Live light");
    group(app.add_option("--live-frames", options.frames, "Frames before the first picture"))->check(CLI::Range(1, kMostFrames))->capture_default_str();
    group(addCountOption(app, "--live-rays", settings.rays, "Rays a frame"))->default_str("16k");
    group(app.add_option("--live-resolution", settings.resolution, "Cells along the scene's longest side; with cascades, of each"))
        ->check(CLI::Range(kLeastResolution, kMostResolution))
        ->capture_default_str();
    group(app.add_option("--live-cascades", settings.cascades, "Nested grids around a camera, the coarsest wide enough for the scene; 0: one grid over the scene"))
        ->check(CLI::Range(0, kMostCascades))
        ->capture_default_str();
    group(app.add_flag("--follow", options.follow, "The cascades follow the view, in place of the volume's or scene's first camera"));
    static const std::map<std::string, uint> kStorages = {{"cube", kClvStorageCube}, {"cube9", kClvStorageCube9}, {"sh1", kClvStorageSh1}, {"sh2", kClvStorageSh2}};
    group(app.add_option_function<std::string>("--live-storage", [&settings](const std::string& name) { settings.storage = kStorages.at(name); }, "What a cell stores"))
        ->check(CLI::IsMember(kStorages))
        ->default_str("cube9");
    const CLI::Validator time = finiteNumber(0.0, kMostTime, fmt::format("a time above 0 and at most {:.0f} s", kMostTime));
    group(app.add_option("--still-time", settings.historyTime, "Time that still light is averaged over, s"))->check(time)->capture_default_str();
    group(app.add_option("--moving-time", settings.movingTime, "The same where a light moves"))->check(time)->capture_default_str();
    group(app.add_option_function<std::vector<std::string>>(
              "--lamp",
              [&options](const std::vector<std::string>& places) {
                  for (const std::string& place : places) options.lamps.push_back(lampOf(place));
              },
              "Put lights elsewhere: NAME=x,y,z (m)"))
        ->take_all();
    group(app.add_option("--motion", options.motion, "A JSON file of lights and a camera that move, as for clv bake"));
}

}  // namespace clv
