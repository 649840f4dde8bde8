// clv render: pictures of the light that a camera sees, and of its error.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "benchmarks/report/metrics.h"
#include "benchmarks/report/picture.h"
#include "bindings/cli/camera_view.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/light_options.h"
#include "bindings/cli/options.h"
#include "bindings/cli/pipeline.h"
#include "bindings/cli/progress.h"
#include "bindings/cli/reference_run.h"
#include "bindings/cli/staged_output.h"
#include "bindings/image/heat_map.h"
#include "bindings/image/tone_map.h"

namespace clv {
namespace {

constexpr int kMaxPictureSide = 16384;
// Pixels on the side of a block of the error map: 64 pixels cut the noise of the reference to an eighth.
constexpr int kErrorBlock = 8;
// Pixels at which errors are measured with a reference of its own, exact enough for that.
constexpr std::size_t kMeasuredPixels = 2048;

// Per surface, in the order of the pixels; W/m^2.
struct SurfaceLight {
    std::vector<glm::vec3> direct, indirect, reference;
};

std::vector<glm::vec3> sum(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    std::vector<glm::vec3> values(a.size());
    std::ranges::transform(a, b, values.begin(), std::plus<>());
    return values;
}

std::vector<glm::vec3> directLight(const EmbreeScene& scene, std::span<const ReferencePoint> points, const ParallelFor& parallelFor) {
    constexpr std::size_t kPiece = 1024;
    Progress progress("direct light");
    std::vector<glm::vec3> irradiance(points.size());
    Progress::watch(parallelFor, [&](double share) { progress.update(share); })((points.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
        for (std::size_t i = piece * kPiece; i < std::min(points.size(), (piece + 1) * kPiece); ++i)
            irradiance[i] = directIrradiance(scene, points[i].position, points[i].normal);
    });
    return irradiance;
}

// The four pictures and the map of the error, ready to be written.
class Pictures {
public:
    Pictures(int width, int height, std::span<const VisibleSurface> surfaces, const SurfaceLight& light) {
        const auto picture = [&](const std::vector<glm::vec3>& irradiance) { return radianceImage(width, height, surfaces, irradiance); };
        pictures_ = {{"direct", picture(light.direct)},
                     {"indirect", picture(light.indirect)},
                     {"combined", picture(sum(light.direct, light.indirect))},
                     {"reference", picture(sum(light.direct, light.reference))}};
        exposure_ = autoExposure(pictures_.back().image);

        const std::vector<float> errors = blockErrors(width, height, kErrorBlock, surfaces, light.indirect, light.reference);
        std::vector<float> seen;
        std::ranges::copy_if(errors, std::back_inserter(seen), [](float error) { return std::isfinite(error); });
        const double p95 = percentile95(seen);
        errorTop_ = p95 > 0.0 ? niceCeiling(p95) : 1.0;
        errorMap_ = heatMap(errors, width, height, errorTop_);
    }

    float exposure() const { return exposure_.scale; }
    double errorTop() const { return errorTop_; }

    // Returns the names of the files.
    std::vector<std::string> write(StagedOutput& output) const {
        std::vector<std::string> names;
        const auto stage = [&](const std::string& name) { return output.path(names.emplace_back(name)); };
        for (const Picture& picture : pictures_) {
            writeExr(picture.image, stage(picture.name + ".exr"));
            writePng(toneMap(picture.image, exposure_), stage(picture.name + ".png"));
        }
        writePng(errorMap_, stage("error.png"));
        return names;
    }

private:
    struct Picture {
        std::string name;
        Image image;
    };
    std::vector<Picture> pictures_;
    Image errorMap_;
    Exposure exposure_;
    double errorTop_ = 1.0;
};

// Every so many-th of the values, kMeasuredPixels of them at most.
template <class Value>
std::vector<Value> measuredOf(const std::vector<Value>& values) {
    const std::size_t count = std::min(kMeasuredPixels, values.size());
    std::vector<Value> picked;
    for (std::size_t i = 0; i < count; ++i) picked.push_back(values[i * values.size() / count]);
    return picked;
}

struct RenderCommand {
    CommonOptions common;
    SceneOptions scene;
    LightOptions light;
    std::uint64_t samples = 64;         // of the reference, a pixel
    std::uint64_t errorSamples = 8192;  // where errors are measured, a pixel
    std::string camera = "0", out;
    int width = 640, height = 0;  // pixels; height 0: follows from the camera

    int rowsOf(const Camera& view) const {
        const double rows = std::round(double(width) / double(view.aspect));
        if (!(rows >= 1.0 && rows <= kMaxPictureSide))
            throw InputError(fmt::format("{}: camera '{}': expected an aspect ratio that makes 1 to {} rows of {} pixels, or --height; {:g} makes {:g}", scene.scene, view.name,
                                         kMaxPictureSide, width, view.aspect, rows));
        return int(rows);
    }

    void run(const CLI::App& command) const {
        Report report = startReport(command, common, true);
        const Scene loaded = loadScene(scene, report);
        const Camera& view = chooseCamera(loaded, camera);
        const int rows = height > 0 ? height : rowsOf(view);
        StagedOutput output(outputFolder(out));

        const ParallelFor parallelFor = parallelForOf(common);
        const EmbreeScene embree(loaded);
        const std::vector<VisibleSurface> surfaces = visibleSurfaces(embree, view, width, rows, parallelFor);
        if (surfaces.empty()) throw InputError(fmt::format("--camera {}: it looks past the scene; expected surfaces in sight", camera));
        const std::vector<ReferencePoint> points = pointsOf(surfaces);
        std::vector<glm::vec3> indirect(points.size());
        const PipelineReport run = lightPoints(loaded, light, common.seed, parallelFor, points, indirect);
        const SurfaceLight lit{directLight(embree, points, parallelFor), std::move(indirect),
                               runReference(embree, points, {.samples = samples}, light.allBounces, common.seed, parallelFor).irradiance()};
        const ReferenceRun truth =
            runReference(embree, measuredOf(points), {.samples = errorSamples}, light.allBounces, common.seed, parallelFor);

        const Pictures pictures(width, rows, surfaces, lit);
        const std::vector<std::string> names = pictures.write(output);
        output.commit();

        report["camera"] = view.name;
        report["size"] = {width, rows};
        report["bounces"] = light.allBounces ? "all" : "one";
        report["exposure"] = pictures.exposure();
        report["error_map_top"] = pictures.errorTop();
        const ErrorSummary errors = summarizeErrors(measuredOf(lit.indirect), truth.irradiance());
        report["errors"] = {{"relative_rmse", errors.relativeRmse},
                            {"bias", errors.bias},
                            {"p95", errors.p95},
                            {"pixels", truth.results.size()},
                            {"relative_standard_error", relativeStandardError(truth.results)}};
        reportLight(run, report);
        report["out"] = out;
        report["files"] = names;
        printReport(report, common);
    }
};

}  // namespace

void addRenderCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Render direct, indirect, combined and reference light, and the error");
    auto options = std::make_shared<RenderCommand>();
    addSceneOptions(*command, options->scene, false);
    command->add_option("--out", options->out, "Folder for the pictures; made where it is missing")->required();
    command->add_option("--camera", options->camera, "Camera to look through, by name or index")->capture_default_str();
    command->add_option("--width", options->width, "Pixels")->check(CLI::Range(1, kMaxPictureSide))->capture_default_str();
    command->add_option("--height", options->height, "Pixels; default: from the width and the camera")->check(CLI::Range(1, kMaxPictureSide));
    addLightOptions(*command, options->light);
    addCountOption(*command, "--samples", options->samples, "Paths a pixel of the reference picture");
    addCountOption(*command, "--error-samples", options->errorSamples, "Paths a pixel where errors are measured");
    addCommonOptions(*command, options->common);
    command->callback([options, command] {
        options->light.backend.choice = options->common.backend;
        options->run(*command);
    });
}

}  // namespace clv
