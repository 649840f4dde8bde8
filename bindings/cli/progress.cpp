#include "bindings/cli/progress.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "bindings/cli/standard_streams.h"

namespace clv {
namespace {

constexpr std::chrono::milliseconds kQuietTime(1000), kRedrawTime(100);
// From here on the pace so far foretells the rest, s.
constexpr double kPaceTime = 10.0;
constexpr int kBarWidth = 30;
// Back to the first column, and erase from there to the line's end.
constexpr const char* kWipe = "\r\x1b[K";

}  // namespace

Progress::Progress(std::string label)
    : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), nextDraw_(start_ + kQuietTime) {}

Progress::~Progress() {
    if (drawn_) writeStderr(kWipe);
}

double Progress::seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string timeLeftText(double seconds, double share) {
    if (seconds < kPaceTime || share <= 0.0) return "";
    const long left = std::lround(seconds * (1.0 - share) / share);
    return fmt::format(", {}:{:02} left", left / 60, left % 60);
}

void Progress::update(double share) {
    if (!terminal_) return;
    // Whoever finds another thread drawing has nothing to add.
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || Clock::now() < nextDraw_) return;
    share = std::clamp(share, 0.0, 1.0);
    const int filled = int(std::lround(share * kBarWidth));
    writeStderr(fmt::format("{}{} [{:=<{}}{:<{}}] {:3.0f} %{}", kWipe, label_, "", filled, "", kBarWidth - filled, 100.0 * share, timeLeftText(seconds(), share)));
    drawn_ = true;
    nextDraw_ = Clock::now() + kRedrawTime;
}

ParallelFor Progress::watch(ParallelFor inner, std::function<void(double)> onItem) {
    return [inner = std::move(inner), onItem = std::move(onItem)](std::size_t count, const std::function<void(std::size_t)>& body) {
        std::atomic<std::size_t> done = 0;
        inner(count, [&](std::size_t i) {
            body(i);
            onItem(double(++done) / double(count));
        });
    };
}

}  // namespace clv
