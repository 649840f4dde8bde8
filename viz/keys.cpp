#include "viz/keys.h"

#include <fmt/format.h>

#include "viz/inspector.h"

namespace clv {
namespace {

constexpr double kExposureStep = 0.5;    // powers of two
constexpr float kThresholdFactor = 2.0f;
constexpr float kFirstThreshold = 1e-3f; // W/m^2

// An act that changes the view, after which it is drawn again.
template <class Change>
std::function<void(Inspector&)> changing(Change change) {
    return [change](Inspector& inspector) {
        change(inspector.view());
        inspector.refresh();
    };
}

std::function<void(Inspector&)> toggling(bool View::*flag) {
    return changing([flag](View& view) { view.*flag = !(view.*flag); });
}

void nextCascade(Inspector& inspector) {
    std::optional<uint>& shown = inspector.view().cascade;
    const uint next = shown ? *shown + 1 : 0;
    shown = next < inspector.pane().volume().cascades.size() ? std::optional(next) : std::nullopt;
    inspector.refresh();
}

void nextCarrier(View& view) {
    int next = int(carrierOf(view)) + 1;
    if (Carrier(next) == Carrier::slices && view.slices.empty()) ++next;
    view.carrier = Carrier(next % (view.subject == Subject::error ? 4 : 3));
}

// Steps: all cells, those with any light, then in powers of two.
void raiseThreshold(View& view) {
    view.threshold = view.threshold < kAnyLight ? kAnyLight : std::max(kFirstThreshold, view.threshold * kThresholdFactor);
}

void lowerThreshold(View& view) {
    view.threshold = view.threshold > kFirstThreshold ? view.threshold / kThresholdFactor : view.threshold > kAnyLight ? kAnyLight : 0.0f;
}

std::vector<Key> makeKeys() {
    std::vector<Key> keys;
    keys.push_back({"h", "h", "this help", [](Inspector& i) { i.toggleHelp(); }});
    static constexpr const char* kSubjectKeys[kSubjects] = {"1", "2", "3", "4", "5", "6", "n", "7", "8", "9", "0"};
    for (int k = 0; k < kSubjects; ++k) {
        keys.push_back({kSubjectKeys[k], kSubjectKeys[k], nameOf(Subject(k)), changing([k](View& view) { view.subject = Subject(k); })});
    }
    keys.push_back({"o", "o", "quantities on cells, slices, as a volume; the error on surfaces, too", changing(nextCarrier)});
    for (int axis = 0; axis < 3; ++axis) {
        const std::string name(1, char('x' + axis));
        keys.push_back({name, name, "slicing plane across " + name + ", on and off", [axis](Inspector& i) { i.togglePlane(axis); }});
    }
    keys.push_back({"c", "c", "each cascade alone, then all", nextCascade});
    keys.push_back({"Up", "up", "threshold higher: fewer cubes", changing(raiseThreshold)});
    keys.push_back({"Down", "down", "threshold lower, in the end all cells", changing(lowerThreshold)});
    keys.push_back({"plus", "+", "brighter", changing([](View& view) { view.exposure += kExposureStep; })});
    keys.push_back({"minus", "-", "darker", changing([](View& view) { view.exposure -= kExposureStep; })});
    keys.push_back({"m", "m", "surfaces beside the view", toggling(&View::mesh)});
    keys.push_back({"i", "i", "indirect light on surfaces", toggling(&View::indirect)});
    keys.push_back({"d", "d", "direct light on surfaces", toggling(&View::direct)});
    keys.push_back({"k", "k", "backs of surfaces", toggling(&View::backs)});
    keys.push_back({"w", "w", "edges of the scene", toggling(&View::wireframe)});
    keys.push_back({"b", "b", "boxes around cascades", toggling(&View::boxes)});
    keys.push_back({"f", "f", "frustum of the volume's or scene's camera", toggling(&View::frustum)});
    keys.push_back({"l", "l", "lights", toggling(&View::lights)});
    keys.push_back({"t", "t", "texels of the lights' maps", toggling(&View::texels)});
    keys.push_back({"p", "p", "plane culling when surfaces read the volume", changing([](View& view) { view.lookup.planeCulling = !view.lookup.planeCulling; })});
    keys.push_back({"v", "v", "visibility when surfaces read the volume", changing([](View& view) { view.lookup.visibility = !view.lookup.visibility; })});
    keys.push_back({"g", "g", "histogram of the quantity", toggling(&View::histogram)});
    keys.push_back({"a", "a", "plot along the line between the last two clicks", [](Inspector& i) { i.toggleProbe(); }});
    keys.push_back({"space", "space", "play the frames, pause", [](Inspector& i) { i.togglePlaying(); }});
    keys.push_back({"Right", "right", "next frame", [](Inspector& i) { i.showFrame(i.frame() + 1); }});
    keys.push_back({"Left", "left", "frame before", [](Inspector& i) { i.showFrame(i.frame() > 0 ? i.frame() - 1 : 0); }});
    keys.push_back({"Home", "home", "first frame", [](Inspector& i) { i.showFrame(0); }});
    keys.push_back({"End", "end", "last frame", [](Inspector& i) { i.showFrame(i.pane().series().frames()); }});
    keys.push_back({"u", "u", "live: cascades follow the view, or stay", [](Inspector& i) { i.toggleFollowing(); }});
    keys.push_back({"s", "s", "through the scene's cameras, one after the other", [](Inspector& i) { i.nextCamera(); }});
    keys.push_back({"r", "r", "the whole volume from outside", [](Inspector& i) { i.resetCamera(); }});
    keys.push_back({"q", "q", "quit", [](Inspector& i) { i.close(); }});
    return keys;
}

}  // namespace

const std::vector<Key>& keys() {
    static const std::vector<Key> all = makeKeys();
    return all;
}

std::string keyHelp() {
    std::string help =
        "left button    turn; click: what is there; drag a slicing plane, a slider, or a lamp in live mode\n"
        "middle, right  pan, zoom\n";
    for (const Key& key : keys()) help += fmt::format("{:<14} {}\n", key.shown, key.meaning);
    return help;
}

}  // namespace clv
