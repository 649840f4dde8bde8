// What has become worse is found, and nothing else.
#include "benchmarks/report/comparison.h"

#include "bindings/scene/scene.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;

Measurement made(const std::string& method, double milliseconds, double error, const std::string& program) {
    Measurement m;
    m.key = "hall; " + method + "; 3 repeats; " + program;
    m.scene = "hall", m.method = method, m.rays = m.raysTraced = 1024;
    m.frameSecondsLeast = 1e-3 * milliseconds, m.errors.relativeRmse = error, m.errorInterval = 0.03;
    return m;
}

const std::vector<Measurement> kBefore = {made("clv", 2, 0.2, "old"), made("ddgi", 10, 0.3, "old")};

std::vector<std::string> worse(double clvMs, double clvError, double ddgiMs) {
    const std::vector<Measurement> now = {made("clv", clvMs, clvError, "new"), made("ddgi", ddgiMs, 0.3, "new"), made("other", 1, 1, "new")};
    return findRegressions(kBefore, now);
}

TEST(Comparison, theSameIsNotWorseNorIsASlowerMachine) {
    EXPECT_TRUE(worse(2, 0.2, 10).empty());
    EXPECT_TRUE(worse(6, 0.2, 30).empty());
    EXPECT_TRUE(worse(1, 0.1, 10).empty());
}

TEST(Comparison, anErrorMayGrowByItsIntervalsButNotMore) {
    EXPECT_TRUE(worse(2, 0.2 + 0.99 * 0.0424, 10).empty());
    const auto found = worse(2, 0.2 + 1.01 * 0.0425, 10);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].find("hall, clv, 1k rays: relative RMSE 24.3 %, was 20.0 %"), std::string::npos) << found[0];
    EXPECT_EQ(worse(2, std::nan(""), 10).size(), 1u) << "no number is worse than any";
}

TEST(Comparison, theRatioOfTimesMayGrowByAFifthButNotMore) {
    EXPECT_TRUE(worse(2.39, 0.2, 10).empty());
    const auto found = worse(2.42, 0.2, 10);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0], "hall: time of clv over that of ddgi is 0.242, was 0.2");
}

TEST(Comparison, reportsWithoutACommonQuestionAreRefused) {
    const std::vector<Measurement> other = {made("else", 1, 1, "new")};
    EXPECT_THROW(findRegressions(kBefore, other), InputError);
}

class ReadReport : public TemporaryFolder {};

TEST_F(ReadReport, readsWhatAReportWritesAndNamesAFileThatIsNone) {
    const nlohmann::ordered_json report = {{"measurements", nlohmann::ordered_json::array({toJson(kBefore[0]), toJson(kBefore[1])})}};
    const auto all = readReport(write("report.json", report.dump()));
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(toJson(all[1]), toJson(kBefore[1]));
    for (const std::string& bad : {write("text", "nonsense"), write("list.json", "[1]"), file("missing")}) {
        try {
            readReport(bad);
            ADD_FAILURE() << "expected an InputError for " << bad;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(bad), std::string::npos);
        }
    }
}

}  // namespace
