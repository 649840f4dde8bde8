// What happens when the user stops a command: temporary folders go, nothing else is touched.
#pragma once
#include <filesystem>
#include <functional>

namespace clv {

// Call first in main(), before any thread starts: from then on SIGINT, SIGTERM and SIGHUP (those that the parent did not switch
// off) remove the guarded folders and then end the process by that same signal.
void cleanUpOnInterrupt();

// Makes a folder that is removed on an interrupt; one that comes while `make` runs waits until the folder is known.
std::filesystem::path guardFolder(const std::function<std::filesystem::path()>& make);
// To be called once the folder is gone.
void unguardFolder(const std::filesystem::path& folder);

// Runs `action` so that an interrupt waits for its end.
void withoutInterrupt(const std::function<void()>& action);

}  // namespace clv
