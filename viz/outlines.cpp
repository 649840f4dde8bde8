#include "viz/outlines.h"

#include <cmath>

namespace clv {
namespace {

const glm::u8vec3 kCascadeColors[kClvMaxCascades] = {{255, 255, 255}, {230, 159, 0}, {86, 180, 233}, {0, 158, 115},
                                                     {240, 228, 66},  {0, 114, 178}, {213, 94, 0},   {204, 121, 167}};
const glm::u8vec3 kEdgeColor(110, 110, 110), kFrustumColor(255, 220, 120), kLightColor(255, 240, 80), kMarkColor(255, 60, 200);

// The twelve edges between eight corners; bit k of a corner's number is its place along axis k.
void addHexahedron(FlatLines& lines, const std::array<vec3, 8>& corners, const glm::u8vec3& color) {
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t bit = 1; bit < 8; bit *= 2) {
            if (!(i & bit)) lines.add(corners[i], corners[i | bit], color);
        }
    }
}

void addBox(FlatLines& lines, const vec3& lo, const vec3& extent, const glm::u8vec3& color) {
    std::array<vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) corners[i] = lo + extent * vec3(i & 1, i >> 1 & 1, i >> 2);
    addHexahedron(lines, corners, color);
}

vec3 extentOf(const ClvVolume& grid) { return grid.cellSize * vec3(grid.resolution); }

}  // namespace

void drawBoxes(const BakedVolume& volume, Drawing& drawing) {
    for (std::size_t cascade = 0; cascade < volume.cascades.size(); ++cascade) {
        const ClvVolume& grid = volume.cascades[cascade].level.volume;
        addBox(drawing.thickLines, grid.origin, extentOf(grid), kCascadeColors[cascade]);
    }
}

void drawCellEdges(const ShownCell& cell, FlatLines& lines) {
    addBox(lines, cell.center - 0.5f * cell.edge, vec3(cell.edge), kMarkColor);
}

void drawFrustum(const BakedVolume& volume, const Scene* scene, Drawing& drawing) {
    if (!volume.camera && !(scene && !scene->cameras.empty())) throw InputError("--frustum: expected a camera that the volume stands around, or a scene with one");
    const Camera& camera = volume.camera ? *volume.camera : scene->cameras.front();
    const vec3 extent = extentOf(volume.cascades.front().level.volume);
    const float far = 0.5f * std::max({extent.x, extent.y, extent.z}), near = 0.05f * far;
    const vec3 right = glm::cross(camera.forward, camera.up);
    const float tangent = std::tan(0.5f * camera.yfov);
    std::array<vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const float x = i & 1 ? 1.0f : -1.0f, y = i & 2 ? 1.0f : -1.0f, distance = i & 4 ? far : near;
        corners[i] = camera.position + distance * (camera.forward + tangent * (x * camera.aspect * right + y * camera.up));
    }
    addHexahedron(drawing.signs, corners, kFrustumColor);
}

void drawLights(const BakedVolume& volume, Drawing& drawing) {
    const ClvVolume& grid = volume.cascades.back().level.volume;
    const vec3 extent = volume.mark ? volume.mark->bounds.extent() : extentOf(grid);
    const float size = 0.04f * std::max({extent.x, extent.y, extent.z});
    for (const NamedLight& named : volume.lights) {
        const ClvLight& light = named.light;
        const vec3 position = light.type == kClvLightDirectional ? grid.origin + 0.5f * extentOf(grid) : light.position;
        for (int axis = 0; axis < 3; ++axis) {
            vec3 arm(0.0f);
            arm[axis] = size;
            drawing.signs.add(position - arm, position + arm, kLightColor);
        }
        if (light.type != kClvLightPoint) drawing.signs.add(position, position + 3.0f * size * light.direction, kLightColor);
    }
}

void drawWireframe(const Scene& scene, Drawing& drawing) {
    for (const glm::uvec3& t : scene.triangles) {
        for (int k = 0; k < 3; ++k) drawing.lines.add(scene.positions[t[k]], scene.positions[t[(k + 1) % 3]], kEdgeColor);
    }
}

}  // namespace clv
