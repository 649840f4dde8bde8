#include "viz/inspector.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <vtkCallbackCommand.h>

#include "bindings/cli/options.h"
#include "bindings/cli/standard_streams.h"
#include "viz/camera_pose.h"
#include "viz/compose.h"
#include "viz/describe.h"
#include "viz/keys.h"
#include "viz/outlines.h"
#include "viz/picture_file.h"
#include "viz/status.h"

namespace clv {
namespace {

constexpr SliderPlace kTimePlace{0.38, 0.66, 0.93};
constexpr double kBarTopBelowSliders = 0.28;
constexpr double kMiddle = 0.5;            // of what the mouse may hit of a frame
constexpr unsigned long kFrameTime = 100;  // ms, of a series that plays

// A file's name, with its folder where the other file has the same name.
std::string shownName(const std::filesystem::path& file, const std::filesystem::path& other) {
    return file.filename() != other.filename() ? file.filename() : file.parent_path().filename() / file.filename();
}

constexpr double kInCell = 1e-3;  // of a cell: so far within the coarsest cascade a plane stays, where it cuts cells

// Where the coarsest cascade lies along an axis, m, world space.
std::pair<double, double> placesOf(const BakedVolume& volume, int axis) {
    const Bounds bounds = boundsOf(volume.cascades.back().level.volume);
    return {double(bounds.lo[axis]) + volume.anchor[axis], double(bounds.hi[axis]) + volume.anchor[axis]};
}

double placeInside(const BakedVolume& volume, int axis, double place) {
    const auto [lo, hi] = placesOf(volume, axis);
    const double margin = kInCell * double(volume.cascades.back().level.volume.cellSize);
    return std::clamp(place, lo + margin, hi - margin);
}

vec3 vecOf(const double* v) { return vec3(v[0], v[1], v[2]); }

}  // namespace

Inspector::Inspector(const VizOptions& options) : options_(options), view_(options.view), parallelFor_(parallelForOf({.threads = options.threads})) {
    check(options);
    panes_.push_back(options.file.empty() ? std::make_shared<Pane>(options.scene) : std::make_shared<Pane>(options.file, options.scene, options.frame, parallelFor_));
    window_->SetSize(options.width, options.height);
    // Smooth edges cost a processor that draws twice the time, which a window that turns does not have.
    if (options.out.empty()) window_->SetMultiSamples(0);
    window_->SetWindowName(("clv-viz " + options.file).c_str());
    if (options.without || options.truth) panes_.push_back(panes_[0]);
    if (!options.other.empty()) {
        panes_.push_back(std::make_shared<Pane>(options.other, options.scene, 0, parallelFor_));
        if (options.frame != 0) panes_[1]->loadFrame(options.frame, parallelFor_);  // it may have fewer frames
    }
    sayWarnings();
    placeCamera(options.camera);
    if (options.live.on) startLive();
    for (std::size_t k = 0; k < panes_.size(); ++k) {
        checkCascade(panes_[k]->volume());
        canvases_.push_back(std::make_unique<Canvas>(*window_, double(k) / double(panes_.size()), double(k + 1) / double(panes_.size())));
        canvases_[k]->renderer().SetActiveCamera(camera_);
    }
    placePlanes();
    checkFrames();
    for (const std::vector<double>& numbers : options.picks) marked_.push_back(typedPick(numbers, pane().volume(), view_.cascade));
    frame_ = std::min(options.frame, pane().series().frames() - 1);
    playing_ = options.play;
    composePanes();
    canvases_[0]->renderer().ResetCameraClippingRange();
}

void Inspector::startLive() {
    live_ = std::make_unique<LiveMode>(*panes_[0], options_.live, [this] { return viewCamera(); }, parallelFor_);
    for (int frame = 0; frame < options_.live.frames; ++frame) live_->frame();
    view_.lights = true;
    // The grid over the scene is wider than the scene itself.
    if (options_.live.settings.cascades == 0) placeCamera(options_.camera);
}

void Inspector::addTimeSlider() {
    const std::size_t frames = pane().series().frames();
    if (live_ || frames < 2) return;
    const auto say = [this](double value) { return fmt::format("{} of {}, {:.3f} s", std::size_t(value) + 1, pane().series().frames(), pane().series().time(std::size_t(value))); };
    const auto change = [this](double value) {
        if (std::size_t(value) != frame_) loadFrame(std::size_t(value));
    };
    time_ = std::make_unique<Slider>(*interactor_, kTimePlace, "frame", 0.0, double(frames) - 0.01, kMiddle + double(frame_), change, say);
}

Camera Inspector::viewCamera() {
    const double* up = camera_->GetViewUp();
    return {.name = "view",
            .position = vecOf(camera_->GetPosition()),
            .forward = normalize(vecOf(camera_->GetDirectionOfProjection())),
            .up = normalize(vecOf(up)),
            .yfov = float(glm::radians(camera_->GetViewAngle())),
            .aspect = aspect()};
}

float Inspector::aspect() const { return float(options_.width) / float(options_.height) / float(panes_.size()); }

void Inspector::sayWarnings() const {
    std::set<std::string> warnings;  // two panes may show one scene
    for (const auto& pane : panes_) {
        if (pane->world()) warnings.insert(pane->world()->scene().warnings.begin(), pane->world()->scene().warnings.end());
    }
    for (const std::string& warning : warnings) sayOnStderr("clv-viz: " + warning);
}

void Inspector::checkCascade(const BakedVolume& volume) const {
    const std::size_t count = volume.cascades.size();
    if (view_.cascade.value_or(0) >= count) throw InputError(fmt::format("--cascade {}: expected a number below {}", *view_.cascade, count));
}

void Inspector::placePlanes() {
    for (SlicePlane& plane : view_.slices) {
        const auto [lo, hi] = placesOf(pane().volume(), plane.axis);
        if (plane.place < lo || plane.place > hi)
            throw InputError(fmt::format("--slice {}={}: expected a place in the volume, from {:.4g} to {:.4g} m", "xyz"[plane.axis], plane.place, lo, hi));
        plane.place = placeInside(pane().volume(), plane.axis, plane.place);
    }
}

void Inspector::checkFrames() const {
    if (options_.play && pane().series().frames() < 2) throw InputError(fmt::format("--play: expected a series of frames, a .pvd, found {}", options_.file));
}

void Inspector::writePicture(const std::string& file) {
    window_->SetShowWindow(false);
    clv::writePicture(*window_, file);
}

void Inspector::turn(double degrees) {
    window_->SetDesiredUpdateRate(interactor_->GetDesiredUpdateRate());
    camera_->Azimuth(degrees);
    canvases_[0]->renderer().ResetCameraClippingRange();
    window_->Render();
    window_->WaitForCompletion();
}

void Inspector::interact() {
    interactor_->SetRenderWindow(window_);
    style_->grab = [this](int x, int y) { return grab(x, y); };
    style_->drag = [this](int x, int y) { drag(x, y); };
    style_->drop = [this](int, int) {
        grabbed_.reset();
        if (live_ && live_->holdsLight()) live_->dropLight();
    };
    style_->click = [this](int x, int y) { click(x, y); };
    style_->key = [this](const std::string& symbol) { key(symbol); };
    interactor_->SetInteractorStyle(style_);
    hint_ = "h: help";
    showPanels();
    interactor_->Initialize();
    vtkNew<vtkCallbackCommand> onTimer;
    onTimer->SetClientData(this);
    onTimer->SetCallback([](vtkObject*, unsigned long, void* inspector, void*) { static_cast<Inspector*>(inspector)->tick(); });
    interactor_->AddObserver(vtkCommand::TimerEvent, onTimer);
    interactor_->CreateRepeatingTimer(kFrameTime);
    if (live_) {
        canvases_[0]->setBarTop(kBarTopBelowSliders);
        live_->addSliders(*interactor_);
    }
    addTimeSlider();
    window_->Render();
    interactor_->Start();
}

Drawing Inspector::drawingOf(std::size_t pane, const Drawing* beside) const {
    const Pane& shown = *panes_[pane];
    const bool difference = options_.difference && pane == 1;
    Drawing drawing = difference ? composeDifference(panes_[0]->volume(), shown.volume(), view_, parallelFor_) : compose(shown.volume(), shown.world(), viewOf(pane, beside), parallelFor_);
    if (!options_.other.empty()) drawing.caption = fmt::format("{}: {}", shownName(shown.file(), panes_[1 - pane]->file()), drawing.caption);
    if (const std::size_t frames = shown.series().frames(); frames > 1) {
        const std::size_t frame = std::min(frame_, frames - 1);
        drawing.caption += fmt::format("; frame {} of {}, {:.3f} s", frame + 1, frames, shown.series().time(frame));
    }
    if (live_ && pane == 0) drawing.caption += fmt::format("\n{}", live_->times());
    return drawing;
}

View Inspector::viewOf(std::size_t pane, const Drawing* beside) const {
    View view = view_;
    if (options_.without && pane == 0) view.indirect = false;
    view.truth = options_.truth && pane == 1;
    if (beside && beside->scale && !view.range) view.range = {beside->scale->lo, beside->scale->hi};
    if (beside) view.fixedExposure = beside->exposure;
    return view;
}

void Inspector::composePanes() {
    // Of a view with and without indirect light, that with it says how bright both are.
    const std::size_t first = options_.without ? 1 : 0;
    const Drawing drawing = drawingOf(first, nullptr);
    canvases_[first]->show(drawing);
    if (panes_.size() > 1) canvases_[1 - first]->show(drawingOf(1 - first, &drawing));
    if (options_.out.empty()) canvases_.back()->setStatus(statusOf(view_, pane().volume().cascades.size()));
    showMarks();
    showPanels();
}

void Inspector::showPanels() {
    for (std::size_t k = 0; k < panes_.size(); ++k) {
        const std::string text = help_ ? keyHelp() : picked_ ? describe(panes_[k]->volume(), *picked_, view_.lookup) : hint_;
        canvases_[k]->setPanel(text);
    }
}

void Inspector::showMarks() {
    for (std::size_t k = 0; k < panes_.size(); ++k) {
        FlatLines edges{.points = {}, .colors = {}, .width = 2.0f, .inFront = true};
        for (const Pick& pick : marked_) {
            if (const auto cell = pickedCell(panes_[k]->volume(), pick)) drawCellEdges(*cell, edges);
        }
        canvases_[k]->setMark(edges);
    }
}

void Inspector::refresh() {
    try {
        composePanes();
    } catch (const InputError& error) {
        // A key asked for what this file cannot show.
        return say(error);
    }
    // What is drawn may reach farther than before.
    canvases_[0]->renderer().ResetCameraClippingRange();
    window_->Render();
}

void Inspector::say(const InputError& error) {
    canvases_[0]->setPanel(error.what());
    window_->Render();
}

void Inspector::togglePlane(int axis) {
    std::vector<SlicePlane>& slices = view_.slices;
    if (std::erase_if(slices, [axis](const SlicePlane& plane) { return plane.axis == axis; }) == 0) {
        const ClvVolume& grid = pane().volume().cascades.front().level.volume;
        // Off the middle by a quarter of a cell: a wall often stands there, on a face between cells.
        slices.push_back({axis, grid.origin[axis] + (0.5 * grid.resolution[axis] + 0.25) * grid.cellSize + pane().volume().anchor[axis]});
    }
    view_.carrier.reset();
    if (!quantityOf(view_.subject) && view_.subject != Subject::error) view_.subject = Subject::irradiance;
    refresh();
}

void Inspector::toggleHelp() {
    help_ = !help_;
    showPanels();
    window_->Render();
}

void Inspector::placeCamera(const std::string& camera) {
    const Scene* scene = pane().world() ? &pane().world()->scene() : nullptr;
    const BakedVolume& volume = pane().volume();
    // Cascades that follow the view would lead it ever farther away.
    const bool sceneAlone = volume.cascades.empty() || (scene && options_.live.on && volume.cascades.size() > 1);
    const Bounds bounds = sceneAlone ? scene->bounds : fillsSpace(view_) ? boundsOf(volume.cascades.back().level.volume) : litBounds(volume);
    place(*camera_, camera.empty() ? overview(bounds, aspect()) : parsePose(camera, volume, scene));
}

void Inspector::resetCamera() {
    placeCamera("");
    canvases_[0]->renderer().ResetCameraClippingRange();
    window_->Render();
}

void Inspector::nextCamera() {
    const World* world = pane().world();
    if (!world || world->scene().cameras.empty()) return say(InputError("expected a scene with a camera"));
    const std::vector<Camera>& cameras = world->scene().cameras;
    place(*camera_, poseOf(cameras[nextCamera_++ % cameras.size()]));
    canvases_[0]->renderer().ResetCameraClippingRange();
    window_->Render();
}

void Inspector::showFrame(std::size_t frame) {
    if (live_) return;
    frame = std::min(frame, pane().series().frames() - 1);
    if (time_) time_->set(kMiddle + double(frame));
    loadFrame(frame);
}

void Inspector::loadFrame(std::size_t frame) {
    frame_ = frame;
    try {
        panes_[0]->loadFrame(frame_, parallelFor_);
        if (panes_.back() != panes_[0]) panes_.back()->loadFrame(frame_, parallelFor_);
        refresh();
    } catch (const InputError& error) {
        playing_ = false;
        say(error);
    }
}

void Inspector::togglePlaying() {
    playing_ = !playing_;
}

void Inspector::toggleFollowing() {
    if (live_) live_->toggleFollowing();
}

void Inspector::tick() {
    if (live_) {
        try {
            live_->frame();
            refresh();
        } catch (const InputError& error) {
            say(error);
        }
    }
    if (playing_) showFrame(frame_ + 1 < pane().series().frames() ? frame_ + 1 : 0);
}

void Inspector::toggleProbe() {
    if (view_.probe || !picked_ || !pickedBefore_) {
        view_.probe.reset();
    } else {
        view_.probe = {glm::dvec3(pickedBefore_->position) + pane().volume().anchor, glm::dvec3(picked_->position) + pane().volume().anchor};
    }
    refresh();
}

std::size_t Inspector::paneAt(int x) const {
    return std::min(panes_.size() - 1, std::size_t(std::max(0, x)) * panes_.size() / std::size_t(std::max(1, window_->GetSize()[0])));
}

Sight Inspector::sightAt(int x, int y, std::size_t pane) {
    vtkRenderer& renderer = canvases_[pane]->renderer();
    const vec3 eye = vecOf(camera_->GetPosition());
    renderer.SetDisplayPoint(x, y, 1.0);
    renderer.DisplayToWorld();
    const double* far = renderer.GetWorldPoint();
    return {eye, normalize(vecOf(far) / float(far[3]) - eye)};
}

bool Inspector::grab(int x, int y) {
    const std::size_t pane = paneAt(x);
    if (live_ && live_->grabLight(sightAt(x, y, pane))) return true;
    if (carrierOf(view_) != Carrier::slices) return false;
    grabbed_ = pickAlong(panes_[pane]->volume(), panes_[pane]->world(), view_, sightAt(x, y, pane), parallelFor_);
    if (grabbed_ && !grabbed_->slice) grabbed_.reset();
    return grabbed_.has_value();
}

vec3 Inspector::screenNormal() {
    return vecOf(camera_->GetDirectionOfProjection());
}

void Inspector::drag(int x, int y) {
    if (live_ && live_->holdsLight()) return live_->dragLight(screenNormal(), sightAt(x, y, paneAt(x)));
    SlicePlane& plane = view_.slices[*grabbed_->slice];
    plane.place = placeInside(pane().volume(), plane.axis, draggedPlace(grabbed_->position, plane.axis, sightAt(x, y, paneAt(x))) + pane().volume().anchor[plane.axis]);
    refresh();
}

void Inspector::click(int x, int y) {
    const std::size_t pane = paneAt(x);
    pickedBefore_ = picked_;
    picked_ = pickAlong(panes_[pane]->volume(), panes_[pane]->world(), view_, sightAt(x, y, pane), parallelFor_);
    marked_.clear();
    if (picked_) marked_.push_back(*picked_);
    showMarks();
    showPanels();
    if (picked_) printPick(panes_[pane]->volume(), *picked_, view_.lookup);
    window_->Render();
}

void Inspector::key(const std::string& symbol) {
    const auto found = std::ranges::find(keys(), symbol, &Key::symbol);
    if (found != keys().end()) found->act(*this);
}

}  // namespace clv
