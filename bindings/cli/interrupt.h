// What happens when the user stops a command: temporary folders go, nothing else is touched.
#pragma once
#include <filesystem>
#include <functional>

namespace clv {

// Call first in main(), before any thread starts: from then on SIGINT, SIGTERM and SIGHUP (those that the parent did not switch
// off) remove the guarded folders and then end the process by that same signal.
void cleanUpOnInterrupt();

// Folders to remove on an interrupt.
void guardFolder(const std::filesystem::path& folder);
void unguardFolder(const std::filesystem::path& folder);

// Runs `action` so that an interrupt waits for its end.
void withoutInterrupt(const std::function<void()>& action);

}  // namespace clv
