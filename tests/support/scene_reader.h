// Reads a scene's tree and surfaces as shaders do, on the host.
#ifndef CLV_TESTS_SUPPORT_SCENE_READER_H
#define CLV_TESTS_SUPPORT_SCENE_READER_H
#include "bindings/embree/bvh.h"
#include "bindings/scene/surface_rows.h"
#include "clv/stages/surface.h"
#include "clv/stages/texture.h"
#include "clv/stages/trace_bvh.h"

namespace clv::test {

struct SceneReader {
    const Bvh& bvh;
    const SurfaceRows& rows;

    vec4 clvReadBvhBoxes(uint row) const { return bvh.boxes.at(row); }
    uvec4 clvReadBvhChildren(uint node) const { return bvh.children.at(node); }
    vec4 clvReadTriangle(uint row) const { return bvh.triangles.at(row); }
    vec4 clvReadSurface(uint row) const { return rows.surfaces.at(row); }
    uvec4 clvReadTextureRow(uint row) const { return rows.textureRows.at(row); }
    vec4 clvReadTextureTexel(uint i) const { return rows.textureTexels.at(i); }

    // What the shaders' sceneHit() does.
    ClvHit hit(const ClvRay& ray) const {
        const ClvBvhHit met = clvTraceBvh(*this, ray.origin, ray.direction, ray.maxDistance);
        ClvHit hit = clvHitOnSurface(*this, met.primitive, met.distance, ray.direction);
        if (met.primitive != kClvNoPrimitive && !rows.textureTexels.empty()) hit.albedo *= clvTextureOn(*this, met.primitive, met.u, met.v);
        return hit;
    }
};

}  // namespace clv::test
#endif
