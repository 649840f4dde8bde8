// A volume's light as arrays ready for 3D textures of four channels, one texture a coefficient of the storage.
//
// rgb: deposits over the volume of a whole cell, W/m^2; a: the open share of the cell. As with premultiplied alpha, both may be
// filtered linearly, and the division comes after: E(n) = sum over k of r_k(n) * rgb_k / a, clamped at 0, with r_k from
// clvReadCoefficients and the sample taken kClvLookupOffset cells in front of the surface. The same estimator as evaluate's
// trilinear lookup, without what a sampler cannot do: leaving out cells behind the surface, and telling apart the sides of a wall
// that splits a cell. Those are added up here.
#ifndef CLV_CPU_TEXTURE_ARRAYS_H
#define CLV_CPU_TEXTURE_ARRAYS_H
#include <cassert>
#include <initializer_list>
#include <span>

#include "../math/pack.h"
#include "level.h"
#include "parallel.h"

namespace clv {

// Values in all textures of a volume together: 4 a texel, a texel for each cell and coefficient.
inline std::size_t textureValues(const ivec3& resolution, uint storage) {
    return std::size_t(resolution.x) * resolution.y * resolution.z * clvCoefficientCount(storage) * 4;
}

namespace detail {

template <class Value, class FromFloat>
void fillTextures(const Level& level, const DepositLayout& layout, std::initializer_list<std::span<const float>> estimates,
                  const ParallelFor& parallelFor, std::span<Value> out, FromFloat&& fromFloat) {
    const std::size_t coefficients = clvCoefficientCount(layout.storage), cells = level.cellCount();
    assert(out.size() == cells * coefficients * 4);
    const float perCell = 1.0f / (level.volume.cellSize * level.volume.cellSize * level.volume.cellSize);
    const float perEstimate = perCell / float(estimates.size());

    auto fillCell = [&](std::size_t cell) {
        const uint entry = level.table[cell];
        const CellSlots slots = entry == kClvNoSlot ? CellSlots{0, 0} : slotsOfCell(level, entry);
        float openVolume = 0.0f;
        for (uint s = slots.first; s < slots.first + slots.count; ++s) openVolume += level.slots[s].openVolume;
        for (std::size_t k = 0; k < coefficients; ++k) {
            vec3 sum(0.0f);
            for (std::span<const float> deposits : estimates) {
                for (uint s = slots.first; s < slots.first + slots.count; ++s) {
                    const float* record = deposits.data() + std::size_t(s) * layout.stride();
                    for (int c = 0; c < 3; ++c) sum[c] += record[layout.channels == 1 ? k : 3 * k + c];
                }
            }
            Value* texel = out.data() + (k * cells + cell) * 4;
            for (int c = 0; c < 3; ++c) texel[c] = fromFloat(sum[c] * perEstimate);
            texel[3] = fromFloat(openVolume * perCell);
        }
    };
    const std::size_t kPiece = 4096;
    auto fillPiece = [&](std::size_t piece) {
        for (std::size_t cell = piece * kPiece; cell < std::min(cells, (piece + 1) * kPiece); ++cell) fillCell(cell);
    };
    parallelFor((cells + kPiece - 1) / kPiece, std::ref(fillPiece));
}

}  // namespace detail

// Overwrites all of `out`, textureValues() long: texture after texture in the order of the storage's coefficients (kClvStorage...),
// within each x fastest, then y, then z. A cell's texel is at its storage coordinates: those of the cell while the volume's
// scroll is 0, wrapped around after that, so that a texture with repeat addressing need not be moved when the volume moves.
// A cell that has no slot is all 0. `estimates`: deposits of the level, layout.stride() floats a slot, whose mean is written: the
// histories of a Volume's halves, or the one of a MovingVolume.
inline void writeTextures(const Level& level, const DepositLayout& layout, std::initializer_list<std::span<const float>> estimates,
                          const ParallelFor& parallelFor, std::span<float> out) {
    detail::fillTextures(level, layout, estimates, parallelFor, out, [](float value) { return value; });
}
// The same in half precision, of which magnitudes above 65504 are cut.
inline void writeTextures(const Level& level, const DepositLayout& layout, std::initializer_list<std::span<const float>> estimates,
                          const ParallelFor& parallelFor, std::span<std::uint16_t> out) {
    detail::fillTextures(level, layout, estimates, parallelFor, out, [](float value) { return std::uint16_t(clvHalfFromFloat(value)); });
}

}  // namespace clv
#endif
