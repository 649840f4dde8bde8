#include "benchmarks/report/picture.h"

#include <limits>
#include <map>

#include "benchmarks/report/metrics.h"
#include "clv/math/constants.h"

namespace clv {

Image radianceImage(int width, int height, std::span<const VisibleSurface> surfaces, std::span<const glm::vec3> irradiance) {
    Image image(width, height);
    for (std::size_t i = 0; i < surfaces.size(); ++i) image.pixels[surfaces[i].pixel] = surfaces[i].albedo * irradiance[i] * kClvInvPi;
    return image;
}

std::vector<float> blockErrors(int width, int height, int block, std::span<const VisibleSurface> surfaces,
                               std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth) {
    const auto pixelsAcross = std::size_t(width), blockSide = std::size_t(block);
    const std::size_t across = (pixelsAcross + blockSide - 1) / blockSide;

    struct Block {
        std::size_t index;
        float count = 0.0f;
    };
    // Blocks that see nothing are left out: they would count as dark ones.
    std::map<std::size_t, Block> blocks;
    std::vector<glm::vec3> blockEstimate, blockTruth;
    std::vector<std::size_t> blockOf;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const std::size_t x = surfaces[i].pixel % pixelsAcross, y = surfaces[i].pixel / pixelsAcross;
        Block& b = blocks.try_emplace(y / blockSide * across + x / blockSide, Block{blocks.size()}).first->second;
        blockOf.push_back(b.index);
        blockEstimate.resize(blocks.size());
        blockTruth.resize(blocks.size());
        b.count += 1.0f;
        blockEstimate[b.index] += (estimate[i] - blockEstimate[b.index]) / b.count;
        blockTruth[b.index] += (truth[i] - blockTruth[b.index]) / b.count;
    }
    const std::vector<float> errors = pointErrors(blockEstimate, blockTruth);
    std::vector<float> map(pixelsAcross * std::size_t(height), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < surfaces.size(); ++i) map[surfaces[i].pixel] = errors[blockOf[i]];
    return map;
}

}  // namespace clv
