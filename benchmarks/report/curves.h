// What measurements say together: curves, the best of them, and how error falls with work.
#pragma once
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/measurement.h"

namespace clv {

// The method that is this library.
inline constexpr const char* kLibraryName = "clv";

// Measurements of one scene and one method, with its settings or of one kind, by rising work.
struct Curve {
    std::string name;
    std::string method;
    std::vector<const Measurement*> points;
};

// Names of the scenes, in their order.
std::vector<std::string> scenesOf(std::span<const Measurement> all);
// In the order of their first measurements. `all` must outlive them.
std::vector<Curve> curvesOf(std::span<const Measurement> all, const std::string& scene);

// One for each kind of method: what a reader chooses among before any setting. Their names say light for receivers anywhere apart from
// that on surfaces, and the chosen resolution apart from fixed ones.
std::vector<Curve> kindsOf(std::span<const Measurement> all, const std::string& scene);

// Short names: of a method's settings those that tell its curves apart.
class CurveLabels {
public:
    explicit CurveLabels(std::span<const Measurement> all);

    std::string curve(const Measurement& m) const;
    // With rays and frames: "ddgi (resolution 16), 4 frames of 64k rays"; with frames alone where no rays are traced.
    std::string setting(const Measurement& m) const;

private:
    std::map<std::string, std::set<std::string>> telling_;  // names of settings, a method each
};

using Points = std::vector<const Measurement*>;
Points pointsOf(std::span<const Curve> curves);

// Those that no other beats in both time and error, by rising time, of those that serve so few as `readers` receivers of the light.
Points paretoFront(const Points& points, double readers);

// The one that errs least within `seconds`, or nullptr.
const Measurement* bestWithin(const Points& points, double seconds, double readers);

// Least run time to come to this relative RMSE: along the front, a straight line in logarithms between its points. Nothing where no
// point errs as little; the first point's time where all err less.
std::optional<double> secondsToReach(const Points& points, double error, double readers);

// error^2 = floor^2 + (factor * work^slope)^2.
struct ErrorFall {
    double floor = 0.0, factor = 0.0, slope = 0.0;

    double at(double work) const;
};
// Fits it to at least three pairs in logarithms; nothing for fewer, or where one has no logarithm.
std::optional<ErrorFall> fitErrorFall(std::span<const double> work, std::span<const double> errors);

}  // namespace clv
