// Maps of the sphere of directions, one a probe: an octahedral square of texels with a border of one, so that a bilinear reading never
// leaves the square (Majercik et al. 2019).
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "clv/math/octahedral.h"

namespace clv {

// Side: texels of the square, without the border. Channels: floats a texel.
template <int Side, int Channels>
class OctahedralMaps {
public:
    static constexpr int kTexels = Side * Side;
    using Value = std::array<float, Channels>;

    // So many maps, all 0.
    void clear(std::size_t maps) { floats_.assign(maps * kStride, 0.0f); }
    std::size_t bytes() const { return floats_.size() * sizeof(float); }

    // The middle of texel [0, kTexels), unit length.
    static vec3 direction(int texel) {
        const vec2 u = (vec2(texel % Side, texel / Side) + 0.5f) / float(Side);
        return clvDirectionFromOctahedral(2.0f * u - 1.0f);
    }

    float* texel(std::size_t map, int texel) { return at(map, texel % Side + 1, texel / Side + 1); }

    // Copies what lies across each edge into the border: along an edge the octahedral map is mirrored.
    void fillBorder(std::size_t map) {
        for (int i = 1; i <= Side; ++i) {
            copy(map, {0, i}, {1, Side + 1 - i});
            copy(map, {Side + 1, i}, {Side, Side + 1 - i});
            copy(map, {i, 0}, {Side + 1 - i, 1});
            copy(map, {i, Side + 1}, {Side + 1 - i, Side});
        }
        copy(map, {0, 0}, {Side, Side});
        copy(map, {Side + 1, Side + 1}, {1, 1});
        copy(map, {0, Side + 1}, {Side, 1});
        copy(map, {Side + 1, 0}, {1, Side});
    }

    // The four texels around a direction of unit length, and their bilinear weights; the same in every map.
    struct Place {
        std::array<std::size_t, 4> texel;
        std::array<float, 4> weight;
    };
    static Place place(const vec3& direction) {
        const vec2 p = (clvOctahedralFromDirection(direction) * 0.5f + 0.5f) * float(Side) + 0.5f;
        // Clamped: rounding can put a direction on the outer edge of the border.
        const ivec2 low(std::min(int(p.x), Side), std::min(int(p.y), Side));
        const vec2 f = p - vec2(low);
        const std::size_t first = offset(low.x, low.y), above = offset(low.x, low.y + 1);
        return {{first, first + Channels, above, above + Channels}, {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
    }
    Value read(std::size_t map, const Place& place) const {
        const float* floats = floats_.data() + map * kStride;
        Value value{};
        for (int k = 0; k < 4; ++k)
            for (int c = 0; c < Channels; ++c) value[c] += place.weight[k] * floats[place.texel[k] + c];
        return value;
    }
    Value read(std::size_t map, const vec3& direction) const { return read(map, place(direction)); }

private:
    static constexpr int kRow = Side + 2;
    static constexpr std::size_t kStride = std::size_t(kRow) * kRow * Channels;

    // Of a texel, the border counted, in its map.
    static std::size_t offset(int x, int y) { return std::size_t(y * kRow + x) * Channels; }
    float* at(std::size_t map, int x, int y) { return floats_.data() + map * kStride + offset(x, y); }
    void copy(std::size_t map, ivec2 to, ivec2 from) { std::copy_n(at(map, from.x, from.y), Channels, at(map, to.x, to.y)); }

    std::vector<float> floats_;
};

}  // namespace clv
