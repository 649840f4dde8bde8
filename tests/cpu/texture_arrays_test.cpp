#include "clv/cpu/texture_arrays.h"

#include <gtest/gtest.h>

#include <limits>

#include "clv/cpu/build_level.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/volume.h"
#include "clv/math/hash.h"
#include "clv/math/sampling.h"

using namespace clv;

namespace {

constexpr uint kSeed = 7;

float unit(uint index, uint dimension) { return clvUnitFloat(clvHashCombine(clvHashCombine(kSeed, index), dimension)); }

// Fills the history with deposits in [0, 1) that differ between halves, slots and coefficients.
void fillHistory(Volume& volume) {
    for (int half = 0; half < volume.parts().halves; ++half) {
        std::span<float> deposits = volume.partial(half, 0).deposits;
        for (std::size_t i = 0; i < deposits.size(); ++i) {
            const bool padding = int(i % volume.layout().stride()) >= volume.layout().values();
            deposits[i] = padding ? 0.0f : unit(uint(i), uint(half));
        }
    }
    volume.merge(1.0, 1.0f, serialFor());
}

Volume filledVolume(Level level, const DepositLayout& layout) {
    Volume volume(std::move(level), layout, {.halves = 2, .chunks = 1});
    fillHistory(volume);
    return volume;
}

std::vector<float> meanHistory(const Volume& volume) {
    std::vector<float> mean(volume.history(0).size());
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5f * (volume.history(0)[i] + volume.history(1)[i]);
    return mean;
}

std::vector<float> texturesOf(const Volume& volume) {
    // Whatever is not overwritten is found.
    std::vector<float> out(textureValues(volume.level().volume.resolution, volume.layout().storage), std::numeric_limits<float>::quiet_NaN());
    writeTextures(volume.level(), volume.layout(), {volume.history(0), volume.history(1)}, serialFor(), out);
    return out;
}

ClvVolume smallGrid(uint storage) {
    ClvVolume grid{};
    grid.origin = vec3(-1.0f, 2.0f, 0.5f);
    grid.cellSize = 0.5f;
    grid.resolution = ivec3(5, 4, 3);
    grid.storage = storage;
    return grid;
}

BuildOptions withoutGeometry() {
    BuildOptions options;
    options.findRegions = false;
    return options;
}

// What a GPU's trilinear filter returns at `cells`, in cells from the volume's lowest corner, away from its border.
vec4 sampleTrilinear(std::span<const float> texture, const ivec3& resolution, const vec3& cells) {
    const ivec3 lowest = ivec3(floor(cells - 0.5f));
    vec4 sum(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 cell = lowest + ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const vec3 distance = abs(cells - (vec3(cell) + 0.5f));
        const float weight = (1.0f - distance.x) * (1.0f - distance.y) * (1.0f - distance.z);
        const float* texel = texture.data() + (std::size_t(cell.x) + resolution.x * (cell.y + std::size_t(resolution.y) * cell.z)) * 4;
        sum += weight * vec4(texel[0], texel[1], texel[2], texel[3]);
    }
    return sum;
}

// The formula in the header's first comment.
vec3 readTextures(std::span<const float> textures, const ClvVolume& grid, const ClvReceiver& receiver) {
    const vec3 cells = (receiver.position + receiver.normal * (kClvLookupOffset * grid.cellSize) - grid.origin) / grid.cellSize;
    const ClvCoefficients read = clvReadCoefficients(grid.storage, receiver.normal);
    const float r[9] = {read.a.x, read.a.y, read.a.z, read.a.w, read.b.x, read.b.y, read.b.z, read.b.w, read.c};
    const std::size_t perTexture = textures.size() / clvCoefficientCount(grid.storage);
    vec3 irradiance(0.0f);
    for (uint k = 0; k < clvCoefficientCount(grid.storage); ++k) {
        const vec4 sample = sampleTrilinear(textures.subspan(k * perTexture, perTexture), grid.resolution, cells);
        irradiance += r[k] * vec3(sample) / sample.w;
    }
    return max(irradiance, vec3(0.0f));
}

// The grid without geometry, and one whose cells have open volumes of their own.
std::vector<Level> levelsWithoutSplits(uint storage) {
    const Level whole = buildLevel(smallGrid(storage), {}, {}, serialFor(), withoutGeometry());
    Level partly = whole;
    for (std::size_t s = 0; s < partly.slots.size(); ++s) partly.slots[s].openVolume *= 0.2f + 0.8f * unit(uint(s), 9);
    return {whole, partly};
}

TEST(TextureArrays, sampledByATrilinearFilterGiveTheTrilinearLookup) {
    const LookupOptions asASampler{.lookup = kClvLookupTrilinear, .planeCulling = false, .visibility = false};
    for (uint storage : {kClvStorageCube, kClvStorageCube9, kClvStorageSh1, kClvStorageSh2}) {
        for (int channels : {1, 3}) {
            for (const Level& level : levelsWithoutSplits(storage)) {
                const Volume volume = filledVolume(level, {storage, channels});
                const std::vector<float> textures = texturesOf(volume);
                const ClvVolume& grid = volume.level().volume;
                float brightest = 0.0f;
                for (uint i = 0; i < 50; ++i) {
                    const vec3 normal = clvSphereFromSquare(vec2(unit(i, 3), unit(i, 4)));
                    const vec3 cells = vec3(0.51f) + vec3(unit(i, 5), unit(i, 6), unit(i, 7)) * (vec3(grid.resolution) - 1.02f);
                    const ClvReceiver receiver{grid.origin + (cells - kClvLookupOffset * normal) * grid.cellSize, 0.0f, normal, 0.0f};
                    SlotWeights weights;
                    lookupWeights(level, receiver, asASampler, weights);
                    const vec3 expected = readIrradiance(volume.layout(), meanHistory(volume), weights, clvReadCoefficients(storage, normal));
                    const vec3 actual = readTextures(textures, grid, receiver);
                    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], 1e-4f * std::max(1.0f, expected[c])) << "storage " << storage;
                    brightest = std::max(brightest, expected.x);
                }
                EXPECT_GT(brightest, 0.1f);
            }
        }
    }
}

// Two cells of 1 m: the first is split into slots of 0.25 and 0.5 m^3, the second has none.
Level splitLevel() {
    Level level{};
    level.volume.cellSize = 1.0f;
    level.volume.resolution = ivec3(2, 1, 1);
    level.volume.storage = kClvStorageCube;
    level.table = {kClvSplitBit | 0u, kClvNoSlot};
    level.splits.push_back({vec4(1.0f, 0.0f, 0.0f, 0.4f), 0, 1, 0, 2});
    level.slots.resize(2);
    level.slots[0].openVolume = 0.25f;
    level.slots[1].openVolume = 0.5f;
    return level;
}

TEST(TextureArrays, theSidesOfASplitCellAddUp) {
    const Volume volume = filledVolume(splitLevel(), {kClvStorageCube, 3});
    const std::vector<float> textures = texturesOf(volume);
    const std::vector<float> mean = meanHistory(volume);
    const std::size_t stride = volume.layout().stride();
    for (std::size_t k = 0; k < 6; ++k) {
        const float* texel = textures.data() + k * 2 * 4;
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(texel[c], mean[3 * k + c] + mean[stride + 3 * k + c]);
        }
        EXPECT_FLOAT_EQ(texel[3], 0.75f);
    }
}

TEST(TextureArrays, aCellWithoutASlotIsZero) {
    const std::vector<float> textures = texturesOf(filledVolume(splitLevel(), {kClvStorageCube, 3}));
    for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(textures[(k * 2 + 1) * 4 + c], 0.0f);
    }
}

TEST(TextureArrays, cellsKeepTheirTexelWhileTheVolumeScrolls) {
    ClvVolume grid = smallGrid(kClvStorageCube);
    grid.scroll = ivec3(3, 1, 2);
    const Level level = buildLevel(grid, {}, {}, serialFor(), withoutGeometry());
    const Volume volume = filledVolume(level, {kClvStorageCube, 1});
    const std::vector<float> textures = texturesOf(volume);
    // Cell (4, 3, 1) wraps around to (2, 0, 0), cell (0, 0, 0) lies at the scroll itself.
    for (auto [cell, texel] : {std::pair(ivec3(4, 3, 1), ivec3(2, 0, 0)), std::pair(ivec3(0), ivec3(3, 1, 2))}) {
        const std::size_t record = std::size_t(level.table[clvCellIndex(grid, cell)]) * volume.layout().stride();
        const std::size_t index = std::size_t(texel.x + grid.resolution.x * (texel.y + grid.resolution.y * texel.z));
        EXPECT_FLOAT_EQ(textures[index * 4], meanHistory(volume)[record] / (0.5f * 0.5f * 0.5f));
    }
}

TEST(TextureArrays, aSingleEstimateIsWrittenAsItIs) {
    const Volume volume = filledVolume(splitLevel(), {kClvStorageCube, 1});
    std::vector<float> out(textureValues(volume.level().volume.resolution, kClvStorageCube));
    writeTextures(volume.level(), volume.layout(), {volume.history(1)}, serialFor(), out);
    EXPECT_FLOAT_EQ(out[0], volume.history(1)[0] + volume.history(1)[std::size_t(volume.layout().stride())]);
}

TEST(TextureArrays, halvesAreTheRoundedFloats) {
    const Volume volume = filledVolume(levelsWithoutSplits(kClvStorageCube9)[1], {kClvStorageCube9, 3});
    const std::vector<float> floats = texturesOf(volume);
    std::vector<std::uint16_t> halves(floats.size(), 0xffff);
    writeTextures(volume.level(), volume.layout(), {volume.history(0), volume.history(1)}, serialFor(), halves);
    for (std::size_t i = 0; i < floats.size(); ++i) ASSERT_EQ(halves[i], clvHalfFromFloat(floats[i])) << i;
}

}  // namespace
