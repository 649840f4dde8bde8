// A file that crashes the importer is one line and exit status 2, whichever command reads it; nothing is written.
#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using Arguments = std::vector<std::string>;

class HostileScene : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        write("p.csv", "px,py,pz,nx,ny,nz\n0.1,0,0.1,0,1,0\n");
        write("lamp.json", R"({"lights":[{"type":"point","position":[0.1,0.4,0.1],"intensity":[1,1,1]}]})");
        write("square.obj", "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nf 1 2 3 4\n");
        ASSERT_EQ(runCommand({"scenes", "--write", file("cornell.glb")}).status, 0);
    }
    std::vector<Arguments> commands(const std::string& scene) const {
        const Arguments from = {"--scene", file(scene), "--lights", file("lamp.json")};
        std::vector<Arguments> all = {{"plan"},
                                      {"irradiance", "--points", file("p.csv"), "--out", file("r.csv")},
                                      {"reference", "--points", file("p.csv"), "--out", file("r.csv")},
                                      {"render", "--out", file("pictures")},
                                      {"bake", "--out", file("v.vtm")}};
        for (Arguments& command : all) command.insert(command.end(), from.begin(), from.end());
        return all;
    }
    CommandResult runFailing(const std::string& how, const Arguments& arguments) const {
        setenv("LD_PRELOAD", CLV_FAILING_IMPORTER, 1);
        setenv("CLV_FAILING_IMPORTER", how.c_str(), 1);
        const CommandResult result = runCommand(arguments);
        unsetenv("LD_PRELOAD");
        unsetenv("CLV_FAILING_IMPORTER");
        return result;
    }
};

TEST_F(HostileScene, aCrashOfTheImporterIsOneLineThatNamesTheFile) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer's library must be loaded first";
#endif
    for (const char* scene : {"square.obj", "cornell.glb"}) {
        for (const auto& [how, word] : {std::pair{"crash", "Segmentation fault"}, {"abort", "Aborted"}, {"leave", "failed"}, {"eat", "memory"}}) {
            const auto before = listing();
            for (const Arguments& command : commands(scene)) {
                const CommandResult result = runFailing(how, command);
                EXPECT_EQ(result.status, 2) << command[0] << " " << how;
                EXPECT_EQ(result.out, "");
                EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
                EXPECT_NE(result.err.find(file(scene)), std::string::npos) << result.err;
                EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
                if (std::string(how) != "crash") break;
            }
            EXPECT_EQ(listing(), before);
        }
    }
}

TEST_F(HostileScene, aSoundFileIsReadAsBefore) {
    for (const char* scene : {"square.obj", "cornell.glb"}) {
        const CommandResult result = runCommand(commands(scene)[0]);
        EXPECT_EQ(result.status, 0) << result.err;
    }
}

}  // namespace
