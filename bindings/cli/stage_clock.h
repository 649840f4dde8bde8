// Run time by stage.
#pragma once
#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace clv {

class StageClock {
public:
    using Stages = std::vector<std::pair<std::string, double>>;

    template <class Body>
    void time(const std::string& stage, Body&& body) {
        add(stage, secondsOf(body));
    }
    void add(const std::string& stage, double seconds) {
        const auto found = std::ranges::find(stages_, stage, &Stages::value_type::first);
        if (found == stages_.end()) {
            stages_.emplace_back(stage, seconds);
        } else {
            found->second += seconds;
        }
    }
    double of(std::initializer_list<const char*> names) const {
        double sum = 0.0;
        for (const char* name : names) {
            const auto found = std::ranges::find(stages_, name, &Stages::value_type::first);
            if (found != stages_.end()) sum += found->second;
        }
        return sum;
    }
    // s a stage, in the order in which they were first seen.
    const Stages& stages() const { return stages_; }

    template <class Body>
    static double secondsOf(Body&& body) {
        const auto begin = std::chrono::steady_clock::now();
        body();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

private:
    Stages stages_;
};

}  // namespace clv
