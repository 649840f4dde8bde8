#include "bindings/scene/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <glm/gtc/constants.hpp>

namespace clv {
namespace {

struct Triangulation {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::uvec3> faces;  // counter-clockwise seen from outside
};

Triangulation icosahedron() {
    const double g = glm::golden_ratio<double>();
    Triangulation mesh;
    mesh.vertices = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    mesh.faces = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                  {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
    for (glm::dvec3& v : mesh.vertices) v = glm::normalize(v);
    return mesh;
}

Triangulation splitIntoFour(Triangulation mesh) {
    std::map<std::pair<glm::uint, glm::uint>, glm::uint> midpoints;
    auto midpoint = [&](glm::uint a, glm::uint b) {
        auto [found, isNew] = midpoints.try_emplace(std::minmax(a, b), glm::uint(mesh.vertices.size()));
        if (isNew) mesh.vertices.push_back(glm::normalize(mesh.vertices[a] + mesh.vertices[b]));
        return found->second;
    };
    std::vector<glm::uvec3> faces;
    for (const glm::uvec3& f : mesh.faces) {
        glm::uint ab = midpoint(f.x, f.y), bc = midpoint(f.y, f.z), ca = midpoint(f.z, f.x);
        faces.insert(faces.end(), {{f.x, ab, ca}, {f.y, bc, ab}, {f.z, ca, bc}, {ab, bc, ca}});
    }
    mesh.faces = std::move(faces);
    return mesh;
}

double area(const Triangulation& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& f : mesh.faces)
        sum += 0.5 * glm::length(glm::cross(mesh.vertices[f.y] - mesh.vertices[f.x], mesh.vertices[f.z] - mesh.vertices[f.x]));
    return sum;
}

}  // namespace

void addBlocks(SceneBuilder& builder, const BlockGrid& grid, const FaceMaterial& material) {
    const std::array<const std::vector<double>*, 3> planes = {&grid.xs, &grid.ys, &grid.zs};
    const glm::ivec3 count(grid.xs.size() - 1, grid.ys.size() - 1, grid.zs.size() - 1);
    auto isSolid = [&](const glm::ivec3& block) {
        bool inside = glm::all(glm::greaterThanEqual(block, glm::ivec3(0))) && glm::all(glm::lessThan(block, count));
        return inside ? grid.isSolid(block) : grid.outsideIsSolid;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int layer = -1; layer < count[axis]; ++layer)
            for (int row = 0; row < count[v]; ++row)
                for (int column = 0; column < count[u]; ++column) {
                    glm::ivec3 low;
                    low[axis] = layer;
                    low[u] = column;
                    low[v] = row;
                    glm::ivec3 high = low;
                    ++high[axis];
                    const bool lowSolid = isSolid(low), highSolid = isSolid(high);
                    if (lowSolid == highSolid) continue;

                    glm::dvec3 corner;
                    corner[axis] = (*planes[axis])[layer + 1];
                    corner[u] = (*planes[u])[column];
                    corner[v] = (*planes[v])[row];
                    glm::dvec3 alongU = corner, alongV = corner, opposite = corner;
                    alongU[u] = opposite[u] = (*planes[u])[column + 1];
                    alongV[v] = opposite[v] = (*planes[v])[row + 1];
                    if (lowSolid)
                        builder.addQuad(corner, alongU, opposite, alongV, material(high, low));
                    else
                        builder.addQuad(corner, alongV, opposite, alongU, material(low, high));
                }
    }
}

void addBox(SceneBuilder& builder, const glm::dvec3& center, const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z,
            std::uint32_t material) {
    // Each face: outward half-axis, then two half-axes whose cross product points outwards.
    const std::array<std::array<glm::dvec3, 3>, 6> faces = {{{x, y, z}, {-x, z, y}, {y, z, x}, {-y, x, z}, {z, x, y}, {-z, y, x}}};
    for (const auto& [out, u, v] : faces) {
        glm::dvec3 middle = center + out;
        builder.addQuad(middle - u - v, middle + u - v, middle + u + v, middle - u + v, material);
    }
}

void addSphereInside(SceneBuilder& builder, double radius, int levels, std::uint32_t material) {
    Triangulation mesh = icosahedron();
    for (int level = 0; level < levels; ++level) mesh = splitIntoFour(std::move(mesh));
    const double scale = radius * std::sqrt(4.0 * glm::pi<double>() / area(mesh));
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        std::uint32_t index = builder.addVertex(scale * mesh.vertices[i]);
        if (i == 0) first = index;
    }
    for (const glm::uvec3& f : mesh.faces) builder.addTriangle(first + f.x, first + f.z, first + f.y, material);
}

void turnScene(Scene& scene, const glm::dmat3& rotation) {
    auto turned = [&](const glm::vec3& v) { return glm::vec3(rotation * glm::dvec3(v)); };
    for (glm::vec3& position : scene.positions) position = turned(position);
    for (NamedLight& named : scene.lights) {
        named.light.position = turned(named.light.position);
        named.light.direction = turned(named.light.direction);
    }
    for (Camera& camera : scene.cameras) {
        camera.position = turned(camera.position);
        camera.forward = turned(camera.forward);
        camera.up = turned(camera.up);
    }
    scene.bounds = {scene.positions.front(), scene.positions.front()};
    for (const glm::vec3& position : scene.positions) {
        scene.bounds.lo = glm::min(scene.bounds.lo, position);
        scene.bounds.hi = glm::max(scene.bounds.hi, position);
    }
}

}  // namespace clv
