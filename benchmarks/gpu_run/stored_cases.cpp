#include "benchmarks/gpu_run/stored_cases.h"

#include <stdexcept>

#include "benchmarks/gpu_run/level_cases.h"
#include "benchmarks/gpu_run/ray_cases.h"
#include "bindings/embree/bvh.h"
#include "bindings/embree/embree_scene.h"
#include "bindings/scene/surface_rows.h"

namespace clv {

StoredScene storedScene(const std::string& name) {
    const Scene scene = makeBuiltinScene(name);
    const Bvh bvh = buildBvh(scene);
    const SurfaceRows rows = surfaceRowsOf(scene);
    if (!rows.textureTexels.empty()) throw std::runtime_error("the scene " + name + " has textures, which are not stored");
    StoredScene stored{.name = name, .boxes = bvh.boxes, .children = bvh.children, .triangles = bvh.triangles, .surfaces = rows.surfaces};
    for (const NamedLight& light : scene.lights) stored.lights.push_back(light.light);
    stored.boundsLo = scene.bounds.lo, stored.boundsHi = scene.bounds.hi;
    stored.originOffset = EmbreeScene(scene).surfaceOffset();
    const Camera& camera = scene.cameras.front();
    stored.camera = {camera.position, camera.forward, camera.up, camera.yfov};
    return stored;
}

std::vector<StoredCase> storedCases() {
    std::vector<StoredCase> cases = rayCases();
    for (StoredCase& stored : levelCases()) cases.push_back(std::move(stored));
    return cases;
}

}  // namespace clv
