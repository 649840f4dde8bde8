// A display to draw on where there is none: a private virtual X server.
#pragma once
#include <sys/types.h>

namespace clv {

class VirtualDisplay {
public:
    // Keeps the display that DISPLAY names if it answers; else starts Xvfb under a free number, and points DISPLAY there.
    // Throws std::runtime_error that says what is missing.
    VirtualDisplay();
    // Ends the server that was started. It also ends with this process, however that ends.
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

private:
    pid_t server_ = -1;
};

// Whether the display that DISPLAY names answers.
bool displayAnswers();

}  // namespace clv
