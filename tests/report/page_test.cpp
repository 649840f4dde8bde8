// The page: what it says first, that it holds everything, and that it needs nothing from elsewhere.
#include "benchmarks/report/page.h"

#include <gtest/gtest.h>

#include "benchmarks/report/text.h"

namespace page_test {

using namespace clv;

Measurement made(const std::string& scene, const std::string& method, double milliseconds, double error, std::uint64_t rays) {
    Measurement m;
    m.scene = scene, m.method = method, m.rays = rays, m.raysTraced = rays;
    m.frameSeconds = 1e-3 * milliseconds, m.errors.relativeRmse = error;
    m.receivers = 100, m.bytes = 1 << 20;
    return m;
}

const std::vector<Measurement> kMade = {made("hall", "slow<b>", 4, 0.3, 1024), made("hall", "fast", 1, 0.25, 1 << 20), made("hall", "fast", 4.5, 0.05, 3 << 20),
                                        made("cave", "fast", 8, 0.9, 2048)};

std::string line(const std::string& page, const std::string& start) {
    const std::size_t from = page.find(start);
    return from == std::string::npos ? "" : page.substr(from, page.find('\n', from) - from);
}

TEST(Page, saysFirstWhatABudgetBuys) {
    const std::string page = htmlOf(kMade, {{"commit", "c0ffee"}}, {}, {});
    const std::string two = line(page, "<tr><td><b>2 ms</b>"), ten = line(page, "<tr><td><b>10 ms</b>");
    EXPECT_NE(two.find("<b>25.0 %</b> fast, 1M rays"), std::string::npos) << two;
    EXPECT_NE(two.find("<td>–</td>"), std::string::npos) << "nothing fits in the cave";
    EXPECT_NE(ten.find("<b>5.0 %</b> fast, 3M rays"), std::string::npos) << ten;
    EXPECT_NE(ten.find("<b>90.0 %</b> fast, 2k rays"), std::string::npos) << ten;
    EXPECT_LT(page.find("<b>2 ms</b>"), page.find("<svg"));
}

TEST(Page, holdsEveryMeasurementPlotsAndWhereTheyComeFrom) {
    const std::string page = htmlOf(kMade, {{"commit", "c0ffee"}}, {{"hall", {{.title = "map of fast", .png = "PNG"}}}}, {});
    for (const Measurement& m : kMade) EXPECT_NE(page.find("<td>" + escaped(m.scene) + "</td><td>" + escaped(m.method) + "</td><td>" + countText(m.rays)), std::string::npos);
    for (const char* words : {"c0ffee", "data:image/png;base64,UE5H", "map of fast"}) EXPECT_NE(page.find(words), std::string::npos) << words;
    std::size_t plots = 0;
    for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) ++plots;
    EXPECT_EQ(plots, 8u);
}

TEST(Page, showsWhatEachStageTakesInEachScene) {
    const StageTime trace{"trace", "ray", 91.26, 4.0, 96.0, "bare <Embree>", 0.985}, merge{"merge 32³", "slot", 80123.4, 3000, 512.0, "copy", 2.27};
    const std::string page = htmlOf(kMade, {}, {}, {{"hall", {trace, merge}}, {"cave", {trace}}});
    EXPECT_NE(line(page, "<tr><th>stage</th>").find("<th>hall, ns an item</th><th>bytes</th><th>of the limit</th><th>cave, ns an item</th>"), std::string::npos);
    const std::string cells = "<td>91.3 <small>± 2.0</small></td><td>96</td><td>98 %</td>";
    EXPECT_EQ(line(page, "<tr><td>trace</td>"), "<tr><td>trace</td><td>ray</td><td>bare &lt;Embree&gt;</td>" + cells + cells + "</tr>");
    EXPECT_NE(line(page, "<tr><td>merge 32³</td>").find("<td>80,123 <small>± 1,500</small></td><td>512</td><td>227 %</td><td>–</td>"), std::string::npos) << "the cave has no time of it";
}

TEST(Page, needsNothingFromElsewhereAndNamesAreNoMarkup) {
    const std::string page = htmlOf(kMade, {}, {}, {});
    for (const char* words : {"<script", "<link", "src=\"http", "url(http", "slow<b>"}) EXPECT_EQ(page.find(words), std::string::npos) << words;
}

TEST(Text, numbersAreAsLongAsTheyMean) {
    EXPECT_EQ(percentText(0.1234), "12.3 %");
    EXPECT_EQ(percentText(1.5), "150 %");
    EXPECT_EQ(timeText(0.00123), "1.23 ms");
    EXPECT_EQ(timeText(0.0123), "12.3 ms");
    EXPECT_EQ(timeText(0.123), "123 ms");
    EXPECT_EQ(timeText(12.3), "12.3 s");
    EXPECT_EQ(countText(65536), "64k");
    EXPECT_EQ(countText(4 << 20), "4M");
    EXPECT_EQ(countText(1000), "1000");
    EXPECT_EQ(bytesText(3 << 19), "1.5 MiB");
    EXPECT_EQ(groupedText(921600), "921,600");
    EXPECT_EQ(groupedText(100), "100");
    EXPECT_EQ(groupedText(1234567), "1,234,567");
}

TEST(Text, base64IsThatOfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace page_test
