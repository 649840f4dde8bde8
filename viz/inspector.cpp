#include "viz/inspector.h"

#include <algorithm>

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>

#include "bindings/cli/options.h"
#include "viz/camera_pose.h"
#include "viz/compose.h"
#include "viz/describe.h"
#include "viz/keys.h"
#include "viz/picture_file.h"

namespace clv {
namespace {

constexpr int kFirstFrames = 8;            // of live light, before anything is shown
constexpr unsigned long kFrameTime = 100;  // ms, of a series that plays

vec3 vecOf(const double* v) { return vec3(v[0], v[1], v[2]); }

}  // namespace

Inspector::Inspector(const VizOptions& options) : options_(options), view_(options.view), parallelFor_(parallelForOf({.threads = options.threads})) {
    if (options.file.empty() && !(options.live && !options.scene.empty())) throw InputError("expected the file of a volume, or --live with --scene; see --help");
    panes_.push_back(options.file.empty() ? std::make_unique<Pane>(options.scene) : std::make_unique<Pane>(options.file, options.scene, options.frame));
    if (options.live) startLive();
    window_->SetSize(options.width, options.height);
    // Smooth edges cost a processor that draws twice the time, which a window that turns does not have.
    if (options.out.empty()) window_->SetMultiSamples(0);
    window_->SetWindowName(("clv-viz " + options.file).c_str());
    if (options.without) panes_.push_back(std::make_unique<Pane>(options.file, options.scene, options.frame));
    if (!options.other.empty()) panes_.push_back(std::make_unique<Pane>(options.other, options.scene, options.frame));
    for (std::size_t k = 0; k < panes_.size(); ++k) {
        checkCascade(panes_[k]->volume());
        canvases_.push_back(std::make_unique<Canvas>(*window_, double(k) / double(panes_.size()), double(k + 1) / double(panes_.size())));
        canvases_[k]->renderer().SetActiveCamera(canvases_[0]->renderer().GetActiveCamera());
    }
    frame_ = options.frame;
    composePanes();
    resetCamera();
}

void Inspector::startLive() {
    if (!pane().world()) throw InputError("--live: expected the scene of the volume; name it with --scene");
    live_ = std::make_unique<LiveMode>(*panes_[0], parallelFor_);
    for (int frame = 0; frame < kFirstFrames; ++frame) live_->frame();
    view_.lights = true;
}

void Inspector::checkCascade(const BakedVolume& volume) const {
    const std::size_t count = volume.cascades.size();
    if (view_.filter.cascade.value_or(0) >= count) throw InputError(fmt::format("--cascade {}: expected a number below {}", *view_.filter.cascade, count));
}

void Inspector::writePicture(const std::string& file) {
    window_->SetShowWindow(false);
    clv::writePicture(*window_, file);
}

void Inspector::turn(double degrees) {
    window_->SetDesiredUpdateRate(interactor_->GetDesiredUpdateRate());
    vtkRenderer& renderer = canvases_[0]->renderer();
    renderer.GetActiveCamera()->Azimuth(degrees);
    renderer.ResetCameraClippingRange();
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
    if (live_) live_->addSliders(*interactor_);
    window_->Render();
    interactor_->Start();
}

Drawing Inspector::drawingOf(std::size_t pane) const {
    const Pane& shown = *panes_[pane];
    const bool difference = options_.difference && pane == 1;
    Drawing drawing = difference ? composeDifference(panes_[0]->volume(), shown.volume(), view_, parallelFor_) : compose(shown.volume(), shown.world(), viewOf(pane), parallelFor_);
    if (!options_.other.empty()) drawing.caption = fmt::format("{}: {}", shown.file(), drawing.caption);
    if (shown.series().frames() > 1) drawing.caption += fmt::format("; frame {} of {}, {:.3f} s", frame_, shown.series().frames(), shown.series().time(frame_));
    if (live_ && pane == 0) drawing.caption += fmt::format("\n{}", live_->times());
    return drawing;
}

View Inspector::viewOf(std::size_t pane) const {
    View view = view_;
    if (options_.without && pane == 0) view.indirect = false;
    return view;
}

void Inspector::composePanes() {
    for (std::size_t k = 0; k < panes_.size(); ++k) {
        canvases_[k]->show(drawingOf(k));
    }
    showPanels();
}

void Inspector::showPanels() {
    for (std::size_t k = 0; k < panes_.size(); ++k) {
        const std::string text = help_ ? keyHelp() : picked_ ? describe(panes_[k]->volume(), *picked_, view_.lookup) : hint_;
        canvases_[k]->setPanel(text);
    }
}

void Inspector::refresh() {
    try {
        composePanes();
    } catch (const InputError& error) {
        // A key asked for what this file cannot show.
        canvases_[0]->setPanel(error.what());
    }
    window_->Render();
}

void Inspector::togglePlane(int axis) {
    std::vector<SlicePlane>& slices = view_.slices;
    if (std::erase_if(slices, [axis](const SlicePlane& plane) { return plane.axis == axis; }) == 0) {
        const ClvVolume& grid = pane().volume().cascades.front().level.volume;
        // Off the middle by a quarter of a cell: a wall often stands there, on a face between cells.
        slices.push_back({axis, grid.origin[axis] + (0.5 * grid.resolution[axis] + 0.25) * grid.cellSize + pane().volume().anchor[axis]});
    }
    view_.carrier = slices.empty() ? Carrier::cells : Carrier::slices;
    if (!quantityOf(view_.subject)) view_.subject = Subject::irradiance;
    refresh();
}

void Inspector::toggleHelp() {
    help_ = !help_;
    showPanels();
    window_->Render();
}

void Inspector::resetCamera() {
    const float aspect = float(options_.width) / float(options_.height) / float(panes_.size());
    const Scene* scene = pane().world() ? &pane().world()->scene() : nullptr;
    vtkRenderer& renderer = canvases_[0]->renderer();
    place(*renderer.GetActiveCamera(), options_.camera.empty() ? overview(pane().volume(), aspect) : parsePose(options_.camera, pane().volume(), scene));
    renderer.ResetCameraClippingRange();
}

void Inspector::showFrame(std::size_t frame) {
    if (live_) return;
    frame_ = std::min(frame, pane().series().frames() - 1);
    for (const auto& pane : panes_) pane->loadFrame(frame_);
    refresh();
}

void Inspector::togglePlaying() {
    playing_ = !playing_;
}

void Inspector::tick() {
    if (live_) {
        live_->frame();
        refresh();
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
    const vec3 eye = vecOf(renderer.GetActiveCamera()->GetPosition());
    renderer.SetDisplayPoint(x, y, 1.0);
    renderer.DisplayToWorld();
    const double* far = renderer.GetWorldPoint();
    return {eye, normalize(vecOf(far) / float(far[3]) - eye)};
}

bool Inspector::grab(int x, int y) {
    const std::size_t pane = paneAt(x);
    if (live_ && live_->grabLight(sightAt(x, y, pane))) return true;
    if (view_.carrier != Carrier::slices) return false;
    grabbed_ = pickAlong(panes_[pane]->volume(), panes_[pane]->world(), view_, sightAt(x, y, pane), parallelFor_);
    if (grabbed_ && !grabbed_->slice) grabbed_.reset();
    return grabbed_.has_value();
}

vec3 Inspector::screenNormal() {
    return vecOf(canvases_[0]->renderer().GetActiveCamera()->GetDirectionOfProjection());
}

void Inspector::drag(int x, int y) {
    if (live_ && live_->holdsLight()) return live_->dragLight(screenNormal(), sightAt(x, y, paneAt(x)));
    SlicePlane& plane = view_.slices[*grabbed_->slice];
    plane.place = draggedPlace(grabbed_->position, plane.axis, sightAt(x, y, paneAt(x))) + pane().volume().anchor[plane.axis];
    refresh();
}

void Inspector::click(int x, int y) {
    const std::size_t pane = paneAt(x);
    pickedBefore_ = picked_;
    picked_ = pickAlong(panes_[pane]->volume(), panes_[pane]->world(), view_, sightAt(x, y, pane), parallelFor_);
    showPanels();
    if (picked_) printPick(panes_[pane]->volume(), *picked_, view_.lookup);
    window_->Render();
}

void Inspector::key(const std::string& symbol) {
    const auto found = std::ranges::find(keys(), symbol, &Key::symbol);
    if (found != keys().end()) found->act(*this);
}

}  // namespace clv
