#include "viz/scene_mesh.h"

#include <algorithm>
#include <cmath>

namespace clv {
namespace {

constexpr float kInset = 0.05f;  // of a part's size: where receivers stand off the triangle's edges, on which shadows of neighbours lie

struct Triangle {
    glm::vec3 a, b, c;
    float longestEdge() const { return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)}); }
    float area() const { return 0.5f * glm::length(glm::cross(b - a, c - a)); }
};

Triangle triangleOf(const Scene& scene, const glm::uvec3& corners) {
    return {scene.positions[corners.x], scene.positions[corners.y], scene.positions[corners.z]};
}

// Adds one side of a triangle, each edge cut into `cuts` pieces.
void add(SceneMesh& mesh, const Scene& scene, std::uint32_t index, int cuts, bool back) {
    const Triangle t = triangleOf(scene, scene.triangles[index]);
    const glm::vec3 normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a)) * (back ? -1.0f : 1.0f);
    const auto first = std::uint32_t(mesh.points.size());
    for (int i = 0; i <= cuts; ++i) {
        for (int j = 0; j <= cuts - i; ++j) {
            const float u = float(i) / float(cuts), v = float(j) / float(cuts);
            const glm::vec3 point = t.a + (t.b - t.a) * u + (t.c - t.a) * v;
            mesh.points.push_back(point);
            mesh.receivers.push_back({glm::mix(point, (t.a + t.b + t.c) / 3.0f, kInset / float(cuts)), 0.0f, normal, 0.0f});
            mesh.albedo.push_back(scene.albedo(index, u, v));
        }
    }
    const auto at = [&](int i, int j) { return first + std::uint32_t(i * (cuts + 1) - i * (i - 1) / 2 + j); };
    const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh.triangles.push_back(back ? glm::uvec3(a, c, b) : glm::uvec3(a, b, c)); };
    for (int i = 0; i < cuts; ++i) {
        for (int j = 0; j < cuts - i; ++j) {
            addTriangle(at(i, j), at(i + 1, j), at(i, j + 1));
            if (j + 1 < cuts - i) addTriangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
}

}  // namespace

SceneMesh meshOf(const Scene& scene, std::size_t parts, bool backs) {
    double area = 0.0;
    for (const glm::uvec3& corners : scene.triangles) area += triangleOf(scene, corners).area();
    const float edge = float(std::sqrt(2.0 * area / double(parts)));
    SceneMesh mesh;
    for (const bool back : {false, true}) {
        if (back && !backs) break;
        for (std::uint32_t k = 0; k < scene.triangles.size(); ++k) {
            // A long thin triangle needs no more parts than the whole scene.
            const float pieces = std::min(triangleOf(scene, scene.triangles[k]).longestEdge() / edge, std::sqrt(float(parts)));
            add(mesh, scene, k, std::max(1, int(std::ceil(pieces))), back);
        }
    }
    return mesh;
}

}  // namespace clv
