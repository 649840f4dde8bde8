// A frame's rays in halves and chunks: together they are one stretch of one sequence.
#include "clv/cpu/frame_rays.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace clv;

namespace {

// One lit texel in the origin that looks up.
struct OneTexel {
    OneTexel() {
        texel.valid = 1u;
        texel.normal = vec3(0.0f, 1.0f, 0.0f);
        texel.flux = vec3(1.0f);
        sampler.build(std::span(&texel, 1), 1, serialFor());
    }
    ClvRsmTexel texel{};
    TexelSampler sampler;  // refers to the texel
};

bool sameRays(std::span<const ClvRay> a, std::span<const ClvRay> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

// The frames one after the other.
std::vector<ClvRay> raysOfFrames(const VolumeParts& parts, std::initializer_list<std::size_t> counts) {
    const OneTexel light;
    FrameRays rays(parts, 5u, 1e-4f);
    std::vector<ClvRay> all;
    for (const std::size_t count : counts) {
        rays.draw(light.sampler, count, serialFor());
        all.insert(all.end(), rays.all().begin(), rays.all().end());
    }
    return all;
}

TEST(FrameRays, areTheSameHoweverTheyAreHalvedAndCut) {
    const std::vector<ClvRay> whole = raysOfFrames({.halves = 1, .chunks = 1}, {4096});
    EXPECT_TRUE(sameRays(raysOfFrames({.halves = 2, .chunks = 1}, {4096}), whole));
    EXPECT_TRUE(sameRays(raysOfFrames({.halves = 2, .chunks = 4}, {4096}), whole));
}

TEST(FrameRays, goOnWhereTheLastFrameEnded) {
    const std::vector<ClvRay> whole = raysOfFrames({.halves = 2, .chunks = 2}, {4096});
    EXPECT_TRUE(sameRays(raysOfFrames({.halves = 2, .chunks = 2}, {1000, 96, 3000}), whole));
}

TEST(FrameRays, halvesAndChunksShareThemOut) {
    constexpr int kParts = 6;
    const OneTexel light;
    FrameRays rays({.halves = 2, .chunks = 3}, 5u, 1e-4f);
    rays.draw(light.sampler, 1000, serialFor());
    EXPECT_EQ(rays.all().size(), 1002u);
    EXPECT_EQ(rays.perHalf(), 501u);
    for (std::size_t part = 0; part < kParts; ++part) {
        EXPECT_TRUE(sameRays(rays.part(part), rays.all().subspan(part * 167, 167))) << part;
    }
}

}  // namespace
