#include "viz/pane.h"

#include <algorithm>

namespace clv {

Pane::Pane(const std::string& file, const std::string& scene, std::size_t frame, const ParallelFor& parallelFor)
    : file_(file), series_(file), volume_(series_.load(frame, parallelFor)) {
    try {
        world_.emplace(volume_, scene);
    } catch (const InputError&) {
        if (!scene.empty()) throw;
    }
}

Pane::Pane(const std::string& scene) : file_(scene) {
    const Scene loaded = loadScene(scene);
    volume_.scene = scene;
    volume_.mark = markOf(loaded);
    volume_.anchor = loaded.anchor;
    volume_.lights = loaded.lights;
    if (!loaded.cameras.empty()) volume_.camera = loaded.cameras.front();
    world_.emplace(volume_, scene);
}

void Pane::setLights(const std::vector<NamedLight>& lights) {
    volume_.lights = lights;
    if (world_) world_->setLights(lights);
}

void Pane::loadFrame(std::size_t frame, const ParallelFor& parallelFor) {
    volume_ = series_.load(std::min(frame, series_.frames() - 1), parallelFor);
    if (world_) world_->setLights(volume_.lights);
}

}  // namespace clv
