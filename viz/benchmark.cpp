#include "viz/benchmark.h"

#include <algorithm>

#include <fmt/format.h>
#include <sys/resource.h>
#include <vtkRenderer.h>

#include "bindings/cli/stage_clock.h"
#include "viz/inspector.h"

namespace clv {
namespace {

constexpr int kFrames = 36;

// s of processor time that all threads have taken.
double processorSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// The most that this process has held so far.
double peakMebibytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024.0;
}

// VTK loads its drivers and fonts with the first window.
void startVtk(const VizOptions& options) {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
    window->AddRenderer(renderer);
    window->SetSize(options.width, options.height);
    window->Render();
}

}  // namespace

void benchmarkViewer(const VizOptions& options) {
    const VirtualDisplay display;
    const double start = StageClock::secondsOf([&] { startVtk(options); });
    const double before = peakMebibytes();
    std::optional<Inspector> inspector;
    const double open = StageClock::secondsOf([&] {
        inspector.emplace(options);
        inspector->turn(0.0);
    });
    const double processorBefore = processorSeconds();
    std::vector<double> frames;
    for (int k = 0; k < kFrames; ++k) frames.push_back(StageClock::secondsOf([&] { inspector->turn(360.0 / kFrames); }));
    const double processor = (processorSeconds() - processorBefore) / kFrames;
    std::ranges::sort(frames);
    const double volume = double(bytesOf(inspector->pane().volume())) / (1 << 20), more = peakMebibytes() - before;
    fmt::print("VTK starts in {:.2f} s\nopens in {:.2f} s more\n", start, open);
    fmt::print("turns at {:.1f} frames/s: {:.1f} ms a frame, {:.1f} to {:.1f} ms\n", 1.0 / frames[kFrames / 2], 1e3 * frames[kFrames / 2], 1e3 * frames.front(), 1e3 * frames.back());
    fmt::print("takes {:.1f} ms of processor time a frame\n", 1e3 * processor);
    fmt::print("volume {:.1f} MiB; takes {:.1f} MiB beside VTK, {:.2f} times as much\n", volume, more, more / volume);
}

}  // namespace clv
