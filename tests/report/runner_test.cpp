// Measurements: their figures, and how an interrupted run goes on.
#include "benchmarks/report/runner.h"

#include <cmath>

#include "bindings/image/image.h"
#include "report/fake_method.h"
#include "support/temporary_folder.h"

namespace clv::test {
namespace {

// In white_sphere every point receives 0.8 W/m^2.
constexpr float kSphere = 0.8f;

class Runner : public TemporaryFolder {
protected:
    ReportPlan plan(float value, float step) {
        ReportPlan plan;
        plan.scenes = {"white_sphere"};
        plan.cases = {{.make = [this, value, step] { return std::make_unique<FakeMethod>("fake", value, step, calls_); }, .rays = {100, 400}, .frames = {1, 4}}};
        plan.truth = {.points = 50, .pictureWidth = 16, .samples = 256};
        plan.repeats = 2;
        plan.program = "a";
        return plan;
    }
    std::vector<Measurement> measure(const ReportPlan& plan) {
        return measureAll(plan, folder_, serialFor(), [this](double share) { shares_.push_back(share); });
    }

    FakeCalls calls_;
    std::vector<double> shares_;
};

TEST_F(Runner, figuresAreThoseOfTheMethod) {
    const auto all = measure(plan(1.1f * kSphere, 0.04f));
    ASSERT_EQ(all.size(), 4u);
    for (const Measurement& m : all) {
        EXPECT_EQ(m.method, "fake");
        EXPECT_EQ(curveName(m), "fake (zeal 3, aim high)");
        // A bias of 10 %, and a noise of 5 % a frame whose sign turns from repeat to repeat.
        const double noise = 0.05 / m.frames;
        EXPECT_NEAR(m.errors.bias, 0.1, 5e-3);
        EXPECT_NEAR(m.errors.relativeRmse, std::hypot(0.1, noise), 5e-3);
        EXPECT_GT(m.errorInterval, 0.0);
        EXPECT_EQ(m.raysTraced, m.rays * std::uint64_t(m.frames));
        EXPECT_EQ(m.bytes, 12u);
        EXPECT_GT(m.picture.rms, 0.0);
        EXPECT_FALSE(m.leak) << "no point of the sphere is dark";
    }
    EXPECT_EQ(all[0].rays, 100u);
    EXPECT_EQ(all[1].frames, 4);
    EXPECT_EQ(all[2].rays, 400u);
}

TEST_F(Runner, aMethodIsPreparedOnceAndWarmedUpForEachNumberOfRays) {
    measure(plan(kSphere, 0.0f));
    EXPECT_EQ(calls_.prepared, 1);
    EXPECT_EQ(calls_.frames, 2 * (1 + 2 * 4));
    ASSERT_FALSE(shares_.empty());
    EXPECT_TRUE(std::ranges::is_sorted(shares_));
    EXPECT_LT(shares_.front(), 0.01) << "the truth is in it";
    EXPECT_NEAR(shares_.back(), 1.0, 1e-12);
}

TEST_F(Runner, whatIsMeasuredIsNotMeasuredAgain) {
    const auto first = measure(plan(kSphere, 0.0f));
    calls_ = {};
    const auto second = measure(plan(kSphere, 0.0f));
    EXPECT_EQ(calls_.prepared, 0);
    EXPECT_EQ(calls_.frames, 0);
    ASSERT_EQ(second.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(toJson(second[i]), toJson(first[i]));
}

TEST_F(Runner, goesOnAfterALineThatAnInterruptionLeftUnfinished) {
    const auto first = measure(plan(kSphere, 0.0f));
    const std::string text = read(file("measurements.jsonl"));
    write("measurements.jsonl", text.substr(0, text.size() - 40));
    calls_ = {};
    EXPECT_EQ(measure(plan(kSphere, 0.0f)).size(), 4u);
    EXPECT_EQ(calls_.frames, 1 + 2 * 4) << "the last measurement alone";
    EXPECT_EQ(std::ranges::count(read(file("measurements.jsonl")), '\n'), 4);
}

TEST_F(Runner, anotherProgramIsMeasuredAnew) {
    measure(plan(kSphere, 0.0f));
    calls_ = {};
    ReportPlan other = plan(kSphere, 0.0f);
    other.program += "b";
    measure(other);
    EXPECT_EQ(calls_.prepared, 1);
}

TEST_F(Runner, aDamagedFileIsRefusedByLine) {
    measure(plan(kSphere, 0.0f));
    std::string text = read(file("measurements.jsonl"));
    text[text.find('\n') + 1] = 'x';
    write("measurements.jsonl", text);
    try {
        measure(plan(kSphere, 0.0f));
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("measurements.jsonl:2: expected a measurement"), std::string::npos) << error.what();
    }
}

TEST_F(Runner, thePictureOfAMeasurementIsKept) {
    const auto all = measure(plan(kSphere, 0.0f));
    const Image picture = readImage(pictureFile(folder_, all[0]).string());
    EXPECT_EQ(picture.width, 16);
    EXPECT_NEAR(picture.at(8, 4).x, kSphere, 1e-3);
}

}  // namespace
}  // namespace clv::test
