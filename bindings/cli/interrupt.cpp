#include "bindings/cli/interrupt.h"

#include <algorithm>
#include <csignal>
#include <mutex>
#include <thread>
#include <vector>

#include <pthread.h>

namespace clv {
namespace {

// The process has one set of signals, hence one list of what they clean up.
struct Guarded {
    std::mutex mutex;
    std::vector<std::filesystem::path> folders;
};
Guarded& guarded() {
    static Guarded instance;
    return instance;
}

void removeFolders(const std::vector<std::filesystem::path>& folders) {
    // Another thread may still be adding a file while the folder is emptied: the second round takes that one along.
    for (int round = 0; round < 2; ++round)
        for (const auto& folder : folders) {
            std::error_code ignored;
            std::filesystem::remove_all(folder, ignored);
        }
}

}  // namespace

void cleanUpOnInterrupt() {
    // A file that may not grow any further is then an error of that write, which cleans up, and not the end of the process.
    std::signal(SIGXFSZ, SIG_IGN);
    sigset_t signals;
    sigemptyset(&signals);
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction current;
        sigaction(signal, nullptr, &current);
        if (current.sa_handler != SIG_IGN) sigaddset(&signals, signal);
    }
    // Blocked here and so in every thread that starts later; a thread that waits for them may then call anything it likes,
    // which a signal handler may not.
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    guarded();  // made before the thread, so that it outlives main()
    std::thread([signals] {
        int signal = 0;
        sigwait(&signals, &signal);
        // Never unlocked: no output may be finished once its folder is gone.
        guarded().mutex.lock();
        removeFolders(guarded().folders);
        std::signal(signal, SIG_DFL);
        pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
        std::raise(signal);
    }).detach();
}

std::filesystem::path guardFolder(const std::function<std::filesystem::path()>& make) {
    std::scoped_lock lock(guarded().mutex);
    return guarded().folders.emplace_back(make());
}

void unguardFolder(const std::filesystem::path& folder) {
    std::scoped_lock lock(guarded().mutex);
    std::erase(guarded().folders, folder);
}

void withoutInterrupt(const std::function<void()>& action) {
    std::scoped_lock lock(guarded().mutex);
    action();
}

}  // namespace clv
