#include "viz/virtual_display.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <X11/Xlib.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace clv {
namespace {

// The number that a started server writes once it answers; empty where it ends before that.
std::string readNumber(int descriptor) {
    std::string number;
    for (char c; read(descriptor, &c, 1) == 1 && c != '\n';) number += c;
    return number;
}

[[noreturn]] void becomeServer(int numberTo) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    // A process that waits for interrupts in a thread of its own has blocked them everywhere, which children inherit.
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    const std::string descriptor = std::to_string(numberTo);
    execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1920x1200x24", "-nolisten", "tcp", nullptr);
    _exit(127);
}

}  // namespace

bool displayAnswers() {
    Display* const display = XOpenDisplay(nullptr);
    if (display) XCloseDisplay(display);
    return display != nullptr;
}

VirtualDisplay::VirtualDisplay() {
    if (displayAnswers()) return;
    int number[2];
    if (pipe(number) != 0) throw std::runtime_error("no pipe to a virtual X server");
    fcntl(number[0], F_SETFD, FD_CLOEXEC);
    server_ = fork();
    if (server_ == 0) becomeServer(number[1]);
    close(number[1]);
    const std::string name = readNumber(number[0]);
    close(number[0]);
    if (name.empty()) {
        waitpid(server_, nullptr, 0);
        throw std::runtime_error("no display answers, and no virtual one starts; expected DISPLAY, or the program Xvfb (Debian's package xvfb)");
    }
    setenv("DISPLAY", (":" + name).c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
    unsetenv("DISPLAY");
}

}  // namespace clv
