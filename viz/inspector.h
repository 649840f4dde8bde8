// The window of clv-viz: panes with a view in common, and what keys and the mouse do to it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include "viz/canvas.h"
#include "viz/live_mode.h"
#include "viz/mouse_style.h"
#include "viz/options.h"
#include "viz/pane.h"
#include "viz/pick.h"
#include "viz/virtual_display.h"

namespace clv {

class Inspector {
public:
    // Throws InputError.
    explicit Inspector(const VizOptions& options);

    void writePicture(const std::string& file);
    // Turns the view about the volume as the mouse does, and draws it.
    void turn(double degrees);
    // Opens the window; returns when it is closed.
    void interact();

    View& view() { return view_; }
    const Pane& pane() const { return *panes_[0]; }
    // After a change of the view: draws all panes again.
    void refresh();
    void togglePlane(int axis);
    void toggleHelp();
    void resetCamera();
    void nextCamera();
    void showFrame(std::size_t frame);
    std::size_t frame() const { return frame_; }
    void togglePlaying();
    void toggleFollowing();
    void toggleProbe();
    void close() { interactor_->TerminateApp(); }

private:
    void sayWarnings() const;
    void checkCascade(const BakedVolume& volume) const;
    // Moves planes on the outer faces of the volume into its cells. Throws InputError for those that lie outside.
    void placePlanes();
    // Throws InputError for frames to play where there is one.
    void checkFrames() const;
    // Pixels of the window, from its lower left corner.
    std::size_t paneAt(int x) const;
    Sight sightAt(int x, int y, std::size_t pane);
    bool grab(int x, int y);
    void drag(int x, int y);
    void click(int x, int y);
    void key(const std::string& symbol);
    // `beside`: the other pane's, whose scale and exposure this one shares; null: it follows its own values.
    Drawing drawingOf(std::size_t pane, const Drawing* beside) const;
    // The view in common, or its counterpart without indirect light, or by path tracing.
    View viewOf(std::size_t pane, const Drawing* beside) const;
    void composePanes();
    void showPanels();
    void showMarks();
    void tick();
    // Without moving the slider, which the mouse may hold.
    void loadFrame(std::size_t frame);
    void startLive();
    void addTimeSlider();
    // Width over height of a pane.
    float aspect() const;
    // To a camera of the scene or a place, see parsePose(); empty: outside of the whole volume.
    void placeCamera(const std::string& camera);
    // The view's, for the light to follow.
    Camera viewCamera();
    // Shows what is wrong in place of the panel's text.
    void say(const InputError& error);
    vec3 screenNormal();

    const VirtualDisplay display_;  // outlives the window
    VizOptions options_;
    View view_;
    ParallelFor parallelFor_;
    std::vector<std::shared_ptr<Pane>> panes_;  // the same one twice, where it is shown in two ways
    vtkNew<vtkCamera> camera_;      // of all panes
    vtkNew<vtkRenderWindow> window_;
    std::vector<std::unique_ptr<Canvas>> canvases_;  // a pane each
    vtkNew<vtkRenderWindowInteractor> interactor_;
    vtkNew<MouseStyle> style_;
    std::unique_ptr<LiveMode> live_;  // null: the light is that of the file
    std::unique_ptr<Slider> time_;    // null: there is one frame
    std::optional<Pick> picked_;    // the last click
    std::vector<Pick> marked_;      // whose cells have their edges drawn
    std::optional<Pick> grabbed_;   // what the mouse drags
    std::size_t frame_ = 0;
    std::optional<Pick> pickedBefore_;  // the click before that
    std::size_t nextCamera_ = 0;    // of the scene
    bool help_ = false, playing_ = false;
    std::string hint_;              // of the panel, where nothing else is
};

}  // namespace clv
