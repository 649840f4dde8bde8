// What live light is computed with: sliders and options change it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "clv/data/cell.h"

namespace clv {

struct LiveSettings {
    int resolution = 24;             // cells along the scene's longest side; with cascades, of each
    int cascades = 0;                // that follow a camera; 0: one volume over the scene
    std::uint64_t rays = 16 << 10;   // a frame
    uint storage = kClvStorageCube9;
    double historyTime = 2.0;        // s, > 0: that still light is averaged over
    double movingTime = 0.05;        // s, > 0: the same where a light moves

    bool operator==(const LiveSettings&) const = default;
};

// A lamp put elsewhere.
struct LampPlace {
    std::string name;
    glm::dvec3 position;  // m, world space
};

struct LiveOptions {
    bool on = false;
    LiveSettings settings;
    int frames = 8;                 // before anything is shown
    std::vector<LampPlace> lamps;
    std::string motion;             // file of lights and a camera that move, or empty
    bool follow = false;            // the cascades follow the view, in place of the volume's camera
};

}  // namespace clv
