// Levels that join, are weighed and leave, as their errors say.
#include <gtest/gtest.h>

#include "clv/cpu/level_choice.h"
#include "support/chi_square.h"

namespace clv::test {
namespace {

constexpr std::size_t kReceivers = 3000;

// Four levels whose bias and whose noise after one ray are known; both halves get half of the rays.
class KnownLevels : public LevelsInPlay {
public:
    struct Known {
        float bias, noise;
    };
    explicit KnownLevels(std::vector<Known> known) : known_(std::move(known)), weights(known_.size(), 0.0) {}

    int count() const override { return int(inPlay.size()); }
    double rays(int level) const override { return raysOf[std::size_t(inPlay[std::size_t(level)])]; }
    void estimate(int level, HalfEstimates& estimates) const override {
        const int which = inPlay[std::size_t(level)];
        const Known& known = known_[std::size_t(which)];
        const float noise = known.noise * float(std::sqrt(2.0 / raysOf[std::size_t(which)]));
        for (uint half = 0; half < 2; ++half) {
            estimates.half[half].resize(kReceivers);
            for (std::size_t i = 0; i < kReceivers; ++i) {
                // Uniform numbers have a standard deviation of 1 / sqrt(12).
                const float unit = (randomUnit(uint(10 * which) + half, uint(i)) - 0.5f) * 3.4641f;
                estimates.half[half][i] = vec3(1.0f + (i % 2 == 0 ? known.bias : -known.bias) + noise * unit);
            }
        }
    }
    bool addFiner() override {
        if (inPlay.back() + 1 == int(known_.size())) return false;
        inPlay.push_back(inPlay.back() + 1);
        raysOf[std::size_t(inPlay.back())] = lastRays;
        return true;
    }
    void setWeight(int level, double weight) override { weights[std::size_t(inPlay[std::size_t(level)])] = weight; }
    void drop(int level) override { inPlay.erase(inPlay.begin() + level); }

private:
    std::vector<Known> known_;

public:
    std::vector<int> inPlay = {0, 1};
    double raysOf[4] = {1e4, 1e4, 0.0, 0.0}, lastRays = 1e4;
    std::vector<double> weights;
};

const std::vector<KnownLevels::Known> kKnown = {{0.30f, 1.0f}, {0.10f, 3.0f}, {0.03f, 9.0f}, {0.0f, 27.0f}};

TEST(LevelChoice, finerLevelsJoinUntilTheyErrMore) {
    // At 1e4 rays noise is 0.01, 0.03, 0.09, 0.27: the second errs least, at 0.104. At 1e6 it is the last but one, with 0.031.
    KnownLevels few(kKnown), many(kKnown);
    LevelChoice choice;
    choice.judge(few, 1e4, 1e4, false);
    EXPECT_EQ(few.inPlay.back(), 2) << "the one that shows the second to be the best";
    LevelChoice another;
    another.judge(many, 1e4, 1e6, false);
    EXPECT_EQ(many.inPlay.back(), 3);
    EXPECT_GT(many.weights[2], 0.5);
    EXPECT_NEAR(many.weights[0] + many.weights[1] + many.weights[2] + many.weights[3], 1.0, 1e-9);
}

TEST(LevelChoice, aLevelThatJoinedLateWillHaveMissedRays) {
    // The third joins with 2,500 of 10,000 rays. With 12,500 of 20,000 its noise squared will be 0.0065, above the 0.0054 of the second's noise
    // and bias; had it all of them, it would be 0.0041, and a fourth would join.
    KnownLevels levels(kKnown);
    levels.lastRays = 2500.0;
    LevelChoice choice;
    choice.judge(levels, 1e4, 2e4, false);
    EXPECT_EQ(levels.inPlay, (std::vector<int>{0, 1, 2}));
    EXPECT_GT(levels.weights[1], 0.5);
}

TEST(LevelChoice, onceSettledLevelsLeaveAndNoneJoins) {
    KnownLevels levels(kKnown);
    LevelChoice choice;
    choice.judge(levels, 1e4, 1e6, false);
    EXPECT_EQ(levels.inPlay.size(), 4u);
    EXPECT_FALSE(choice.settled());
    choice.judge(levels, 1e4, 1e6, true);
    EXPECT_TRUE(choice.settled());
    EXPECT_EQ(std::count(levels.inPlay.begin(), levels.inPlay.end(), 0), 0) << "the coarsest errs ten times as much as the best";
    EXPECT_EQ(std::count(levels.inPlay.begin(), levels.inPlay.end(), 2), 1);

    KnownLevels later(kKnown);
    choice.judge(later, 1e4, 1e6, false);
    EXPECT_EQ(later.inPlay, (std::vector<int>{1})) << "another one of the two would join, were it not settled";
}

}  // namespace
}  // namespace clv::test
