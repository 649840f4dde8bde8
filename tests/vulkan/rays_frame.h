// A small frame that runs one shader: rays from a made-up map.
#ifndef CLV_TESTS_VULKAN_RAYS_FRAME_H
#define CLV_TESTS_VULKAN_RAYS_FRAME_H
#include <span>
#include <vector>

#include "clv/data/frame.h"
#include "clv/data/ray.h"
#include "clv/data/rsm_texel.h"
#include "clv/plan/frame.h"

namespace clv::test {

struct RaysFrame {
    static constexpr std::uint32_t kSide = 8, kRays = 4096;

    Frame frame;
    ClvFrame constants{.boundsLo = vec3(0.0f), .rayCount = kRays, .boundsHi = vec3(1.0f), .halves = 2, .firstIndex = 64, .halfStep = kRays, .seed = 7,
                       .rsmPass = 0, .rsmSeed = 0, .rsmSide = kSide, .texelRows = kSide, .receiverCount = 0, .axisX = vec3(0.0f), .originOffset = 1e-3f,
                       .axisY = vec3(0.0f), .triangleCount = 0, .axisZ = vec3(0.0f), .faceCount = 0, .faceSide = 0, .pad0 = 0, .pad1 = 0, .pad2 = 0};
    std::vector<ClvRsmTexel> texels = std::vector<ClvRsmTexel>(kSide * kSide);
    std::vector<float> sums;

    RaysFrame() {
        for (std::uint32_t i = 0; i < texels.size(); ++i) {
            texels[i] = {vec3(float(i), 1.0f, 2.0f), 0.25f, normalize(vec3(1.0f, float(i), 3.0f)), 1u, vec3(1.0f, 2.0f, 3.0f), 0.0f};
        }
        for (std::uint32_t row = 0; row <= kSide; ++row) {
            for (std::uint32_t i = 0; i <= kSide; ++i) sums.push_back(float(i) / kSide);
        }
        frame.buffers = {{"frame", CLV_BIND_FRAME, sizeof(ClvFrame), FrameSource::host},
                         {"texels", CLV_BIND_TEXELS, texels.size() * sizeof(ClvRsmTexel), FrameSource::host},
                         {"sums", CLV_BIND_TEXEL_SUMS, sums.size() * sizeof(float), FrameSource::host},
                         {"rays", CLV_BIND_RAYS, kRays * sizeof(ClvRay), FrameSource::zero, true}};
        frame.steps = {{"light", {{"rays", "rays", {}, {{0, FrameBinding::uniform}, {1}, {2}, {3, FrameBinding::storage, FrameAccess::write}}, groupsFor(kRays), {}}}},
                       {"clear", {{"clear", "", {}, {{3, FrameBinding::storage, FrameAccess::write}}, uvec3(1), {}}}}};
        addBarriers(frame);
    }

    // Gives `executor` all that the host owns.
    template <class Executor>
    void uploadTo(Executor& executor) const {
        executor.upload("frame", constants);
        executor.upload("texels", std::span<const ClvRsmTexel>(texels));
        executor.upload("sums", std::span<const float>(sums));
    }
    template <class Executor>
    static std::vector<ClvRay> raysOf(Executor& executor) {
        std::vector<ClvRay> rays(kRays);
        executor.download("rays", std::span(rays));
        return rays;
    }
};

}  // namespace clv::test
#endif
