#include "bindings/embree/light_maps.h"

#include "bindings/embree/rsm.h"
#include "bindings/scene/scene_facts.h"
#include "clv/math/hash.h"

namespace clv {

std::vector<ClvLight> lightsThatSend(const Scene& scene) {
    std::vector<ClvLight> lights;
    for (const NamedLight& light : scene.lights) {
        if (sendsLight(light)) lights.push_back(light.light);
    }
    return lights;
}

int mapSide(std::size_t lights) {
    int side = 256;
    while (side > 32 && lights * std::size_t(side) * std::size_t(side) > 8u * 256u * 256u) side /= 2;
    return side;
}

LightMaps::LightMaps(const EmbreeScene& scene, std::uint32_t seed, const ParallelFor& parallelFor)
    : scene_(scene), seed_(seed), parallelFor_(parallelFor), lights_(lightsThatSend(scene.scene())), side_(mapSide(lights_.size())) {}

std::span<const ClvRsmTexel> LightMaps::render(std::uint32_t pass) {
    const std::size_t each = std::size_t(side_) * std::size_t(side_);
    texels_.resize(lights_.size() * each);
    for (std::size_t k = 0; k < lights_.size(); ++k) {
        renderRsm(scene_, lights_[k], side_, pass, clvHashCombine(seed_, uint(k)), parallelFor_, std::span(texels_).subspan(k * each, each));
    }
    return texels_;
}

}  // namespace clv
