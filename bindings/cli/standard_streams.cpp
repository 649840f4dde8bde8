#include "bindings/cli/standard_streams.h"

#include <csignal>
#include <cstdio>
#include <mutex>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace clv {

void fillStandardDescriptors() {
    int lowest = open("/dev/null", O_RDONLY);
    while (lowest >= 0 && lowest <= STDERR_FILENO) lowest = open("/dev/null", O_RDONLY);
    close(lowest);
}

void writeStderr(std::string_view text) {
    static std::mutex turn;  // the signal's handling is the whole process'
    const std::lock_guard lock(turn);
    // A pipe that nobody reads would end the process.
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
    std::signal(SIGPIPE, before);
}

void sayOnStderr(std::string_view line) {
    std::string shown;
    for (const char c : line) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7f)
            shown += fmt::format("\\x{:02x}", code);
        else
            shown += c;
    }
    writeStderr(shown + '\n');
}

}  // namespace clv
