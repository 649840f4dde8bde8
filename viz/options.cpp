#include "viz/options.h"

#include <algorithm>
#include <limits>
#include <map>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include "bindings/cli/options.h"
#include "viz/figures.h"

namespace clv {
namespace {

constexpr int kMostPixels = 16384, kMostThreads = 1024;
constexpr double kNormalSlack = 1e-3;  // by which a normal may miss unit length
constexpr std::size_t kMostRays = 1000000;

double numberOf(const std::string& option, const std::string& text) {
    double number = 0.0;
    if (!CLI::detail::lexical_cast(text, number) || !std::isfinite(number)) throw InputError(fmt::format("{}: expected a number, found \"{}\"", option, text));
    return number;
}

std::vector<double> pickOf(const std::string& text) {
    std::vector<double> numbers;
    for (const std::string& part : CLI::detail::split(text, ',')) numbers.push_back(numberOf("--pick", part));
    const bool normal = numbers.size() == 6 && std::abs(std::hypot(numbers[3], numbers[4], numbers[5]) - 1.0) < kNormalSlack;
    if (numbers.size() != 3 && !normal) throw InputError(fmt::format("--pick: expected x,y,z or x,y,z,nx,ny,nz with a unit normal, found \"{}\"", text));
    return numbers;
}

std::pair<glm::dvec3, glm::dvec3> probeOf(const std::string& text) {
    std::vector<double> n;
    for (const std::string& part : CLI::detail::split(text, ',')) n.push_back(numberOf("--probe", part));
    if (n.size() != 6) throw InputError(fmt::format("--probe: expected two places, ax,ay,az,bx,by,bz, found \"{}\"", text));
    return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

SlicePlane sliceOf(const std::string& text) {
    const bool named = text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=';
    if (!named) throw InputError(fmt::format("--slice: expected a place such as z=1.2, m, found \"{}\"", text));
    return {text[0] - 'x', numberOf("--slice", text.substr(2))};
}

void parseSize(const std::string& text, VizOptions& options) {
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &rest) != 2 || std::min(options.width, options.height) < 1 ||
        std::max(options.width, options.height) > kMostPixels)
        throw InputError(fmt::format("--size: expected pixels such as 1280x720, at most {} each, found \"{}\"", kMostPixels, text));
}

void addWhat(CLI::App& app, VizOptions& options) {
    View& view = options.view;
    std::vector<std::string> names;
    for (int i = 0; i < kSubjects; ++i) names.push_back(nameOf(Subject(i)));
    app.add_option_function<std::string>("--view", [&view](const std::string& name) { view.subject = subjectOf(name); },
                                         "What to look at; cubes: irradiance on six sides; error: against path tracing")
        ->check(CLI::IsMember(names))
        ->default_str("cubes");
    static const std::map<std::string, Carrier> kCarriers = {{"cells", Carrier::cells}, {"slices", Carrier::slices}, {"volume", Carrier::volume}, {"surfaces", Carrier::surfaces}};
    app.add_option_function<std::string>("--on", [&view](const std::string& name) { view.carrier = kCarriers.at(name); },
                                         "What carries the colours of a quantity; surfaces: of the error alone")
        ->check(CLI::IsMember(kCarriers))
        ->default_str("slices with --slice; else of the error surfaces, of all others cells");
    app.add_option_function<std::vector<std::string>>(
           "--slice",
           [&view](const std::vector<std::string>& places) {
               for (const std::string& place : places) view.slices.push_back(sliceOf(place));
           },
           "Planes across the axes, m: x=0.5 z=1.2")
        ->take_all();
    app.add_option_function<uint>("--cascade", [&view](uint cascade) { view.cascade = cascade; }, "Show the cells of this cascade alone, from 0, the finest");
    app.add_option("--threshold", view.threshold, "Leave out cubes none of whose sides receives as much, W/m^2; 0: none")
        ->check(finiteNumber(-std::numeric_limits<double>::min(), std::numeric_limits<float>::max(), "an irradiance, 0 or more"))
        ->default_str("any light");
    app.add_option_function<std::array<double, 2>>("--range", [&view](const std::array<double, 2>& range) {
        if (!(range[0] < range[1])) throw InputError(fmt::format("--range: expected a smaller number and a larger one, found {},{}", range[0], range[1]));
        view.range = {range[0], range[1]};
    }, "Values at the ends of the colour bar: LO,HI")->delimiter(',');
    app.add_option_function<std::string>("--probe", [&view](const std::string& text) { view.probe = probeOf(text); }, "Plot the quantity along a line: ax,ay,az,bx,by,bz (m)");
    app.add_flag("--histogram", view.histogram, "Plot how often the quantity has which value");
}

void addBeside(CLI::App& app, View& view) {
    app.add_flag("--mesh", view.mesh, "Draw the scene's surfaces beside the view");
    app.add_flag("--wireframe", view.wireframe, "Draw the edges of the scene's triangles");
    app.add_flag("!--no-boxes", view.boxes, "Draw no boxes around the cascades");
    app.add_flag("--frustum", view.frustum, "Draw what the volume's camera sees, or the scene's first one");
    app.add_flag("--lights", view.lights, "Draw the lights");
    app.add_flag("--texels", view.texels, "Draw the lit texels of the lights' maps");
    app.add_option("--rays", view.rays, "Draw so many rays from the lights' maps")->check(CLI::Range(std::size_t(0), kMostRays));
    static const std::map<std::string, RayColor> kRayColors = {{"flux", RayColor::flux}, {"dynamicity", RayColor::dynamicity}};
    app.add_option_function<std::string>("--rays-by", [&view](const std::string& name) { view.rayColor = kRayColors.at(name); }, "What colours the rays")
        ->check(CLI::IsMember(kRayColors))
        ->default_str("flux");
    app.add_flag("!--no-indirect", view.indirect, "Surfaces without the light of the volume");
    app.add_flag("--direct", view.direct, "Surfaces with the light that comes straight from lamps");
    app.add_flag("--backs", view.backs, "Draw the backs of surfaces, too");
    app.add_flag("!--no-plane-culling", view.lookup.planeCulling, "Read cells behind a surface, too");
    app.add_flag("!--no-visibility", view.lookup.visibility, "Read cells that a surface does not see, too");
    app.add_option("--exposure", view.exposure, "Brightness, powers of two")->check(finiteNumber(-64.0, 64.0, "a number above -64 and at most 64"));
    addCountOption(app, "--error-samples", view.errorSamples, "Paths a point, or a side of a cell, where errors are shown");
}

bool mesh(const VizOptions& options) { return options.view.subject == Subject::mesh || options.view.mesh; }

// What of the view would do nothing.
void checkView(const VizOptions& options) {
    const View& view = options.view;
    const std::string name = nameOf(view.subject);
    if (view.carrier == Carrier::surfaces && view.subject != Subject::error) throw InputError("--on surfaces: expected --view error; --view mesh shows the irradiance there");
    if (!quantityOf(view.subject) && view.subject != Subject::error) {
        if (view.carrier) throw InputError(fmt::format("--on: expected --view irradiance, another quantity or error, not {}", name));
        if (!view.slices.empty()) throw InputError(fmt::format("--slice: expected --view irradiance, another quantity or error, not {}", name));
    }
    if (!view.slices.empty() && carrierOf(view) != Carrier::slices) throw InputError("--slice: expected it without --on, or with --on slices");
    if (view.slices.empty() && carrierOf(view) == Carrier::slices) throw InputError("--on slices: expected --slice, which says where");
    if (options.difference && !quantityOf(view.subject) && view.subject != Subject::cubes)
        throw InputError(fmt::format("--difference: expected --view irradiance or another quantity, not {}", name));
    if (view.histogram && view.probe) throw InputError("--histogram: expected it without --probe: there is room for one plot");
}

}  // namespace

void addVizOptions(CLI::App& app, VizOptions& options) {
    app.add_option("volume", options.file, "A .vtm or .pvd file of clv bake");
    addLiveOptions(app, options.live);
    auto* other = app.add_option("other", options.other, "A second one, shown beside the first with the same camera");
    app.add_flag("--difference", options.difference, "Show how the first differs from the second, in place of the second")->needs(other);
    app.add_flag("--without", options.without, "Show surfaces without indirect light on the left of --view mesh --direct")->excludes(other);
    app.add_flag("--truth", options.truth, "Show cubes, irradiance or mesh by path tracing on its right")->excludes(other);
    addFigureOption(app, options);
    app.add_option("--scene", options.scene, "The scene of the volume, where its file has moved");
    addWhat(app, options);
    addBeside(app, options.view);
    app.add_option("--camera", options.camera, "A camera of the scene, by name or index, or px,py,pz,tx,ty,tz[,yfov] (m, rad); default: the volume from outside");
    app.add_option_function<std::string>("--size", [&options](const std::string& text) { parseSize(text, options); }, "Pixels: WxH")->default_str("1280x720");
    app.add_option_function<std::vector<std::string>>(
           "--pick",
           [&options](const std::vector<std::string>& places) {
               for (const std::string& place : places) options.picks.push_back(pickOf(place));
           },
           "Print what a click there would show: x,y,z[,nx,ny,nz] (m, unit normal)")
        ->take_all();
    app.add_option("--out", options.out, "Write a picture (PNG) in place of opening a window; needs no display");
    app.add_flag("--benchmark", options.benchmark, "Print how fast the volume opens and turns, and its memory, in place of opening a window");
    app.add_option("--frame", options.frame, "Of a series: the frame that is shown first; 0 is that which captions call 1");
    app.add_flag("--play", options.play, "Of a series: play it in the window");
    app.add_option("--threads", options.threads, "Threads to use; 0: all of the machine's")->check(CLI::Range(0, kMostThreads))->capture_default_str();
}

void check(const VizOptions& options) {
    checkView(options);
    const LiveOptions& live = options.live;
    if (options.file.empty() && !(live.on && !options.scene.empty())) throw InputError("expected the file of a volume, or --live with --scene; see --help");
    if (live.on && (!options.other.empty() || options.without || options.truth)) throw InputError("--live: expected one volume, without another beside it");
    if (options.without && options.truth) throw InputError("--without: expected it without --truth: there is room for one view beside this one");
    if (options.without && !(mesh(options) && options.view.direct)) throw InputError("--without: expected --view mesh, or --mesh, and --direct, which it leaves alone");
    if (options.play && live.on) throw InputError("--play: expected a series of frames, without --live");
    if (options.out.empty()) return;
    if (!options.out.ends_with(".png")) throw InputError(fmt::format("--out {}: expected a name that ends in .png", options.out));
    if (options.play) throw InputError("--play: expected a window, without --out; --frame chooses the frame of a picture");
    if (options.benchmark) throw InputError("--benchmark: expected it without --out");
}

}  // namespace clv
