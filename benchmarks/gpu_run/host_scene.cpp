#include "benchmarks/gpu_run/host_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "clv/stages/surface.h"
#include "clv/stages/trace_bvh.h"

namespace clv {
namespace {

struct SceneReader {
    const StoredScene& scene;

    vec4 clvReadBvhBoxes(uint row) const { return scene.boxes[row]; }
    uvec4 clvReadBvhChildren(uint node) const { return scene.children[node]; }
    vec4 clvReadTriangle(uint row) const { return scene.triangles[row]; }
    vec4 clvReadSurface(uint row) const { return scene.surfaces[row]; }
};

// Calls visit(triangle, hit) for every triangle of the tree that the line meets within maxDistance, in no order.
template <class Visit>
void forHits(const SceneReader& reader, const vec3& origin, const vec3& direction, float maxDistance, Visit&& visit) {
    const vec3 inverse(clvInverseOfComponent(direction.x), clvInverseOfComponent(direction.y), clvInverseOfComponent(direction.z));
    const uvec3 backward(inverse.x < 0.0f, inverse.y < 0.0f, inverse.z < 0.0f);
    uint stack[kClvBvhStack] = {0u};
    for (uint waiting = 1; waiting > 0;) {
        const uint node = stack[--waiting];
        const ClvBoxSpans spans = clvSpansInBoxes(reader, node, origin, inverse, backward);
        const uvec4 children = reader.clvReadBvhChildren(node);
        for (int k = 0; k < 4; ++k) {
            if (!(spans.enter[k] <= spans.leave[k] && spans.enter[k] < maxDistance)) continue;
            if (!(children[k] & kClvBvhLeafBit)) {
                stack[waiting++] = children[k];
                continue;
            }
            for (uint i = 0; i < clvBvhLeafCount(children[k]); ++i) {
                const uint triangle = clvBvhLeafFirst(children[k]) + i;
                const ClvBvhHit hit = clvMeetTriangle(reader, triangle, origin, direction, {maxDistance, kClvNoPrimitive, 0.0f, 0.0f});
                if (hit.primitive != kClvNoPrimitive) visit(triangle, hit);
            }
        }
    }
}

}  // namespace

SceneProbe probeOf(const StoredScene& scene) {
    SceneProbe probe;
    probe.lineHits = [reader = SceneReader{scene}](const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits) {
        hits.clear();
        forHits(reader, origin, direction, maxDistance, [&](uint triangle, const ClvBvhHit& hit) {
            const vec3 edge1(reader.clvReadTriangle(triangle * kClvTriangleRows + 1)), edge2(reader.clvReadTriangle(triangle * kClvTriangleRows + 2));
            const vec3 normal = normalize(cross(edge1, edge2));
            hits.push_back({hit.distance, dot(normal, direction) < 0.0f, normal});
        });
        std::sort(hits.begin(), hits.end(), [](const LineHit& a, const LineHit& b) { return a.distance < b.distance; });
    };
    probe.occluded = [reader = SceneReader{scene}](const vec3& from, const vec3& to) {
        const float distance = length(to - from);
        return distance > 0.0f && clvTraceBvh(reader, from, (to - from) / distance, distance).primitive != kClvNoPrimitive;
    };
    return probe;
}

std::vector<ClvReceiver> visibleReceivers(const StoredScene& scene, std::uint32_t width, std::uint32_t height, const ParallelFor& parallelFor) {
    const SceneReader reader{scene};
    const StoredCamera& camera = scene.camera;
    const float up = std::tan(0.5f * camera.yfov), right = up * float(width) / float(height);
    std::vector<std::vector<ClvReceiver>> rows(height);
    parallelFor(height, [&](std::size_t y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const float u = 2.0f * (float(x) + 0.5f) / float(width) - 1.0f, v = 1.0f - 2.0f * (float(y) + 0.5f) / float(height);
            const vec3 direction = normalize(camera.forward + cross(camera.forward, camera.up) * (u * right) + camera.up * (v * up));
            const ClvBvhHit met = clvTraceBvh(reader, camera.position, direction, kClvFar);
            if (met.primitive == kClvNoPrimitive) continue;
            rows[y].push_back({camera.position + direction * met.distance, 0.0f, clvHitOnSurface(reader, met.primitive, met.distance, direction).normal, 0.0f});
        }
    });
    std::vector<ClvReceiver> receivers;
    for (const auto& row : rows) receivers.insert(receivers.end(), row.begin(), row.end());
    return receivers;
}

ParallelFor threadsFor() {
    return [](std::size_t count, const std::function<void(std::size_t)>& body) {
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
            for (std::size_t i = next++; i < count; i = next++) body(i);
        };
        std::vector<std::jthread> threads;
        for (unsigned t = 1; t < std::max(1u, std::thread::hardware_concurrency()); ++t) threads.emplace_back(work);
        work();
    };
}

}  // namespace clv
