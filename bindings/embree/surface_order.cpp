#include "bindings/embree/surface_order.h"

#include <array>
#include <cstdint>
#include <numeric>

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

// By radix, 11 bits at a time: the places have 33 bits.
void sortAlongSurfaces(std::vector<ClvRsmTexel>& texels, const Bounds& bounds) {
    constexpr int kBits = 11, kPasses = 3;
    struct Entry {
        std::uint64_t place;
        std::size_t texel;
    };
    std::vector<Entry> order(texels.size()), next(texels.size());
    std::array<std::array<std::size_t, std::size_t(1) << kBits>, kPasses> starts{};
    const auto digit = [](std::uint64_t place, int pass) { return std::size_t(place >> (pass * kBits) & ((1u << kBits) - 1u)); };
    for (std::size_t k = 0; k < texels.size(); ++k) {
        order[k] = {placeOf(texels[k].position, texels[k].normal, bounds), k};
        for (int pass = 0; pass < kPasses; ++pass) ++starts[std::size_t(pass)][digit(order[k].place, pass)];
    }
    for (int pass = 0; pass < kPasses; ++pass) {
        auto& start = starts[std::size_t(pass)];
        std::exclusive_scan(start.begin(), start.end(), start.begin(), std::size_t(0));
        for (const Entry& entry : order) next[start[digit(entry.place, pass)]++] = entry;
        std::swap(order, next);
    }
    std::vector<ClvRsmTexel> sorted(texels.size());
    for (std::size_t k = 0; k < texels.size(); ++k) sorted[k] = texels[order[k].texel];
    texels = std::move(sorted);
}

}  // namespace clv
