#include "benchmarks/report/runner.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include <malloc.h>

#include <fmt/format.h>

#include "benchmarks/report/checksum.h"
#include "benchmarks/report/measurement_file.h"
#include "benchmarks/report/picture.h"
#include "benchmarks/report/statistics.h"
#include "bindings/cli/stage_clock.h"

namespace clv {
namespace {

namespace fs = std::filesystem;

// Where the truth is below this share of its mean, light is a leak.
constexpr float kDarkShare = 0.1f;
// What set-up takes beside rays, in rays: for the share of the work that is done.
constexpr double kSetupRays = 4e6;

// Mean of the estimate over that of the truth where the truth is dark; nothing where it is dark nowhere.
std::optional<double> leakOf(std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth) {
    const double threshold = kDarkShare * meanIrradiance(truth);
    std::vector<glm::vec3> darkEstimate, darkTruth, litEstimate;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const bool dark = (truth[i].x + truth[i].y + truth[i].z) / 3.0f < threshold;
        (dark ? darkEstimate : litEstimate).push_back(estimate[i]);
        if (dark) darkTruth.push_back(truth[i]);
    }
    if (darkTruth.empty()) return {};
    return leak(darkEstimate, darkTruth, litEstimate);
}

fs::path pictureNamed(const fs::path& folder, const std::string& key) {
    Checksum sum;
    sum.add(key);
    return folder / "pictures" / fmt::format("{:016x}.exr", sum.value());
}

// Figures of the repeats of one measurement.
struct Repeats {
    std::vector<double> rmse, bias, p95, leaks, maps, frames, lookups;

    void summarize(Measurement& m) const {
        const auto mean = [](const std::vector<double>& values) {
            double sum = 0.0;
            for (const double v : values) sum += v / double(values.size());
            return sum;
        };
        const RootMeanSquare root = rootMeanSquare(rmse);
        m.errors = {root.value, mean(bias), mean(p95)};
        m.errorInterval = root.interval;
        if (!leaks.empty()) m.leak = mean(leaks);
        m.mapSeconds = median(maps);
        m.frameSeconds = median(frames);
        m.frameSecondsLeast = *std::ranges::min_element(frames);
        m.frameSecondsSpread = middleHalf(frames);
        m.lookupSeconds = median(lookups);
    }
};

// Memory that is given back serves what comes next, so that no repeat pays for new pages, whatever its method.
void keepMemoryWarm() {
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

class Runner {
public:
    Runner(const ReportPlan& plan, const fs::path& folder, const ParallelFor& parallelFor, const std::function<void(double)>& onProgress)
        : plan_(plan), folder_(folder), parallelFor_(parallelFor), onProgress_(onProgress), file_(folder / "measurements.jsonl") {
        fs::create_directory(folder_ / "truths");
        fs::create_directory(folder_ / "pictures");
        for (const std::string& scene : plan_.scenes) {
            for (const MethodCase& one : plan_.cases) work_ += workOf(scene, one);
            if (isAsked(scene)) work_ += truthWork();
        }
    }

    std::vector<Measurement> run() {
        std::vector<Measurement> all;
        for (const std::string& name : plan_.scenes) {
            if (isAsked(name)) measureScene(name);
            for (const MethodCase& one : plan_.cases) {
                for (const Measurement& m : askedOf(name, one)) all.push_back(*file_.find(m.key));
            }
        }
        return all;
    }

private:
    // What a case is to measure in a scene: all but the figures.
    std::vector<Measurement> askedOf(const std::string& scene, const MethodCase& one) const {
        const auto method = one.make();
        std::vector<Measurement> asked;
        for (const std::uint64_t rays : one.rays) {
            for (const int frames : one.frames) {
                Measurement m;
                m.scene = scene, m.method = method->name(), m.settings = method->settings(), m.rays = rays, m.frames = frames;
                m.key = fmt::format("{}; {}; {} rays, {} frames; {} points, {} pixels across, {} paths, {} repeats from seed {}; {}", scene, curveName(m), rays, frames,
                                    plan_.truth.points, plan_.truth.pictureWidth, plan_.truth.samples, repeatsOf(one), plan_.seed, plan_.program);
                asked.push_back(m);
            }
        }
        return asked;
    }
    int repeatsOf(const MethodCase& one) const { return one.repeats > 0 ? one.repeats : plan_.repeats; }
    bool isMissing(const Measurement& m) const { return !file_.find(m.key); }
    // Rays to trace, about.
    double workOf(const std::string& scene, const MethodCase& one) const {
        double rays = 0.0;
        for (const Measurement& m : askedOf(scene, one)) {
            if (isMissing(m)) rays += (repeatsOf(one) + 1.0) * double(m.rays) * m.frames;
        }
        return rays > 0.0 ? rays + kSetupRays : 0.0;
    }

    bool isAsked(const std::string& scene) const {
        return std::ranges::any_of(plan_.cases, [&](const MethodCase& one) { return workOf(scene, one) > 0.0; });
    }
    // The same of the truth, for a picture as most cameras have it.
    double truthWork() const {
        const double across = plan_.truth.pictureWidth, pixels = across * across * kPictureHeight / kPictureWidth;
        return (double(plan_.truth.points) + pixels) * double(plan_.truth.samples);
    }

    void measureScene(const std::string& name) {
        const Scene scene = loadScene(name);
        const EmbreeScene embree(scene);
        const SceneTruth truth = findTruth(embree, plan_.truth, folder_ / "truths", parallelFor_, [&](double share) { onProgress_((done_ + share * truthWork()) / work_); });
        done_ += truthWork();
        writePicture(truth.irradiance, truth, truthPictureFile(folder_, plan_, name));
        for (const MethodCase& one : plan_.cases) {
            const double work = workOf(name, one);
            if (work > 0.0) measureCase(one, askedOf(name, one), embree, truth);
            done_ += work;
            onProgress_(done_ / work_);
        }
    }

    void measureCase(const MethodCase& one, const std::vector<Measurement>& asked, const EmbreeScene& embree, const SceneTruth& truth) {
        const MethodWorld world{embree, parallelFor_};
        const auto method = one.make();
        const double setup = StageClock::secondsOf([&] { method->prepare(world, truth.receivers); });
        for (const std::uint64_t rays : one.rays) {
            std::vector<Measurement> some;
            std::ranges::copy_if(asked, std::back_inserter(some), [&](const Measurement& m) { return m.rays == rays && isMissing(m); });
            if (some.empty()) continue;
            measureRays(*method, repeatsOf(one), some, truth);
            for (Measurement& m : some) {
                m.setupSeconds = setup;
                file_.add(m);
            }
        }
    }

    // Measurements that differ by their number of frames alone.
    void measureRays(Method& method, int count, std::vector<Measurement>& some, const SceneTruth& truth) {
        std::vector<Repeats> repeats(some.size());
        std::vector<glm::vec3> irradiance(truth.receivers.size());
        const int frames = some.back().frames;
        method.restart(plan_.seed);
        method.renderMaps();
        method.frame(some.front().rays);
        method.irradiance(irradiance);
        for (int repeat = 0; repeat < count; ++repeat) {
            method.restart(plan_.seed + std::uint32_t(repeat));
            double maps = 0.0, light = 0.0;
            for (int frame = 1; frame <= frames; ++frame) {
                maps += StageClock::secondsOf([&] { method.renderMaps(); });
                light += StageClock::secondsOf([&] { method.frame(some.front().rays); });
                const auto m = std::ranges::find(some, frame, &Measurement::frames);
                if (m == some.end()) continue;
                Repeats& figures = repeats[std::size_t(m - some.begin())];
                figures.maps.push_back(maps);
                figures.frames.push_back(light);
                const auto readAll = [&] { method.irradiance(irradiance); };
                const double lookups = StageClock::secondsOf(readAll);
                figures.lookups.push_back(method.picturePixels() > 0 ? StageClock::secondsOf([&] { method.readPicture(); }) : lookups);
                judge(irradiance, truth, figures);
                if (repeat == 0) judgeOnce(method, irradiance, truth, *m);
            }
        }
        for (std::size_t i = 0; i < some.size(); ++i) repeats[i].summarize(some[i]);
    }

    static void judge(std::span<const glm::vec3> irradiance, const SceneTruth& truth, Repeats& figures) {
        const auto estimate = truth.atPoints(irradiance), expected = truth.atPoints(truth.irradiance);
        const ErrorSummary errors = summarizeErrors(estimate, expected);
        figures.rmse.push_back(errors.relativeRmse);
        figures.bias.push_back(errors.bias);
        figures.p95.push_back(errors.p95);
        if (const auto share = leakOf(estimate, expected)) figures.leaks.push_back(*share);
    }
    void judgeOnce(const Method& method, std::span<const glm::vec3> irradiance, const SceneTruth& truth, Measurement& m) const {
        m.truthError = truth.error;
        m.wholePicture = method.picturePixels() > 0;
        m.receivers = m.wholePicture ? method.picturePixels() : truth.receivers.size();
        m.sharesRays = method.sharesRays();
        m.raysTraced = method.raysTraced();
        m.bytes = method.bytes();
        const auto radiance = [&](std::span<const glm::vec3> all) { return radianceImage(truth.width, truth.height, truth.surfaces, truth.inPicture(all)); };
        m.picture = compareImages(radiance(irradiance), radiance(truth.irradiance));
        writePicture(irradiance, truth, pictureFile(folder_, m));
    }
    static void writePicture(std::span<const glm::vec3> irradiance, const SceneTruth& truth, const fs::path& file) {
        Image picture(truth.width, truth.height, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        for (std::size_t i = 0; i < truth.surfaces.size(); ++i) picture.pixels[truth.surfaces[i].pixel] = truth.inPicture(irradiance)[i];
        writeExr(picture, file.string());
    }

    const ReportPlan& plan_;
    const fs::path folder_;
    const ParallelFor& parallelFor_;
    const std::function<void(double)>& onProgress_;
    MeasurementFile file_;
    double work_ = 0.0, done_ = 0.0;
};

}  // namespace

std::vector<Measurement> measureAll(const ReportPlan& plan, const fs::path& folder, const ParallelFor& parallelFor,
                                    const std::function<void(double)>& onProgress) {
    keepMemoryWarm();
    return Runner(plan, folder, parallelFor, onProgress).run();
}

fs::path pictureFile(const fs::path& folder, const Measurement& m) {
    return pictureNamed(folder, m.key);
}

fs::path truthPictureFile(const fs::path& folder, const ReportPlan& plan, const std::string& scene) {
    return pictureNamed(folder, fmt::format("{}; {} pixels across, {} paths", scene, plan.truth.pictureWidth, plan.truth.samples));
}

}  // namespace clv
