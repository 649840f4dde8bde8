// Scenes, lamps and places to write that no light can be computed for: exit 2, one line, nothing half written.
#include <algorithm>
#include <filesystem>

#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using Arguments = std::vector<std::string>;

class BadScene : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        write("p.csv", "px,py,pz,nx,ny,nz\n0.1,0,0.1,0,1,0\n");
        lamp_ = write("lamp.json", lampOf("[1,1,1]"));
    }
    static std::string lampOf(const std::string& intensity) {
        return R"({"lights":[{"type":"point","position":[0.1,0.4,0.1],"intensity":)" + intensity + "}]}";
    }
    void expectRefused(const std::string& scene, const std::string& lights, const std::string& word) const {
        for (const Arguments& command : {Arguments{"irradiance", "--points", file("p.csv"), "--out", file("r.csv")}, {"plan"}}) {
            Arguments all = command;
            all.insert(all.end(), {"--scene", scene});
            if (!lights.empty()) all.insert(all.end(), {"--lights", lights});
            const auto before = listing();
            const CommandResult result = runCommand(all);
            EXPECT_EQ(result.status, 2) << scene << " " << lights << result.out;
            EXPECT_EQ(result.out, "");
            EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
            EXPECT_NE(result.err.find(word), std::string::npos) << result.err << "lacks " << word;
            EXPECT_EQ(listing(), before);
        }
    }

    std::string lamp_;
};

TEST_F(BadScene, scenesThatCannotBeReadAreRefused) {
    expectRefused(file("missing.glb"), lamp_, "missing.glb");
    expectRefused(write("malformed.gltf", "{\"asset\":"), lamp_, "malformed.gltf");
    ASSERT_EQ(runCommand({"scenes", "--write", file("cornell.glb")}).status, 0);
    const std::string whole = read(file("cornell.glb"));
    expectRefused(write("truncated.glb", whole.substr(0, whole.size() / 2)), lamp_, "truncated.glb");
}

TEST_F(BadScene, scenesWithoutLightsOrTrianglesOrWithBadOnesAreRefused) {
    const std::string corners = "v 0 0 0\nv 0 0 1\nv 1 0 0\n";
    const std::string good = write("good.obj", corners + "f 1 2 3\n");
    expectRefused(good, "", "lights");
    expectRefused(write("empty.obj", corners), lamp_, "empty.obj");
    expectRefused(write("nan.obj", "v nan 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n"), lamp_, "nan.obj");
    expectRefused(write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), lamp_, "flat.obj");
    write("bright.mtl", "newmtl bright\nKd 1.5 0.5 0.5\n");
    expectRefused(write("bright.obj", "mtllib bright.mtl\n" + corners + "usemtl bright\nf 1 2 3\n"), lamp_, "bright");
}

TEST_F(BadScene, lampsThatTakeLightAwayOrAreNotNumbersAreRefused) {
    for (const char* intensity : {"[-1,0,0]", "[1e999,0,0]", "[1,1]", "\"bright\""})
        expectRefused("cornell", write("bad.json", lampOf(intensity)), "bad.json");
}

TEST_F(BadScene, aDegenerateTriangleAmongGoodOnesIsDroppedAndCounted) {
    const std::string mixed = write("mixed.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\nf 1 1 2\n");
    const CommandResult result = runCommand({"plan", "--scene", mixed, "--lights", lamp_, "--json"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("\"dropped_triangles\": 1"), std::string::npos) << result.out;
}

TEST_F(BadScene, aPlaceThatCannotBeWrittenIsRefusedBeforeTheWork) {
    const CommandResult result = runCommand({"irradiance", "--scene", "cornell", "--points", file("p.csv"), "--out", file("missing/r.csv")});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("missing"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(file("missing")));
}

}  // namespace
