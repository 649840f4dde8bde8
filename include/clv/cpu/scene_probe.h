// How the core asks the host's ray tracer about the scene's geometry.
#ifndef CLV_CPU_SCENE_PROBE_H
#define CLV_CPU_SCENE_PROBE_H
#include <functional>
#include <vector>

#include "../lang.h"

namespace clv {

// A crossing of a line with a surface.
struct LineHit {
    float distance;  // m along the line
    bool front;      // the line meets the front face (counter-clockwise) there
    vec3 normal;     // unit length, geometric (right-hand rule)
};

struct SceneProbe {
    // Every crossing along origin + t * direction (unit length), t in (0, maxDistance), sorted by distance; clears `hits` first.
    std::function<void(const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits)> lineHits;
    // Whether a surface lies between two positions.
    std::function<bool(const vec3& from, const vec3& to)> occluded;
    // Whether what backs enclose is the inside of something solid, which holds no light; otherwise surfaces are sheets, with open space on both sides,
    // which takes more memory and blurs more around thin walls.
    bool solids = true;
};

}  // namespace clv
#endif
