#include "benchmarks/baselines/path_tracing.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>

#include "benchmarks/baselines/hit_shading.h"
#include "clv/math/sampling.h"
#include "clv/math/sobol.h"

namespace clv {
namespace {

class PathTracing : public Method {
public:
    std::string name() const override { return "path_tracing"; }
    MethodSettings settings() const override { return {}; }

    void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) override {
        world_.emplace(world);
        receivers_.assign(receivers.begin(), receivers.end());
        restart(1);
    }
    void restart(std::uint32_t seed) override {
        seed_ = seed;
        samples_ = 0;
        traced_ = 0;
        sum_.assign(receivers_.size(), glm::vec3(0.0f));
    }

    void frame(std::size_t rays) override {
        const std::size_t each = std::max<std::size_t>(1, rays / std::max<std::size_t>(1, receivers_.size()));
        // A piece is whole receivers: nobody else adds to their sums.
        const std::size_t perPiece = std::max<std::size_t>(1, kPieceRays / each);
        world_->parallelFor((receivers_.size() + perPiece - 1) / perPiece, [&](std::size_t piece) {
            gather(piece * perPiece, std::min(receivers_.size(), (piece + 1) * perPiece), each);
        });
        samples_ += std::uint32_t(each);
    }

    void irradiance(std::span<glm::vec3> out) override {
        const float scale = samples_ > 0 ? 1.0f / float(samples_) : 0.0f;
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = sum_[i] * scale;
    }

    bool sharesRays() const override { return false; }
    std::size_t bytes() const override { return sum_.size() * sizeof(glm::vec3); }
    std::uint64_t raysTraced() const override { return traced_; }

private:
    // Rays of a piece of work: many enough that handing it out costs nothing.
    static constexpr std::size_t kPieceRays = 2048;

    // Adds `each` samples of receivers [first, last), ray by ray: rays of several receivers share packets when they send few.
    void gather(std::size_t first, std::size_t last, std::size_t each) {
        std::array<ClvRay, kShadedRays> rays;
        std::array<ClvHit, kShadedRays> hits;
        std::array<glm::vec3, kShadedRays> radiance;
        const std::size_t total = (last - first) * each;
        std::uint64_t traced = 0;
        for (std::size_t done = 0; done < total; done += kShadedRays) {
            const std::size_t count = std::min(kShadedRays, total - done);
            for (std::size_t k = 0; k < count; ++k) rays[k] = sampleRay(first + (done + k) / each, std::uint32_t((done + k) % each));
            traced += traceAndShade(world_->scene, std::span(rays).first(count), std::span(hits).first(count), std::span(radiance).first(count));
            // Cosine-weighted: the mean of pi L is the irradiance.
            for (std::size_t k = 0; k < count; ++k) sum_[first + (done + k) / each] += radiance[k] * kClvPi;
        }
        traced_ += traced;
    }

    ClvRay sampleRay(std::size_t receiver, std::uint32_t sample) const {
        const ReferencePoint& point = receivers_[receiver];
        const std::uint32_t stream = clvHashCombine(seed_, std::uint32_t(receiver)), index = samples_ + sample;
        const vec2 u(clvSobolUnit(index, 0u, stream), clvSobolUnit(index, 1u, stream));
        return {.origin = point.position + point.normal * world_->scene.surfaceOffset(), .maxDistance = kClvFar,
                .direction = clvCosineFromSquare(u, point.normal), .dynamicity = 0.0f, .flux = glm::vec3(0.0f), .pad0 = 0.0f};
    }

    std::optional<MethodWorld> world_;
    std::vector<ReferencePoint> receivers_;
    std::uint32_t seed_ = 1;
    std::uint32_t samples_ = 0;       // a receiver, so far
    std::vector<glm::vec3> sum_;      // of the samples' estimates, W/m^2, a receiver each
    std::atomic<std::uint64_t> traced_ = 0;
};

}  // namespace

std::unique_ptr<Method> makePathTracing() {
    return std::make_unique<PathTracing>();
}

}  // namespace clv
