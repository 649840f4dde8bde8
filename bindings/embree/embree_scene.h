// The scene in Embree: closest hits in packets, occlusion, and all hits along a line.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "bindings/scene/scene.h"
#include "clv/cpu/scene_probe.h"
#include "clv/data/hit.h"
#include "clv/data/ray.h"

namespace clv {

// Built once, then const: every const member may be called from several threads at once.
class EmbreeScene {
public:
    explicit EmbreeScene(const Scene& scene);  // keeps a reference to `scene`
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    const Scene& scene() const;
    // Distance by which rays that leave a surface start above it, m: a small multiple of the rounding of the coordinates.
    float surfaceOffset() const;

    // The trace stage: cuts each ray at its first hit (maxDistance becomes the hit distance; unchanged where nothing is hit within it).
    // Dead rays (maxDistance 0) stay dead. Fast; about one ray in a million slips through an edge. Queries that are not
    // called fast are watertight.
    void trace(std::span<ClvRay> rays) const;
    // The same, and says what was hit. hits.size() == rays.size().
    void trace(std::span<ClvRay> rays, std::span<ClvHit> hits) const;
    // Kills (maxDistance 0) every ray that meets a surface within its maxDistance, and leaves the others as they are.
    void killOccluded(std::span<ClvRay> rays) const;
    // The two above in the tree of the trace stage, for estimates that can spare a ray in a million.
    void traceFast(std::span<ClvRay> rays, std::span<ClvHit> hits) const;
    void killOccludedFast(std::span<ClvRay> rays) const;
    // Closest hit of one ray within [0, maxDistance].
    ClvHit hit(const glm::vec3& origin, const glm::vec3& direction, float maxDistance) const;
    bool occluded(const glm::vec3& origin, const glm::vec3& direction, float maxDistance) const;
    // Every crossing along origin + t direction, t in (0, maxDistance], sorted by distance; `hits` is cleared first. Coincident
    // surfaces are all reported; a line through an edge that triangles share meets each of them.
    void lineHits(const glm::vec3& origin, const glm::vec3& direction, float maxDistance, std::vector<LineHit>& hits) const;

    // What buildLevel asks, answered by this scene; valid as long as the scene is.
    SceneProbe probe() const;
    // See SceneProbe::solids; true unless it is set, before probe() is asked for.
    bool solids() const { return solids_; }
    void setSolids(bool solids) { solids_ = solids; }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    bool solids_ = true;
};

}  // namespace clv
