#include "viz/live_mode.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace clv {
namespace {

constexpr float kTimestep = 1.0f / 30.0f;  // s that a frame stands for
constexpr float kReach = 0.05f;            // of the scene's longest side: how near a lamp the mouse takes hold of it
constexpr const char* kStorageNames[] = {"cube", "cube9", "sh1", "sh2"};

}  // namespace

LiveMode::LiveMode(Pane& pane, const ParallelFor& parallelFor) : pane_(pane), parallelFor_(parallelFor) {}

void LiveMode::addSliders(vtkRenderWindowInteractor& interactor) {
    const auto add = [&](const std::string& title, double lo, double hi, double value, std::function<void(double)> change, std::function<std::string(double)> show) {
        sliders_.push_back(std::make_unique<Slider>(interactor, int(sliders_.size()), title, lo, hi, value, std::move(change), std::move(show)));
    };
    const auto power = [](double exponent) { return std::size_t(std::lround(std::exp2(exponent))); };
    add("rays a frame", 10, 19, std::log2(double(settings_.rays)), [=, this](double v) { settings_.rays = power(v); }, [=](double v) { return std::to_string(power(v)); });
    add("cells a side", 8, 64, settings_.resolution, [this](double v) { settings_.resolution = int(v); }, [](double v) { return std::to_string(int(v)); });
    const auto storage = [](double v) { return uint(std::clamp(v, 0.0, 3.0)); };
    add("storage", 0, 3.99, settings_.storage, [=, this](double v) { settings_.storage = storage(v); }, [=](double v) { return kStorageNames[storage(v)]; });
    const auto seconds = [](double exponent) { return float(std::pow(10.0, exponent)); };
    const auto say = [=](double v) { return fmt::format("{:.2f} s", seconds(v)); };
    add("history of still light", -1, 2, std::log10(settings_.historyTime), [=, this](double v) { settings_.historyTime = seconds(v); }, say);
    add("history of moving light", -2, 0, std::log10(settings_.movingTime), [=, this](double v) { settings_.movingTime = seconds(v); }, say);
}

void LiveMode::frame() {
    if (!light_ || !(settings_ == used_)) {
        used_ = settings_;
        light_ = std::make_unique<LiveLight>(*pane_.world(), settings_, parallelFor_);
    }
    light_->frame(kTimestep, pane_.volume());
}

std::string LiveMode::times() const {
    std::string text = "live, ms:";
    for (const auto& [name, seconds] : light_->stages()) text += fmt::format(" {} {:.1f}", name, 1e3 * seconds);
    return text;
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
