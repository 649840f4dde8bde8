// Runs the built `clv` as its users do: as a process of its own.
#pragma once
#include <csignal>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <pty.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace clv {

struct CommandResult {
    int status = -1;       // exit status, or 128 + the signal that ended it
    std::string out, err;  // what it printed
};

// A running command. Its stderr is a terminal where `terminal` is set, else a pipe, as its stdout is.
class RunningCommand {
public:
    explicit RunningCommand(std::vector<std::string> arguments, bool terminal = false, const std::string& program = CLV_BINARY_DIR "/clv") {
        int out[2], err[2];
        if (pipe2(out, O_CLOEXEC) != 0 || (terminal ? openpty(&err[0], &err[1], nullptr, nullptr, nullptr) : pipe2(err, O_CLOEXEC)) != 0)
            throw std::runtime_error("no pipe");
        arguments.insert(arguments.begin(), program);
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        process_ = fork();
        if (process_ == 0) {
            // A shell that runs the tests in the background has them ignore interrupts, which children inherit.
            std::signal(SIGINT, SIG_DFL);
            dup2(out[1], STDOUT_FILENO);
            dup2(err[1], STDERR_FILENO);
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(out[1]);
        close(err[1]);
        outReader_ = std::thread(readAll, out[0], &result_.out);
        errReader_ = std::thread(readAll, err[0], &result_.err);
    }
    ~RunningCommand() {
        if (process_ > 0) kill(process_, SIGKILL), wait();
    }
    RunningCommand(const RunningCommand&) = delete;
    RunningCommand& operator=(const RunningCommand&) = delete;

    void send(int signal) const { kill(process_, signal); }

    CommandResult wait() {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = -1;
        outReader_.join();
        errReader_.join();
        result_.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return result_;
    }

private:
    static void readAll(int descriptor, std::string* text) {
        char buffer[4096];
        // A terminal whose other end is closed reads as an error, not as an end.
        for (ssize_t count; (count = read(descriptor, buffer, sizeof buffer)) > 0;) text->append(buffer, std::size_t(count));
        close(descriptor);
    }

    pid_t process_ = -1;
    CommandResult result_;
    std::thread outReader_, errReader_;
};

inline CommandResult runCommand(const std::vector<std::string>& arguments) {
    return RunningCommand(arguments).wait();
}

}  // namespace clv
