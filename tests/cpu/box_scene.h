// A scene of boxes whose rays are cut in closed form: geometry for tests that need no ray tracer.
#ifndef CLV_TESTS_CPU_BOX_SCENE_H
#define CLV_TESTS_CPU_BOX_SCENE_H
#include <algorithm>
#include <span>
#include <vector>

#include "clv/cpu/scene_probe.h"
#include "clv/data/ray.h"

namespace clv::test {

struct Box {
    vec3 center;               // m
    vec3 half;                 // m, half of its extents along its own axes
    bool room = false;         // true: its faces show inwards, and it is solid outside
    glm::mat3 axes{1.0f};      // columns: its axes, unit length
};

// Turned about the vertical axis, rad.
inline glm::mat3 turned(float angle) {
    return {{std::cos(angle), 0.0f, -std::sin(angle)}, {0.0f, 1.0f, 0.0f}, {std::sin(angle), 0.0f, std::cos(angle)}};
}

struct BoxScene {
    std::vector<Box> boxes;

    // Calls meet(distance, front, normal) for every face that the line crosses at a distance in (0, maxDistance).
    template <class Meet>
    void crossings(const vec3& origin, const vec3& direction, float maxDistance, Meet&& meet) const {
        for (const Box& box : boxes) {
            const vec3 from = (origin - box.center) * box.axes, along = direction * box.axes;
            float enter = -1e30f, leave = 1e30f;
            vec3 enterNormal(0.0f), leaveNormal(0.0f);
            bool missed = false;
            for (int axis = 0; axis < 3; ++axis) {
                if (std::abs(along[axis]) < 1e-12f) {
                    missed = missed || std::abs(from[axis]) > box.half[axis];
                    continue;
                }
                const float side = along[axis] > 0.0f ? 1.0f : -1.0f;
                const float in = (-side * box.half[axis] - from[axis]) / along[axis], out = (side * box.half[axis] - from[axis]) / along[axis];
                if (in > enter) enter = in, enterNormal = -side * box.axes[axis];
                if (out < leave) leave = out, leaveNormal = side * box.axes[axis];
            }
            if (missed || enter > leave) continue;
            const float outwards = box.room ? -1.0f : 1.0f;
            if (enter > 0.0f && enter < maxDistance) meet(enter, !box.room, enterNormal * outwards);
            if (leave > 0.0f && leave < maxDistance) meet(leave, box.room, leaveNormal * outwards);
        }
    }

    SceneProbe probe() const {
        SceneProbe probe;
        probe.lineHits = [this](const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits) {
            hits.clear();
            crossings(origin, direction, maxDistance, [&](float t, bool front, const vec3& normal) { hits.push_back({t, front, normal}); });
            std::sort(hits.begin(), hits.end(), [](const LineHit& a, const LineHit& b) { return a.distance < b.distance; });
        };
        probe.occluded = [this](const vec3& from, const vec3& to) {
            const float distance = glm::length(to - from);
            bool met = false;
            crossings(from, (to - from) / distance, distance, [&](float, bool, const vec3&) { met = true; });
            return met;
        };
        return probe;
    }

    void trace(std::span<ClvRay> rays) const {
        for (ClvRay& ray : rays) {
            crossings(ray.origin, ray.direction, ray.maxDistance, [&](float t, bool, const vec3&) { ray.maxDistance = std::min(ray.maxDistance, t); });
        }
    }
};

// A hall of 20 x 6 x 14 m around the origin, with a thin wall, a pillar and a block that is turned against the axes.
inline BoxScene hall() {
    return {{{vec3(0.0f, 0.0f, 0.0f), vec3(10.03f, 3.02f, 7.01f), true},
             {vec3(1.37f, -0.6f, -2.3f), vec3(0.04f, 2.42f, 4.71f)},
             {vec3(-4.21f, 0.0f, 2.13f), vec3(0.33f, 3.02f, 0.37f)},
             {vec3(4.7f, -2.1f, 2.9f), vec3(1.1f, 0.92f, 0.7f), false, turned(0.5f)}}};
}

}  // namespace clv::test
#endif
