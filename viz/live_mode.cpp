#include "viz/live_mode.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace clv {
namespace {

constexpr float kTimestep = 1.0f / 30.0f;  // s that a frame stands for
constexpr float kReach = 0.05f;            // of the scene's longest side: how near a lamp the mouse takes hold of it
constexpr const char* kStorageNames[] = {"cube", "cube9", "sh1", "sh2"};

}  // namespace

LiveMode::LiveMode(Pane& pane, const LiveOptions& options, std::function<Camera()> viewCamera, const ParallelFor& parallelFor)
    : pane_(pane), options_(options), viewCamera_(std::move(viewCamera)), parallelFor_(parallelFor) {
    if (!pane.world()) throw InputError("--live: expected the scene of the volume; name it with --scene");
    putLamps();
    const Scene& scene = pane.world()->scene();
    camera_ = pane.volume().camera.value_or(scene.cameras.empty() ? Camera{.name = "", .position = scene.bounds.center()} : scene.cameras.front());
    if (!options.motion.empty()) motion_ = loadMotion(options.motion, scene), still_ = scene;
}

// Where the options say.
void LiveMode::putLamps() {
    std::vector<NamedLight> lights = pane_.world()->scene().lights;
    for (const LampPlace& lamp : options_.lamps) {
        const auto found = std::ranges::find(lights, lamp.name, &NamedLight::name);
        if (found == lights.end()) {
            std::vector<std::string> names;
            for (const NamedLight& light : lights) names.push_back(light.name);
            throw InputError(fmt::format("--lamp {}: expected one of the scene's lights: {}", lamp.name, fmt::join(names, ", ")));
        }
        found->light.position = vec3(lamp.position - pane_.world()->scene().anchor);
    }
    pane_.setLights(lights);
}

// What moves by itself, to where it is in this frame.
void LiveMode::move() {
    if (motion_) {
        std::vector<NamedLight> lights = pane_.world()->scene().lights;
        const std::vector<NamedLight> moved = lightsAt(*motion_, *still_, frames_);
        for (const LightMotion& light : motion_->lights) lights[light.light] = moved[light.light];
        pane_.setLights(lights);
    }
    if (options_.follow) {
        camera_ = viewCamera_();
    } else if (motion_) {
        camera_ = cameraAt(*motion_, *still_, camera_, frames_);
    }
    ++frames_;
}

void LiveMode::addSliders(vtkRenderWindowInteractor& interactor) {
    const auto add = [&](const std::string& title, double lo, double hi, double value, std::function<void(double)> change, std::function<std::string(double)> show) {
        sliders_.push_back(std::make_unique<Slider>(interactor, sliderInColumn(int(sliders_.size())), title, lo, hi, value, std::move(change), std::move(show)));
    };
    const auto power = [](double exponent) { return std::uint64_t(std::lround(std::exp2(exponent))); };
    add("rays a frame", 10, 19, std::log2(double(options_.settings.rays)), [=, this](double v) { options_.settings.rays = power(v); }, [=](double v) { return std::to_string(power(v)); });
    add("cells a side", 8, 64, options_.settings.resolution, [this](double v) { options_.settings.resolution = int(v); }, [](double v) { return std::to_string(int(v)); });
    const auto cascades = [](double v) { return v < 1.0 ? std::string("none") : std::to_string(int(v)); };
    add("cascades", 0, 4.99, options_.settings.cascades, [this](double v) { options_.settings.cascades = std::min(4, int(v)); }, cascades);
    const auto storage = [](double v) { return uint(std::clamp(v, 0.0, 3.0)); };
    add("storage", 0, 3.99, options_.settings.storage, [=, this](double v) { options_.settings.storage = storage(v); }, [=](double v) { return kStorageNames[storage(v)]; });
    const auto seconds = [](double exponent) { return std::pow(10.0, exponent); };
    const auto say = [=](double v) { return fmt::format("{:.2f} s", seconds(v)); };
    add("history of still light", -1, 2, std::log10(options_.settings.historyTime), [=, this](double v) { options_.settings.historyTime = seconds(v); }, say);
    add("history of moving light", -2, 0, std::log10(options_.settings.movingTime), [=, this](double v) { options_.settings.movingTime = seconds(v); }, say);
}

void LiveMode::frame() {
    move();
    if (!light_ || !(options_.settings == used_)) {
        used_ = options_.settings;
        light_ = std::make_unique<LiveLight>(*pane_.world(), used_, camera_, parallelFor_);
    }
    light_->frame(motion_ ? float(1.0 / motion_->fps) : kTimestep, camera_, pane_.volume());
}

std::string LiveMode::times() const {
    std::string text;
    double sum = 0.0;
    for (const auto& [name, seconds] : light_->stages()) {
        text += fmt::format(" {} {:.1f}", name, 1e3 * seconds);
        sum += seconds;
    }
    return fmt::format("live, frame {}, {:.1f} ms:{}", pane_.volume().frame, 1e3 * sum, text);
}

bool LiveMode::grabLight(const Sight& sight) {
    const vec3 extent = pane_.world()->scene().bounds.extent();
    float nearest = kReach * std::max({extent.x, extent.y, extent.z});
    const std::vector<NamedLight>& lights = pane_.world()->scene().lights;
    for (std::size_t k = 0; k < lights.size(); ++k) {
        if (lights[k].light.type == kClvLightDirectional) continue;
        const float distance = glm::length(cross(lights[k].light.position - sight.origin, sight.direction));
        if (distance < nearest) nearest = distance, grabbed_ = k;
    }
    // From now on it is the mouse that moves it.
    if (grabbed_ && motion_) std::erase_if(motion_->lights, [this](const LightMotion& light) { return light.light == *grabbed_; });
    return grabbed_.has_value();
}

void LiveMode::dragLight(const vec3& screenNormal, const Sight& sight) {
    std::vector<NamedLight> lights = pane_.world()->scene().lights;
    ClvLight& light = lights[*grabbed_].light;
    light.position = draggedPosition(light.position, screenNormal, sight);
    light.dynamicity = 1.0f;
    pane_.setLights(lights);
}

void LiveMode::dropLight() {
    std::vector<NamedLight> lights = pane_.world()->scene().lights;
    lights[*grabbed_].light.dynamicity = 0.0f;
    pane_.setLights(lights);
    grabbed_.reset();
}

}  // namespace clv
