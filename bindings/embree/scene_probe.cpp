#include "bindings/embree/embree_scene.h"

namespace clv {

SceneProbe EmbreeScene::probe() const {
    SceneProbe probe;
    probe.lineHits = [this](const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits) {
        lineHits(origin, direction, maxDistance, hits);
    };
    probe.occluded = [this](const vec3& from, const vec3& to) {
        vec3 d = to - from;
        float distance = glm::length(d);
        return distance > 0.0f && occluded(from, d / distance, distance);
    };
    probe.solids = solids_;
    return probe;
}

}  // namespace clv
