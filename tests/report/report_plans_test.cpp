// What the plans ask for: nothing twice, and what the goals need.
#include "benchmarks/report/report_plans.h"

#include <set>

#include <gtest/gtest.h>

#include "benchmarks/report/curves.h"

namespace {

using namespace clv;

class Plans : public ::testing::TestWithParam<bool> {
protected:
    const ReportPlan plan_ = GetParam() ? fullPlan("") : quickPlan("");
};

TEST_P(Plans, askForNothingTwice) {
    std::set<std::string> asked;
    for (const MethodCase& one : plan_.cases) {
        const auto method = one.make();
        for (const std::uint64_t rays : one.rays) {
            for (const int frames : one.frames)
                EXPECT_TRUE(asked.insert(method->name() + settingsText(method->settings()) + std::to_string(rays) + ", " + std::to_string(frames)).second) << *asked.rbegin();
        }
    }
    EXPECT_GT(asked.size(), 80u);
}

TEST_P(Plans, haveEveryMethodAndPicturesOfAWhole) {
    std::set<std::string> names;
    bool pictures = false;
    for (const MethodCase& one : plan_.cases) {
        names.insert(one.make()->name());
        pictures |= one.make()->settings().size() > 0 && one.make()->settings().back().first == "pixels";
    }
    EXPECT_EQ(names, (std::set<std::string>{"clv", "path_tracing", "ddgi", "thesis", "light_propagation"}));
    EXPECT_TRUE(pictures);
}

TEST(FullPlan, fitsTheFloorToRaysThatBringItOutOfTheNoise) {
    for (const std::string resolution : {"32", "64"}) {
        std::set<double> rays;
        for (const MethodCase& one : fullPlan("").cases) {
            const auto settings = one.make()->settings();
            const auto has = [&](const char* name, const std::string& value) { return std::ranges::find(settings, std::pair<std::string, std::string>(name, value)) != settings.end(); };
            if (one.make()->name() != kLibraryName || !has("resolution", resolution) || !has("guided", "yes") || !has("readers", "surfaces") || !has("storage", "cube9")) continue;
            for (const std::uint64_t n : one.rays)
                for (const int frames : one.frames) rays.insert(double(n) * frames);
        }
        EXPECT_GE(rays.size(), 7u) << resolution;
        EXPECT_GE(*rays.rbegin(), 64e6) << resolution;
    }
}

INSTANTIATE_TEST_SUITE_P(QuickAndFull, Plans, ::testing::Bool(), [](const auto& info) { return std::string(info.param ? "full" : "quick"); });

}  // namespace
