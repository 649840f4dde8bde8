// The maps of a scene's lights on the CPU: one stack of RSM texels.
#pragma once
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"
#include "clv/data/light.h"
#include "clv/data/rsm_texel.h"

namespace clv {

// The lights that are on.
std::vector<ClvLight> lightsThatSend(const Scene& scene);

// Texels on a side of each map: 256, fewer where there are many lights.
int mapSide(std::size_t lights);

class LightMaps {
public:
    LightMaps(const EmbreeScene& scene, std::uint32_t seed, const ParallelFor& parallelFor);

    int side() const { return side_; }
    // The texels at one of their well-spread samples; valid until the next call.
    std::span<const ClvRsmTexel> render(std::uint32_t pass);

private:
    const EmbreeScene& scene_;
    std::uint32_t seed_;
    const ParallelFor& parallelFor_;
    std::vector<ClvLight> lights_;
    int side_;
    std::vector<ClvRsmTexel> texels_;
};

}  // namespace clv
