// Work that crashes, hangs or eats memory is a failure in words, and the next request is served.
#include "bindings/scene/worker_process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

using namespace clv;

namespace {

constexpr std::size_t kMuch = 50'000'000;  // bytes

void work(const std::string& request, int out) {
    std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would answer it by an exit of its own
    if (request == "segmentation fault") std::raise(SIGSEGV);
    if (request == "abort") std::abort();
    if (request == "hang") pause();
    if (request == "throw") throw std::runtime_error("thrown");
    if (request == "leave") _exit(7);
    if (request == "print") std::puts("printed"), std::fputs("printed", stderr), std::fflush(stdout);
    if (request == "eat") {
        std::vector<std::vector<char>> eaten;
        while (eaten.size() < 4096) eaten.emplace_back(std::size_t(1) << 20, 'x');
    }
    if (request == "half") {
        writeAll(out, "half", 4);
        std::raise(SIGSEGV);
    }
    const std::vector<char> bytes(request == "much" ? kMuch : 5, 'x');
    writeAll(out, bytes.data(), bytes.size());
}

struct WorkerProcessTest : testing::Test {
    // What the work wrote, or how it failed.
    std::string said(const std::string& request, std::size_t bytes = 5) { return saidBy(process, request, bytes); }
    static std::string saidBy(WorkerProcess& process, const std::string& request, std::size_t bytes = 5) {
        std::string text(bytes, '\0');
        try {
            process.run(request, [&](int in) { readAll(in, text.data(), text.size()); });
        } catch (const WorkFailure& failure) {
            return failure.what();
        }
        return text;
    }
    static constexpr std::uint64_t kBytes = std::uint64_t(1) << 30;
    WorkerProcess process{work, {.seconds = 1, .bytes = kBytes}};
};

TEST_F(WorkerProcessTest, handsOverWhatTheWorkWrites) {
    EXPECT_EQ(said("good"), "xxxxx");
    EXPECT_EQ(said("much", kMuch), std::string(kMuch, 'x'));
}

TEST_F(WorkerProcessTest, saysHowWorkEndsThatDoesNotEndWell) {
    EXPECT_NE(said("segmentation fault").find("Segmentation fault"), std::string::npos);
    EXPECT_NE(said("abort").find("Aborted"), std::string::npos);
    EXPECT_NE(said("half").find("Segmentation fault"), std::string::npos);
    EXPECT_EQ(said("throw"), "it ended early");
    EXPECT_EQ(said("leave"), "it ended early");
    EXPECT_EQ(said("good"), "xxxxx") << "the next one is served";
}

TEST_F(WorkerProcessTest, endsWorkThatHangs) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(said("hang"), "it took more than 1 s");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    EXPECT_EQ(said("good"), "xxxxx");
}

TEST_F(WorkerProcessTest, endsWorkThatEatsAllMemory) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer ends a process that is out of memory in its own way";
#endif
    WorkerProcess patient{work, {.seconds = 300, .bytes = kBytes}};  // on a busy machine it takes more than a second to take so much
    EXPECT_EQ(saidBy(patient, "eat"), "it ended early");
}

TEST_F(WorkerProcessTest, showsNothingThatTheWorkPrints) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_EQ(said("print"), "xxxxx");
    EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST_F(WorkerProcessTest, passesOnWhatTheReaderThrows) {
    EXPECT_THROW(process.run("much", [](int) { throw std::out_of_range("enough"); }), std::out_of_range);
    EXPECT_THROW(process.run("good", [](int in) {
        char more[100];
        readAll(in, more, sizeof more);
    }), std::runtime_error);
    EXPECT_EQ(said("good"), "xxxxx");
}

TEST_F(WorkerProcessTest, refusesWhatIsTooMuchToAskFor) {
    EXPECT_EQ(said(std::string(1 << 20, 'x')), "it is too much to ask for");
    EXPECT_EQ(said("good"), "xxxxx");
}

TEST(WorkerProcess, leavesNoDescriptorOpen) {
    const auto next = [] {
        const int descriptor = dup(STDIN_FILENO);
        close(descriptor);
        return descriptor;
    };
    const int before = next();
    for (int k = 0; k < 3; ++k) {
        WorkerProcess process(work, {});
        EXPECT_THROW(process.run("abort", [](int) {}), WorkFailure);
    }
    EXPECT_EQ(next(), before);
}

}  // namespace
