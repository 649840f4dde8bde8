#include "bindings/embree/surface_order.h"

#include <algorithm>
#include <cstdint>

namespace clv {
namespace {

// The bits of a 10-bit number, two places apart.
std::uint32_t spread(std::uint32_t x) {
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

// Which way a surface faces, then its place along a Z-order curve through the bounds (Morton 1966).
std::uint64_t placeOf(const vec3& position, const vec3& normal, const Bounds& bounds) {
    const vec3 n = glm::abs(normal);
    const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
    const std::uint64_t facing = 2u * std::uint32_t(axis) + (normal[axis] < 0.0f ? 1u : 0u);
    const vec3 at = glm::clamp((position - bounds.lo) / glm::max(bounds.extent(), vec3(1e-30f)), 0.0f, 1.0f) * 1023.0f;
    return facing << 30 | spread(std::uint32_t(at.x)) | spread(std::uint32_t(at.y)) << 1 | spread(std::uint32_t(at.z)) << 2;
}

}  // namespace

void sortAlongSurfaces(std::vector<ClvRsmTexel>& texels, const Bounds& bounds) {
    std::vector<std::pair<std::uint64_t, std::size_t>> order(texels.size());
    for (std::size_t k = 0; k < texels.size(); ++k) order[k] = {placeOf(texels[k].position, texels[k].normal, bounds), k};
    std::sort(order.begin(), order.end());
    std::vector<ClvRsmTexel> sorted(texels.size());
    for (std::size_t k = 0; k < texels.size(); ++k) sorted[k] = texels[order[k].second];
    texels = std::move(sorted);
}

}  // namespace clv
