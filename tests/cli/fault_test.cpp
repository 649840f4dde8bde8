// Faults while a command works: no room on the disk, interrupts at any time. What it writes is whole or absent, and nothing else is left.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "clv/math/hash.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using Arguments = std::vector<std::string>;
using Names = std::vector<std::string>;

// A command, and what it leaves in the folder `out`.
struct Writes {
    Arguments arguments;
    Names outputs;
};

// While it lives, processes that are started have no more of a resource than this.
template <__rlimit_resource resource>
class Limit {
public:
    explicit Limit(rlim_t most) {
        getrlimit(resource, &before_);
        const rlimit small{most, before_.rlim_max};
        setrlimit(resource, &small);
    }
    ~Limit() { setrlimit(resource, &before_); }
    Limit(const Limit&) = delete;
    Limit& operator=(const Limit&) = delete;

private:
    rlimit before_{};
};
using SmallFiles = Limit<RLIMIT_FSIZE>;  // bytes of a file
using LittleMemory = Limit<RLIMIT_AS>;   // bytes of addresses

class Faults : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        std::string points = "px,py,pz,nx,ny,nz\n";
        for (int k = 0; k < 400; ++k) points += std::to_string(0.002 * k - 0.4) + ",0,0.1,0,1,0\n";
        write("p.csv", points);
    }
    std::vector<Writes> commands() const {
        return {{{"irradiance", "--scene", "cornell", "--points", file("p.csv"), "--out", file("out/r.csv"), "--rays", "100k"}, {"r.csv"}},
                {{"reference", "--scene", "cornell", "--points", file("p.csv"), "--out", file("out/r.csv"), "--samples", "64"}, {"r.csv"}},
                {{"scenes", "--write", file("out/cornell.glb")}, {"cornell.glb"}},
                {{"render", "--scene", "cornell", "--out", file("out"), "--width", "64", "--height", "48", "--rays", "100k", "--samples", "4", "--error-samples", "16"},
                 {"combined.exr", "combined.png", "direct.exr", "direct.png", "error.png", "indirect.exr", "indirect.png", "reference.exr", "reference.png"}},
                {{"bake", "--scene", "cornell", "--out", file("out/V.vtm"), "--rays", "100k", "--resolution", "16"}, {"V", "V.vtm"}},
                {{"bake", "--scene", "cornell", "--out", file("out/S.pvd"), "--rays", "100k", "--resolution", "12", "--frames", "3"}, {"S", "S.pvd"}}};
    }
    // A report into `out`, which goes on from what is there.
    CommandResult report(std::optional<rlim_t> mostBytes = {}, const std::function<void(RunningCommand&)>& meanwhile = {}) const {
        std::optional<SmallFiles> limit;
        if (mostBytes) limit.emplace(*mostBytes);
        RunningCommand running({"report", "--out", file("out"), "--scenes", "white_sphere", "--methods", "path_tracing", "--points", "20", "--truth-samples", "64",
                                "--repeats", "2", "--most-rays", "65536"});
        limit.reset();
        if (meanwhile) meanwhile(running);
        return running.wait();
    }
    // Of a finished report: all that follows from the seed.
    nlohmann::json errorsOf(const std::string& reportFile) const {
        const nlohmann::json report = nlohmann::json::parse(read(reportFile));
        nlohmann::json errors;
        for (const auto& m : report.at("measurements")) errors[m.at("key").get<std::string>()] = {m.at("relative_rmse"), m.at("bias"), m.at("p95")};
        return errors;
    }
    void expectNoPartOfAPage() const {
        for (const std::string& name : listing("out")) EXPECT_FALSE(name.starts_with("report.") || name.starts_with(".") || name.ends_with(".unfinished")) << name;
    }
    void emptyOut() const {
        std::filesystem::remove_all(folder_ / "out");
        std::filesystem::create_directory(folder_ / "out");
    }
};

TEST_F(Faults, aFullDiskIsAFailureInOneLineAndLeavesNothing) {
    for (const Writes& command : commands()) {
        SCOPED_TRACE(command.arguments[0]);
        emptyOut();
        std::optional<SmallFiles> limit(1000);
        RunningCommand running(command.arguments);
        limit.reset();
        const CommandResult result = running.wait();
        EXPECT_EQ(result.status, 1) << result.err;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_NE(result.err.find("cannot be written"), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find(".clv-"), std::string::npos) << "names the hidden folder: " << result.err;
        EXPECT_EQ(listing("out"), Names());
    }
}

TEST_F(Faults, memoryThatRunsOutIsAFailureInOneLineThatSaysWhatToLower) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers need more addresses than this";
#endif
    emptyOut();
    std::optional<LittleMemory> limit(rlim_t(2) << 30);
    RunningCommand running({"render", "--scene", "cornell", "--out", file("out"), "--width", "16384", "--height", "16384"});
    limit.reset();
    const CommandResult result = running.wait();
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("a smaller scene or picture"), std::string::npos) << result.err;
    EXPECT_EQ(listing("out"), Names());
}

TEST_F(Faults, anInterruptAtAnyTimeLeavesAllOrNothing) {
    int interrupted = 0;
    for (const Writes& command : commands()) {
        SCOPED_TRACE(command.arguments[0]);
        emptyOut();
        const auto begin = std::chrono::steady_clock::now();
        ASSERT_EQ(runCommand(command.arguments).status, 0);
        const auto whole = std::chrono::steady_clock::now() - begin;
        ASSERT_EQ(listing("out"), command.outputs);
        for (std::uint32_t k = 0; k < 4; ++k) {
            emptyOut();
            const int signal = k % 2 == 0 ? SIGINT : SIGTERM;
            RunningCommand running(command.arguments);
            std::this_thread::sleep_for(whole * double(clvUnitFloat(clvHashCombine(k, 7u))));
            running.send(signal);
            const CommandResult result = running.wait();
            if (result.status == 0) {
                EXPECT_EQ(listing("out"), command.outputs);
            } else {
                ++interrupted;
                EXPECT_EQ(result.status, 128 + signal) << result.err;
                const Names left = listing("out");
                // The pictures of a set get their names one after the other, while interrupts wait.
                EXPECT_TRUE(left.empty() || left == command.outputs) << left.size();
            }
        }
    }
    EXPECT_GT(interrupted, 4);
}

TEST_F(Faults, aReportGoesOnAfterAFullDiskAndAfterInterrupts) {
    emptyOut();
    ASSERT_EQ(report().status, 0);
    const nlohmann::json expected = errorsOf(file("out/report.json"));
    ASSERT_EQ(expected.size(), 2u);

    // Room for less and less of what it keeps and writes.
    for (const rlim_t mostBytes : {20000, 2000, 1000, 100}) {
        emptyOut();
        const CommandResult full = report(mostBytes);
        EXPECT_EQ(full.status, 1) << mostBytes << full.err;
        EXPECT_EQ(std::ranges::count(full.err, '\n'), 1) << full.err;
        EXPECT_NE(full.err.find("cannot be written"), std::string::npos) << full.err;
        expectNoPartOfAPage();
    }
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(report().status, 0);
    const auto whole = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(errorsOf(file("out/report.json")), expected);

    emptyOut();
    int interrupted = 0;
    double part = 0.9;
    for (std::uint32_t k = 0; k < 4 || (interrupted == 0 && k < 12); ++k) {
        const int signal = k % 2 == 0 ? SIGTERM : SIGINT;
        const CommandResult result = report({}, [&](RunningCommand& running) {
            std::this_thread::sleep_for(whole * part * double(clvUnitFloat(clvHashCombine(k, 11u))));
            running.send(signal);
        });
        if (result.status == 0) {
            // It was done sooner than the one that was timed: from the beginning, and earlier.
            part *= 0.5;
            emptyOut();
            continue;
        }
        ++interrupted;
        EXPECT_EQ(result.status, 128 + signal) << result.err;
        expectNoPartOfAPage();
    }
    EXPECT_GT(interrupted, 0);
    ASSERT_EQ(report().status, 0);
    EXPECT_EQ(errorsOf(file("out/report.json")), expected);
}

TEST_F(Faults, anInterruptedModelOfTheMachineLeavesTheOneBefore) {
    std::filesystem::create_directories(file("cache/clv"));
    std::ofstream(file("cache/clv/cost_model.json")) << "[]";
    setenv("XDG_CACHE_HOME", file("cache").c_str(), 1);
    RunningCommand running({"plan", "--scene", "furnace_box", "--resolution", "16", "--points", "100", "--budget-ms", "5"}, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    running.send(SIGINT);
    const CommandResult result = running.wait();
    unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(result.status, 128 + SIGINT) << "long before the machine is measured" << result.err;
    EXPECT_EQ(listing("cache/clv"), Names({"cost_model.json"}));
    EXPECT_EQ(std::filesystem::file_size(file("cache/clv/cost_model.json")), 2u);
}

}  // namespace
