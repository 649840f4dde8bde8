// A bar on the terminal for work that lasts.
#pragma once
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

#include "clv/cpu/parallel.h"

namespace clv {

// ", 2:05 left": minutes and seconds at the pace so far; nothing while that says little.
std::string timeLeftText(double seconds, double share);

// Shows nothing unless stderr is a terminal and a second has gone by; wipes itself off at the end.
class Progress {
public:
    explicit Progress(std::string label);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // Share of the work that is done, [0, 1]. May be called from several threads.
    void update(double share);
    // A parallelFor that calls `onItem` with the share of its items that are done, after each of them.
    static ParallelFor watch(ParallelFor inner, std::function<void(double)> onItem);

    double seconds() const;  // since construction

private:
    using Clock = std::chrono::steady_clock;

    std::string label_;
    bool terminal_;
    Clock::time_point start_, nextDraw_;
    std::mutex mutex_;
    bool drawn_ = false;
};

}  // namespace clv
