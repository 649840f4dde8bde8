// The frames of a series in the window: stepped, played and scrubbed with real keys and a real mouse.
#include <algorithm>
#include <cmath>

#include "viz/viz_window.h"

using namespace clv;
using namespace clv::test;

namespace {

constexpr int kFrames = 4;

class SeriesWindow : public VizWindow {
protected:
    // Frame k has 2^k times the light of frame 0.
    std::string bakeSeries() const {
        BakedVolume volume = bakedScene("cornell", 8);
        std::vector<SeriesStep> steps;
        for (int frame = 0; frame < kFrames; ++frame) {
            volume.frame = std::uint32_t(frame);
            steps.push_back({0.5 * frame, "S/" + std::to_string(frame) + ".vtm"});
            writeVolume(steps.back().vtm, volume, pathOf());
            for (auto& estimate : volume.cascades[0].estimates) {
                for (float& value : estimate) value *= 2.0f;
            }
        }
        writeSeries("S.pvd", steps, pathOf());
        return file("S.pvd");
    }
    // The frames whose cells clicks printed, by how much light they hold beside frame 0; a region of a cell behind a wall holds none.
    std::vector<int> framesIn(const std::string& text) const {
        std::vector<double> sums;
        for (std::size_t at = 0; (at = text.find("\n+y ", at)) != std::string::npos; ++at) {
            double r = 0.0, g = 0.0, b = 0.0;
            if (std::sscanf(text.c_str() + at, "\n+y %lf %lf %lf", &r, &g, &b) == 3 && r + g + b > 0.0) sums.push_back(r + g + b);
        }
        std::vector<int> frames;
        for (const double sum : sums) frames.push_back(int(std::lround(std::log2(sum / sums.front()))));
        return frames;
    }
    static constexpr const char* kClick = " mousemove 250 200 click 1 ";
};

TEST_F(SeriesWindow, keysStepThroughTheFrames) {
    open({bakeSeries(), "--size", "500x400"});
    ASSERT_EQ(doToWindow(std::string(kClick) + "key Right" + kClick + "key Right key Right key Right" + kClick + "key Left" + kClick + "key Home" + kClick + "key End" + kClick), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(framesIn(result.out), (std::vector<int>{0, 1, 3, 2, 0, 3})) << result.out;
}

TEST_F(SeriesWindow, theSliderScrubs) {
    open({bakeSeries(), "--size", "500x400"});
    // It lies a fourteenth of the height below the top, from 0.38 to 0.66 of the width; a frame takes a quarter of it. VTK leaves
    // out all but the last of the moves that wait, also of those after a button: hence the sleeps.
    ASSERT_EQ(doToWindow(std::string(kClick) + "mousemove 278 28 click 1 sleep 1" + kClick + "sleep 1 mousemove 278 28 mousedown 1 mousemove 300 28 mousemove 313 28 sleep 1 mouseup 1 sleep 1" + kClick +
                         "sleep 1 mousemove 242 28 click 1 sleep 1" + kClick), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(framesIn(result.out), (std::vector<int>{0, 2, 3, 1})) << result.out;
}

TEST_F(SeriesWindow, spacePlaysAndPauses) {
    open({bakeSeries(), "--size", "500x400"});
    std::string clicks;
    for (int k = 0; k < 8; ++k) clicks += std::string("sleep 0.15") + kClick;
    ASSERT_EQ(doToWindow(std::string(kClick) + "key space " + clicks + "key space" + kClick + "sleep 0.5" + kClick), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    std::vector<int> frames = framesIn(result.out);
    ASSERT_EQ(frames.size(), 11u) << result.out;
    EXPECT_EQ(frames[9], frames[10]) << "paused";
    std::ranges::sort(frames);
    EXPECT_GE(std::ranges::unique(frames).begin() - frames.begin(), 3) << "frames that were seen while it played";
}

TEST_F(SeriesWindow, optionsSayWhichFrameAndThatItPlays) {
    const std::string series = bakeSeries();
    const std::string all = runViz({series, "--pick", "0.28,0.28,0.28"}).out + runViz({series, "--pick", "0.28,0.28,0.28", "--frame", "2"}).out;
    EXPECT_EQ(framesIn(all), (std::vector<int>{0, 2}));
    const std::string figure = runViz({series, "--pick", "0.28,0.28,0.28"}).out + runViz({series, "--figure", "3.3", "--pick", "0.28,0.28,0.28"}).out;
    EXPECT_EQ(framesIn(figure), (std::vector<int>{0, kFrames - 1}));
    const CommandResult beyond = runViz({series, "--frame", "4", "--out", file("p.png")});
    EXPECT_EQ(beyond.status, 2);
    EXPECT_TRUE(contains(beyond.err, "--frame 4: expected a number below 4")) << beyond.err;
    open({series, "--size", "500x400", "--play"});
    std::string clicks;
    for (int k = 0; k < 8; ++k) clicks += std::string("sleep 0.15") + kClick;
    ASSERT_EQ(doToWindow(clicks), 0);
    std::vector<int> frames = framesIn(close().out);
    std::ranges::sort(frames);
    EXPECT_GE(std::ranges::unique(frames).begin() - frames.begin(), 2);
}

}  // namespace
