#include "bindings/scene/worker_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <optional>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace clv {
namespace {

constexpr std::size_t kLongestRequest = 16384;  // bytes
constexpr int kPipeBytes = 1 << 20;
constexpr int kThrew = 1;  // exit status of a worker

// A descriptor that is closed at the end.
class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return value_; }
    void close() {
        if (value_ >= 0) ::close(value_);
        value_ = -1;
    }

private:
    int value_;
};

// A request and the descriptor that its answer goes to, in one message.
struct Message {
    explicit Message(std::vector<char>& text) {
        part.iov_base = text.data(), part.iov_len = text.size();
        header.msg_iov = &part, header.msg_iovlen = 1;
        header.msg_control = control, header.msg_controllen = sizeof control;
    }
    iovec part{};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr header{};
};

bool sendRequest(int socket, const std::string& request, int out) {
    std::vector<char> text(request.begin(), request.end());
    text.push_back('\0');
    Message message(text);
    cmsghdr* rights = CMSG_FIRSTHDR(&message.header);
    rights->cmsg_level = SOL_SOCKET, rights->cmsg_type = SCM_RIGHTS, rights->cmsg_len = CMSG_LEN(sizeof out);
    std::memcpy(CMSG_DATA(rights), &out, sizeof out);
    return sendmsg(socket, &message.header, MSG_NOSIGNAL) == ssize_t(text.size());
}

// Nothing once the other end is closed.
std::optional<std::string> receiveRequest(int socket, int& out) {
    std::vector<char> text(kLongestRequest + 1);
    Message message(text);
    const ssize_t size = recvmsg(socket, &message.header, MSG_CMSG_CLOEXEC);
    const cmsghdr* rights = CMSG_FIRSTHDR(&message.header);
    if (size <= 0 || !rights || rights->cmsg_type != SCM_RIGHTS) return std::nullopt;
    std::memcpy(&out, CMSG_DATA(rights), sizeof out);
    return std::string(text.data());
}

void applyLimits(const WorkLimits& limits) {
    const rlimit noCore{0, 0};
    setrlimit(RLIMIT_CORE, &noCore);
    alarm(limits.seconds);
    if (limits.bytes == 0) return;
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = pages * std::uint64_t(sysconf(_SC_PAGESIZE)) + limits.bytes;
    const rlimit space{most, most};
    setrlimit(RLIMIT_AS, &space);
}

[[noreturn]] void serve(int socket, const WorkerProcess::Work& work, const WorkLimits& limits) {
    // Interrupts are the other process's to handle; this one ends with it.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
    const int nowhere = open("/dev/null", O_RDWR);
    for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, descriptor);
    for (int out = -1; const std::optional<std::string> request = receiveRequest(socket, out);) {
        const pid_t worker = fork();
        if (worker == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            applyLimits(limits);
            try {
                work(*request, out);
                _exit(0);
            } catch (...) {
                _exit(kThrew);
            }
        }
        close(out);
        int status = -1;
        if (worker > 0) waitpid(worker, &status, 0);
        if (send(socket, &status, sizeof status, MSG_NOSIGNAL) != sizeof status) break;
    }
    _exit(0);
}

// Empty where it ended well.
std::string endOf(int status, const WorkLimits& limits) {
    if (status == 0) return {};
    if (WIFSIGNALED(status)) {
        if (WTERMSIG(status) == SIGALRM) return fmt::format("it took more than {} s", limits.seconds);
        return fmt::format("it ended by a signal ({})", strsignal(WTERMSIG(status)));
    }
    return "it ended early";
}

}  // namespace

WorkerProcess::WorkerProcess(const Work& work, const WorkLimits& limits) : limits_(limits) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) throw std::runtime_error("no sockets for a worker process");
    process_ = fork();
    if (process_ == 0) {
        close(ends[0]);
        serve(ends[1], work, limits);
    }
    close(ends[1]);
    socket_ = ends[0];
    if (process_ < 0) throw std::runtime_error("no worker process");
}

WorkerProcess::~WorkerProcess() {
    close(socket_);
    if (process_ > 0) waitpid(process_, nullptr, 0);
}

void WorkerProcess::run(const std::string& request, const std::function<void(int in)>& take) {
    if (request.size() > kLongestRequest || request.find('\0') != std::string::npos) throw WorkFailure("it is too much to ask for");
    const std::scoped_lock lock(mutex_);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe to a worker process");
    Descriptor in(ends[0]), out(ends[1]);
    fcntl(ends[0], F_SETPIPE_SZ, kPipeBytes);
    if (!sendRequest(socket_, request, out.get())) throw std::runtime_error("the worker process is gone");
    out.close();
    std::exception_ptr problem;
    try {
        take(in.get());
    } catch (...) {
        problem = std::current_exception();
    }
    in.close();  // a worker that goes on writing then ends
    int status = -1;
    if (recv(socket_, &status, sizeof status, 0) != sizeof status) throw std::runtime_error("the worker process is gone");
    const bool cutOff = problem && WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE;
    if (const std::string end = endOf(status, limits_); !end.empty() && !cutOff) throw WorkFailure(end);
    if (problem) std::rethrow_exception(problem);
}

void writeAll(int out, const void* data, std::size_t size) {
    for (const char* next = static_cast<const char*>(data); size > 0;) {
        const ssize_t count = write(out, next, std::min<std::size_t>(size, 1 << 30));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) throw std::runtime_error("the pipe from a worker process is closed");
        next += count, size -= std::size_t(count);
    }
}

void readAll(int in, void* data, std::size_t size) {
    for (char* next = static_cast<char*>(data); size > 0;) {
        const ssize_t count = read(in, next, std::min<std::size_t>(size, 1 << 30));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) throw WorkFailure("it wrote too little");
        next += count, size -= std::size_t(count);
    }
}

}  // namespace clv
