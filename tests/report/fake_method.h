// A method whose answers, rays and calls a test can foretell.
#ifndef CLV_TESTS_REPORT_FAKE_METHOD_H
#define CLV_TESTS_REPORT_FAKE_METHOD_H
#include "benchmarks/baselines/method.h"

namespace clv::test {

struct FakeCalls {
    int prepared = 0, frames = 0;
};

// Reads `value` plus a noise of +-step / frames that alternates from seed to seed, everywhere.
class FakeMethod : public Method {
public:
    FakeMethod(std::string name, float value, float step, FakeCalls& calls) : name_(std::move(name)), value_(value), step_(step), calls_(calls) {}

    std::string name() const override { return name_; }
    MethodSettings settings() const override { return {{"zeal", "3"}, {"aim", "high"}}; }
    void prepare(const MethodWorld&, std::span<const ReferencePoint>) override { ++calls_.prepared; }
    void restart(std::uint32_t seed) override { seed_ = seed, frames_ = 0, rays_ = 0; }
    void frame(std::size_t rays) override { ++calls_.frames, ++frames_, rays_ += rays; }
    void irradiance(std::span<glm::vec3> out) override {
        const float noise = (seed_ % 2 == 0 ? step_ : -step_) / float(frames_);
        for (glm::vec3& e : out) e = glm::vec3(value_ + noise);
    }
    std::size_t bytes() const override { return 12; }
    std::uint64_t raysTraced() const override { return rays_; }

private:
    std::string name_;
    float value_, step_;
    FakeCalls& calls_;
    std::uint32_t seed_ = 1;
    int frames_ = 0;
    std::uint64_t rays_ = 0;
};

}  // namespace clv::test
#endif
