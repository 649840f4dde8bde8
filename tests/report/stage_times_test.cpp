// Times of stages: what they are counted by, what they are held against, and that they are measured once.
#include "benchmarks/report/stage_times.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "bindings/scene/builtin_scenes.h"
#include "support/temporary_folder.h"

namespace clv::test {
namespace {

// Takes about as long as `steps` say, of this thread's own time.
std::function<void()> work(int steps) {
    return [steps, sum = 1.0]() mutable {
        for (int i = 0; i < steps; ++i) sum = std::sqrt(sum + double(i));
    };
}

TEST(StageTimes, areThoseOfAnItemAndHeldAgainstTheLimit) {
    constexpr int kSteps = 200'000;
    const StageTime few = timeOf("s", {"thing", 1000, 8000, "copy", [] {}, work(kSteps), work(kSteps / 2)});
    const StageTime many = timeOf("s", {"thing", 4000, 8000, "copy", work(4 * kSteps), work(kSteps), work(kSteps / 2)});
    EXPECT_NEAR(few.share, 0.5, 0.15);
    EXPECT_NEAR(few.nanoseconds / many.nanoseconds, 4.0, 1.5) << "the same time for four times the items, what comes before apart";
    EXPECT_EQ(few.bytes, 8.0);
    EXPECT_EQ(many.bytes, 2.0);
    EXPECT_EQ(few.item + few.limit, "thingcopy");
}

class StageTimesOfAScene : public TemporaryFolder {};

TEST_F(StageTimesOfAScene, coverEveryStageOnceAndAreKept) {
    std::vector<double> shares;
    const auto measure = [&](const std::vector<std::string>& scenes) { return measureStages(scenes, "a", folder_, [&](double share) { shares.push_back(share); }); };
    const auto all = measure({"white_sphere"});
    ASSERT_EQ(all.size(), 1u);
    std::set<std::string> stages;
    for (const StageTime& time : all[0].times) {
        stages.insert(time.stage.substr(0, time.stage.find(' ')));
        EXPECT_GT(time.nanoseconds, 0.0) << time.stage;
        EXPECT_GT(time.share, 0.0) << time.stage;
        EXPECT_GT(time.bytes, 0.0) << time.stage;
    }
    EXPECT_EQ(stages, (std::set<std::string>{"rsm", "rays", "trace", "inject", "merge", "evaluate", "build_level"}));
    ASSERT_FALSE(shares.empty());
    EXPECT_NEAR(shares.back(), 1.0, 1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(shares));

    shares.clear();
    EXPECT_EQ(toJson(measure({"white_sphere"})[0]), toJson(all[0]));
    EXPECT_TRUE(shares.empty()) << "nothing is measured twice";
    auto kept = nlohmann::json::parse(read(file("stages.json")));
    kept["program"] = "b";
    write("stages.json", kept.dump());
    EXPECT_EQ(measure({"white_sphere"})[0].times.size(), all[0].times.size());
    EXPECT_FALSE(shares.empty()) << "what another program measured is measured anew";
    write("stages.json", "{");
    EXPECT_TRUE(measure({}).empty()) << "a damaged file holds nothing";
}

TEST(StageTimes, withoutLightsThereAreNone) {
    Scene scene = makeBuiltinScene("white_sphere");
    scene.lights.clear();
    EXPECT_TRUE(timeStages(scene, [](double) {}).empty());
}

}  // namespace
}  // namespace clv::test
