#include "bindings/cli/reference_run.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/report/metrics.h"
#include "bindings/cli/options.h"
#include "bindings/cli/progress.h"
#include "clv/math/hash.h"

namespace clv {
namespace {

// The shortest pass: enough for a first look at the variance.
constexpr std::uint64_t kFirstSamples = 16;
// As many paths a point must find no light before it counts as dark: what few of them meet has no error that is known.
constexpr std::uint64_t kDarkSamples = 64 << 10;

bool isDark(std::span<const ReferenceResult> results) {
    return std::ranges::all_of(results, [](const ReferenceResult& result) { return result.irradiance == glm::vec3(0.0f); });
}

// How long the next pass should be, given what `run` has found out; 0: the budget is spent.
std::uint64_t nextPass(const ReferenceBudget& budget, const ReferenceRun& run) {
    const double done = double(run.samplesPerPoint);
    double wanted = 0.0;
    if (budget.seconds > 0.0) {
        wanted = done * (budget.seconds - run.seconds) / run.seconds;
        if (wanted < double(kFirstSamples)) return 0;
    } else if (isDark(run.results)) {
        wanted = run.samplesPerPoint < kDarkSamples ? done : 0.0;
        if (wanted == 0.0) return 0;
    } else {
        const double excess = relativeStandardError(run.results) / budget.targetError;
        // No number of paths brings down an error that is no float.
        if (excess <= 1.0 || !std::isfinite(excess)) return 0;
        // The error falls with the root of the number of samples.
        wanted = done * (excess * excess - 1.0);
    }
    // At most doubled at a time: early guesses of speed and variance are poor.
    return std::uint64_t(std::clamp(wanted, double(kFirstSamples), done));
}

// Share of the budget that is spent while a pass of `passSamples` is done to the share `passShare`.
double spentShare(const ReferenceBudget& budget, const ReferenceRun& run, std::uint64_t passSamples, double passShare, double seconds) {
    if (budget.seconds > 0.0) return seconds / budget.seconds;
    const double done = double(run.samplesPerPoint) + passShare * double(passSamples);
    if (budget.targetError == 0.0) return done / double(budget.samples);
    const double excess = run.results.empty() ? 0.0 : relativeStandardError(run.results) / budget.targetError;
    return excess > 0.0 ? done / (double(run.samplesPerPoint) * excess * excess) : 0.0;
}

}  // namespace

void addReferenceBudget(CLI::App& command, ReferenceBudget& budget) {
    auto* samples = addCountOption(command, "--samples", budget.samples, "Paths a point");
    auto* seconds = addPositiveOption(command, "--seconds", budget.seconds, "Run time, s");
    auto* target = addPositiveOption(command, "--target-error", budget.targetError, "Relative standard error to reach");
    samples->excludes(seconds, target);
    seconds->excludes(target);
}

std::vector<glm::vec3> ReferenceRun::irradiance() const {
    std::vector<glm::vec3> values;
    for (const ReferenceResult& result : results) values.push_back(result.irradiance);
    return values;
}

std::vector<glm::vec3> ReferenceRun::standardError() const {
    std::vector<glm::vec3> values;
    for (const ReferenceResult& result : results) values.push_back(result.standardError);
    return values;
}

ReferenceRun runReference(const EmbreeScene& scene, std::span<const ReferencePoint> points, const ReferenceBudget& budget,
                          bool allBounces, std::uint32_t seed, const ParallelFor& parallelFor) {
    const bool inPasses = budget.seconds > 0.0 || budget.targetError > 0.0;
    Progress progress("path tracing");
    ReferenceRun run;
    std::vector<ReferenceResult> pass(points.size());
    std::uint64_t samples = inPasses ? kFirstSamples : budget.samples;
    for (std::uint32_t index = 0; samples > 0; ++index) {
        const ParallelFor watched = Progress::watch(parallelFor, [&](double share) {
            progress.update(spentShare(budget, run, samples, share, progress.seconds()));
        });
        const ReferenceOptions options{
            .allBounces = allBounces, .samplesPerPoint = samples, .seed = index == 0 ? seed : clvHashCombine(seed, index)};
        referenceIrradiance(scene, points, options, watched, pass);
        if (index == 0)
            run.results = pass;
        else
            joinPass(run.results, run.samplesPerPoint, pass, samples);
        run.samplesPerPoint += samples;
        run.seconds = progress.seconds();
        samples = inPasses ? nextPass(budget, run) : 0;
    }
    return run;
}

void joinPass(std::span<ReferenceResult> mean, std::uint64_t samples, std::span<const ReferenceResult> pass, std::uint64_t passSamples) {
    const float weight = float(double(passSamples) / double(samples + passSamples));
    for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i].irradiance = glm::mix(mean[i].irradiance, pass[i].irradiance, weight);
        // Squares of small and of large errors are no floats.
        const glm::dvec3 kept = double(1.0f - weight) * glm::dvec3(mean[i].standardError), added = double(weight) * glm::dvec3(pass[i].standardError);
        mean[i].standardError = glm::sqrt(kept * kept + added * added);
    }
}

double relativeStandardError(std::span<const ReferenceResult> results) {
    double squares = 0.0, sum = 0.0;
    for (const ReferenceResult& result : results) {
        const glm::dvec3 s(result.standardError), e(result.irradiance);
        squares += glm::dot(s, s);
        sum += e.x + e.y + e.z;
    }
    const double count = 3.0 * double(results.size());
    return relativeTo(std::sqrt(squares / count), sum / count);
}

double meanStandardError(std::span<const ReferenceResult> results) {
    double sum = 0.0;
    for (const ReferenceResult& result : results)
        sum += double(result.standardError.x) + double(result.standardError.y) + double(result.standardError.z);
    return sum / (3.0 * double(results.size()));
}

}  // namespace clv
