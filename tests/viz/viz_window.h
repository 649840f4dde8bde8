// The window of `clv-viz` under a virtual X server, with real keys and a real mouse.
#pragma once
#include <optional>

#include "viz/virtual_display.h"
#include "viz/viz_command.h"

namespace clv::test {

// Sends what xdotool is told to; its exit status.
inline int doToWindow(const std::string& what) { return std::system(("xdotool " + what + " >/dev/null 2>&1").c_str()); }

class VizWindow : public VizCommand {
protected:
    VizWindow() { unsetenv("DISPLAY"); }
    // A window that VTK has drawn takes events in their order, however long each takes; one that is merely there may lose them.
    void open(const std::vector<std::string>& arguments) {
        display_.emplace();
        viz_.emplace(arguments, false, kProgram);
        ASSERT_EQ(doToWindow("search --sync --onlyvisible --name clv-viz windowfocus --sync sleep 1"), 0);
    }
    CommandResult close() {
        EXPECT_EQ(doToWindow("key q"), 0);
        return viz_->wait();
    }

    std::optional<VirtualDisplay> display_;
    std::optional<RunningCommand> viz_;
};

}  // namespace clv::test
