// One of the volumes side by side: its frames and its scene.
#pragma once
#include <optional>
#include <string>

#include "viz/series.h"
#include "viz/world.h"

namespace clv {

class Pane {
public:
    // `scene` in place of the one that the volume names, unless empty. A scene that is not there is left out: views that need it
    // say so. Throws InputError for a damaged file.
    Pane(const std::string& file, const std::string& scene, std::size_t frame, const ParallelFor& parallelFor);
    // The scene alone: its volume has no cascades until light is computed. Throws InputError.
    explicit Pane(const std::string& scene);

    const BakedVolume& volume() const { return volume_; }
    BakedVolume& volume() { return volume_; }
    void setLights(const std::vector<NamedLight>& lights);
    // Null where there is no scene.
    const World* world() const { return world_ ? &*world_ : nullptr; }
    const Series& series() const { return series_; }
    const std::string& file() const { return file_; }

    void loadFrame(std::size_t frame, const ParallelFor& parallelFor);

private:
    std::string file_;
    Series series_;
    BakedVolume volume_;
    std::optional<World> world_;
};

}  // namespace clv
