// Work that may crash, never end or eat all memory, in a process of its own.
#pragma once
#include <cstdint>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>

#include <sys/types.h>

namespace clv {

struct WorkLimits {
    unsigned seconds = 0;     // 0: none
    std::uint64_t bytes = 0;  // beyond what a process starts with; 0: none
};

// How the work ended in place of ending well: "it ended by a signal (Segmentation fault)".
struct WorkFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// A process that forks a worker for each request. It is forked once, from a process that has no other thread yet, since what a thread holds
// while another one forks is lost to the child; workers may then be asked for at any time and from any thread.
class WorkerProcess {
public:
    // Writes what it makes of the request to the descriptor `out`. What it prints is not seen, and what it throws is a failure.
    using Work = std::function<void(const std::string& request, int out)>;

    WorkerProcess(const Work& work, const WorkLimits& limits);
    ~WorkerProcess();
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    // `take` reads what the work writes. Throws WorkFailure where the work does not end well, else what `take` throws.
    void run(const std::string& request, const std::function<void(int in)>& take);

private:
    std::mutex mutex_;
    int socket_ = -1;
    pid_t process_ = -1;
    WorkLimits limits_;
};

// All of the bytes, or a std::runtime_error; a WorkFailure where there are too few to read.
void writeAll(int out, const void* data, std::size_t size);
void readAll(int in, void* data, std::size_t size);

}  // namespace clv
