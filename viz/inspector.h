// The window of clv-viz: panes with a view in common, and what keys and the mouse do to it.
#pragma once
#include <memory>
#include <string>
#include <vector>

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
    void showFrame(std::size_t frame);
    std::size_t frame() const { return frame_; }
    void togglePlaying();
    void toggleProbe();
    void close() { interactor_->TerminateApp(); }

private:
    void checkCascade(const BakedVolume& volume) const;
    // Pixels of the window, from its lower left corner.
    std::size_t paneAt(int x) const;
    Sight sightAt(int x, int y, std::size_t pane);
    bool grab(int x, int y);
    void drag(int x, int y);
    void click(int x, int y);
    void key(const std::string& symbol);
    Drawing drawingOf(std::size_t pane) const;
    // The view in common, or its counterpart without indirect light.
    View viewOf(std::size_t pane) const;
    void composePanes();
    void showPanels();
    void tick();
    void startLive();
    vec3 screenNormal();

    const VirtualDisplay display_;  // outlives the window
    VizOptions options_;
    View view_;
    ParallelFor parallelFor_;
    std::vector<std::unique_ptr<Pane>> panes_;
    vtkNew<vtkRenderWindow> window_;
    std::vector<std::unique_ptr<Canvas>> canvases_;  // a pane each
    vtkNew<vtkRenderWindowInteractor> interactor_;
    vtkNew<MouseStyle> style_;
    std::unique_ptr<LiveMode> live_;  // null: the light is that of the file
    std::optional<Pick> picked_;    // the last click
    std::optional<Pick> grabbed_;   // what the mouse drags
    std::size_t frame_ = 0;
    std::optional<Pick> pickedBefore_;  // the click before that
    bool help_ = false, playing_ = false;
    std::string hint_;              // of the panel, where nothing else is
};

}  // namespace clv
