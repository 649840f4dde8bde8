#include "viz/run.h"

#include <CLI/App.hpp>

#include "bindings/cli/exit_status.h"
#include "bindings/cli/options.h"
#include "viz/benchmark.h"
#include "viz/camera_pose.h"
#include "viz/describe.h"
#include "viz/inspector.h"
#include "viz/options.h"

namespace clv {
namespace {

// Of the file, or as live light leaves it.
BakedVolume volumeOf(const VizOptions& options) {
    const ParallelFor parallelFor = parallelForOf({.threads = options.threads});
    if (!options.live.on) return Series(options.file).load(options.frame, parallelFor);
    const auto pane = options.file.empty() ? std::make_unique<Pane>(options.scene) : std::make_unique<Pane>(options.file, options.scene, options.frame, parallelFor);
    const auto view = [&] {
        const Scene& scene = pane->world()->scene();
        return cameraOf(options.camera.empty() ? overview(scene.bounds, float(options.width) / float(options.height)) : parsePose(options.camera, pane->volume(), &scene));
    };
    LiveMode live(*pane, options.live, view, parallelFor);
    for (int frame = 0; frame < options.live.frames; ++frame) live.frame();
    return pane->volume();
}

void printPicks(const VizOptions& options) {
    const BakedVolume volume = volumeOf(options);
    for (const std::vector<double>& numbers : options.picks) printPick(volume, typedPick(numbers, volume, options.view.cascade), options.view.lookup);
}

void run(const VizOptions& options) {
    check(options);
    if (!options.picks.empty()) printPicks(options);
    if (!options.picks.empty() && options.out.empty()) return;
    if (options.benchmark) return benchmarkViewer(options);
    if (options.out.empty() && !displayAnswers()) throw InputError("no display answers; expected DISPLAY to name one, or --out FILE.png");
    Inspector inspector(options);
    if (options.out.empty()) {
        inspector.interact();
    } else {
        inspector.writePicture(options.out);
    }
}

}  // namespace

int runViz(int argc, const char* const* argv) {
    CLI::App app("The inspector of light volumes: every cell, its six sides and what surfaces read from it.", "clv-viz");
    app.set_version_flag("--version", CLV_VERSION);
    VizOptions options;
    addVizOptions(app, options);
    return exitStatusOf(app, argc, argv, [&] { run(options); });
}

}  // namespace clv
