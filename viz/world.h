// The scene that a volume lights, for what the volume alone cannot show: surfaces, rays, direct light, the truth.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "bindings/volume_file/baked_volume.h"
#include "clv/cpu/parallel.h"
#include "clv/data/ray.h"
#include "clv/data/rsm_texel.h"
#include "viz/cell_truth.h"

namespace clv {

class World {
public:
    // `file` in place of the scene that the volume names, unless empty. Throws InputError.
    World(const BakedVolume& volume, const std::string& file);

    const Scene& scene() const { return scene_; }
    const EmbreeScene& embree() const { return embree_; }

    // Lights as the volume has them.
    void setLights(const std::vector<NamedLight>& lights);
    // Of these lights.
    CellTruth& cellTruth() const { return truth_; }

    // The texels of the lights' maps that are lit.
    std::vector<ClvRsmTexel> texels(const ParallelFor& parallelFor) const;
    // The first rays of a sequence from those texels, cut where they hit; those that leave the scene end at its bounds.
    std::vector<ClvRay> rays(std::size_t count, std::uint32_t seed, const ParallelFor& parallelFor) const;

private:
    Scene scene_;
    EmbreeScene embree_;
    mutable CellTruth truth_;
};

}  // namespace clv
