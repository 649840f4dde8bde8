// The z-test: do noisy estimates, each with its standard error, agree with what they should be?
#ifndef CLV_TESTS_SUPPORT_Z_TEST_H
#define CLV_TESTS_SUPPORT_Z_TEST_H
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace clv::test {

// Chance that a standard normal variable lies at least as far from 0.
inline double normalChance(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

// The standard normal deviate about as far out as `t` is under Student's distribution (Wallace 1959, equation 4.8 to first order):
// for standard errors that were themselves estimated, with few degrees of freedom.
inline double normalFromStudent(double t, double degreesOfFreedom) {
    const double bulk = (8.0 * degreesOfFreedom + 1.0) / (8.0 * degreesOfFreedom + 3.0);
    return std::copysign(bulk * std::sqrt(degreesOfFreedom * std::log1p(t * t / degreesOfFreedom)), t);
}

// The mean of independent values and its standard error.
class MeanOf {
public:
    void add(double value) {
        ++count_;
        const double step = value - mean_;
        mean_ += step / count_;
        squares_ += step * (value - mean_);
    }
    double mean() const { return mean_; }
    double standardError() const { return std::sqrt(squares_ / (count_ - 1.0) / count_); }
    double degreesOfFreedom() const { return count_ - 1.0; }

private:
    double count_ = 0.0, mean_ = 0.0, squares_ = 0.0;
};

// Collects comparisons and judges them together: each is held to the level (Sidak 1967) at which all of them pass by chance with
// probability 1 - falseAlarm when every expectation is true.
class ZTest {
public:
    explicit ZTest(double falseAlarm = 1e-3) : falseAlarm_(falseAlarm) {}

    // Degrees of freedom: of the standard error, where that is an estimate.
    void add(const std::string& what, double value, double expected, double standardError, double degreesOfFreedom) {
        const double t = (value - expected) / standardError;
        entries_.push_back({what, value, expected, standardError, normalFromStudent(t, degreesOfFreedom)});
    }
    void add(const std::string& what, const MeanOf& values, double expected) {
        add(what, values.mean(), expected, values.standardError(), values.degreesOfFreedom());
    }

    // Failure names every comparison that is out of bounds.
    testing::AssertionResult agrees() const {
        if (entries_.empty()) return testing::AssertionFailure() << "nothing was compared";
        const double level = 1.0 - std::pow(1.0 - falseAlarm_, 1.0 / double(entries_.size()));
        std::ostringstream failures;
        for (const Entry& e : entries_) {
            // Written so that NaN fails.
            if (normalChance(e.z) >= level) continue;
            failures << "\n  " << e.what << ": " << e.value << " +- " << e.standardError << ", expected " << e.expected << " (z = " << e.z << ")";
        }
        if (failures.str().empty()) return testing::AssertionSuccess();
        return testing::AssertionFailure() << "out of bounds:" << failures.str();
    }

private:
    struct Entry {
        std::string what;
        double value, expected, standardError, z;
    };
    double falseAlarm_;
    std::vector<Entry> entries_;
};

}  // namespace clv::test
#endif
