#include "viz/figures.h"

#include <map>

#include "viz/series.h"

namespace clv {
namespace {

constexpr std::size_t kFigureRays = 400;

// 3.1: rays from the lights' maps through the scene, in the colour of what they carry.
void showRays(VizOptions& options) {
    options.view.subject = Subject::rays;
    options.view.rays = kFigureRays;
    options.view.lights = true;
}

// 3.2: what the cells hold, as ambient cubes among the scene's edges.
void showCubes(VizOptions& options) {
    options.view.subject = Subject::cubes;
    options.view.wireframe = true;
}

// 3.3: which sides of the cells will give way quickly; in the first frame of a series nothing has moved yet.
void showDynamicity(VizOptions& options) {
    options.view.subject = Subject::dynamicity;
    options.view.wireframe = true;
    options.view.range = {0.0, 1.0};
    options.frame = kLastFrame;
}

// 4.1: what the first camera sees, under direct light alone and with indirect light.
void showWithAndWithout(VizOptions& options) {
    options.view.subject = Subject::mesh;
    options.view.direct = true;
    options.view.boxes = false;
    options.without = true;
    options.camera = "0";
}

// 4.3: indirect light alone, from the same place.
void showIndirect(VizOptions& options) {
    showWithAndWithout(options);
    options.view.direct = false;
    options.without = false;
}

}  // namespace

void addFigureOption(CLI::App& app, VizOptions& options) {
    static const std::map<std::string, void (*)(VizOptions&)> kFigures = {
        {"3.1", showRays}, {"3.2", showCubes}, {"3.3", showDynamicity}, {"4.1", showWithAndWithout}, {"4.3", showIndirect}};
    app.add_option_function<std::string>("--figure", [&options](const std::string& name) { kFigures.at(name)(options); },
                                         "Redraw a figure of the thesis: 3.1 rays, 3.2 cubes, 3.3 dynamicity, 4.1 without and with indirect light, 4.3 indirect light")
        ->check(CLI::IsMember(kFigures))
        ->trigger_on_parse();
}

}  // namespace clv
