// The command line of clv-viz.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "viz/live_settings.h"
#include "viz/view.h"

namespace clv {

struct VizOptions {
    std::string file;        // a .vtm, or a .pvd of a series
    std::string other;       // a second one beside it, or empty
    bool without = false;    // show the view without indirect light on its left
    bool truth = false;      // show what path tracing says on its right
    bool difference = false; // show how the first differs in place of the second
    std::string scene;       // in place of the one that the volume names, or empty
    View view;
    std::string camera;      // by name or index, or numbers; empty: looks at the whole volume from outside
    int width = 1280, height = 720;  // pixels
    std::vector<std::vector<double>> picks;  // positions, m, world space, or positions and normals
    std::string out;         // picture to write in place of opening a window, or empty
    LiveOptions live;        // compute the light here, frame by frame
    bool benchmark = false;  // say how fast it opens and turns, in place of opening a window
    std::size_t frame = 0;   // of a series, from 0; or kLastFrame
    bool play = false;       // the frames of a series, one after the other
    int threads = 0;         // 0: all of the machine's
};
void addVizOptions(CLI::App& app, VizOptions& options);
void addLiveOptions(CLI::App& app, LiveOptions& options);
// Throws InputError where options do not go together.
void check(const VizOptions& options);

}  // namespace clv
