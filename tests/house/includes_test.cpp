// Includes point one way, and the umbrella holds everything.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <regex>
#include <set>

#include "support/project_files.h"

using namespace clv::test;

namespace {

// "bindings" of "bindings/embree/rsm.h" for depth 0, "embree" for depth 1; "" where a file lies there.
std::string folderOf(const std::string& file, int depth) {
    fs::path path = fs::path(file).parent_path();
    auto part = path.begin();
    for (; depth > 0 && part != path.end(); --depth) ++part;
    return part == path.end() ? "" : part->string();
}

// Place of a library header in the order of includes; none for the umbrella.
std::optional<int> rankOf(const std::string& file) {
    static const std::map<std::string, int> ranks{{"math", 1}, {"data", 2}, {"stages", 3}, {"plan", 4}, {"cpu", 5}};
    if (file == "include/clv/clv.h") return std::nullopt;
    auto found = ranks.find(folderOf(file, 2));
    return found == ranks.end() ? 0 : found->second;
}

// Bindings that see another one beside cli, which sees all: Embree builds its acceleration structure from the imported scene, and a
// volume file names the lights and the camera.
const std::set<std::pair<std::string, std::string>> kBindingPairs{{"embree", "scene"}, {"volume_file", "scene"}};

// Why a file of the project must not include another one; empty if it may.
std::string wrongArrow(const std::string& from, const std::string& to) {
    std::string source = folderOf(from, 0), target = folderOf(to, 0);
    if (source != target && target == "tests") return "nothing sees tests";
    if (source != target && source != "tests" && target == "viz") return "only tests see viz";
    if (source != target && target == "benchmarks" && source != "tests" && source != "viz" && !from.starts_with("bindings/cli/")) return "only cli, viz and tests see benchmarks";
    if (source == "include") {
        if (target != "include") return "the library sees itself alone";
        if (!rankOf(from)) return "";
        if (!rankOf(to)) return "the library does not include its umbrella";
        if (*rankOf(to) > *rankOf(from)) return "lang -> math -> data -> stages -> plan -> cpu";
    }
    if (source == "shaders") {
        if (target == "bindings") return "shaders do not see bindings";
        if (target == "include" && (!rankOf(to) || *rankOf(to) > 3)) return "shaders see include/ up to stages";
    }
    if (source == "bindings" && target == "bindings") {
        std::string mine = folderOf(from, 1), other = folderOf(to, 1);
        if (mine != other && mine != "cli" && !kBindingPairs.contains({mine, other})) return "bindings do not see each other";
    }
    return "";
}

struct Include {
    std::string name;
    bool quoted;
};

std::vector<Include> includesOf(const std::string& file) {
    static const std::regex line(R"(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])", std::regex::multiline);
    std::vector<Include> includes;
    std::string text = readText(kSourceDir / file);
    for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) includes.push_back({(*it)[2], (*it)[1] == "\""});
    return includes;
}

// The project's file that an include means; empty where it is none of the project's.
std::string resolve(const std::string& file, const std::string& name) {
    for (const fs::path& base : {fs::path(file).parent_path(), fs::path(""), fs::path("include"), fs::path("tests")}) {
        fs::path candidate = (base / name).lexically_normal();
        if (fs::is_regular_file(kSourceDir / candidate)) return candidate.generic_string();
    }
    return "";
}

bool isSource(const std::string& file) {
    static const std::set<std::string> endings{".h", ".hpp", ".c", ".cpp", ".glsl", ".comp", ".vert", ".frag", ".rgen", ".rmiss", ".rchit", ".hlsl"};
    return endings.contains(fs::path(file).extension().string());
}

TEST(Includes, pointOneWay) {
    int arrows = 0;
    for (const std::string& file : projectFiles("")) {
        if (!isSource(file)) continue;
        for (const Include& include : includesOf(file)) {
            std::string target = resolve(file, include.name);
            if (target.empty()) continue;
            ++arrows;
            std::string problem = wrongArrow(file, target);
            EXPECT_TRUE(problem.empty()) << file << " includes " << target << ": " << problem;
        }
    }
    EXPECT_GT(arrows, 50) << "the project's includes were not found";
}

TEST(Includes, theLibrarySeesTheStandardLibraryAndGlmAlone) {
    for (const std::string& header : libraryHeaders()) {
        for (const Include& include : includesOf("include/" + header)) {
            if (include.quoted) {
                EXPECT_NE(resolve("include/" + header, include.name), "") << header << " includes " << include.name;
                continue;
            }
            bool standard = include.name.find_first_of("./") == std::string::npos;
            bool intrinsics = include.name == "immintrin.h" && header.starts_with("clv/cpu/");
            EXPECT_TRUE(standard || intrinsics || include.name.starts_with("glm/")) << header << " includes " << include.name;
        }
    }
}

TEST(Includes, anArrowThatRunsBackIsFound) {
    EXPECT_NE(wrongArrow("include/clv/math/hash.h", "include/clv/data/ray.h"), "");
    EXPECT_NE(wrongArrow("include/clv/lang.h", "include/clv/math/hash.h"), "");
    EXPECT_NE(wrongArrow("include/clv/data/ray.h", "include/clv/stages/rays.h"), "");
    EXPECT_NE(wrongArrow("include/clv/stages/rays.h", "include/clv/cpu/level.h"), "");
    EXPECT_NE(wrongArrow("include/clv/plan/x.h", "include/clv/cpu/level.h"), "");
    EXPECT_NE(wrongArrow("include/clv/cpu/level.h", "include/clv/clv.h"), "");
    EXPECT_NE(wrongArrow("include/clv/cpu/level.h", "bindings/scene/scene.h"), "");
    EXPECT_NE(wrongArrow("shaders/glsl/inject.comp", "include/clv/cpu/level.h"), "");
    EXPECT_NE(wrongArrow("shaders/glsl/inject.comp", "include/clv/clv.h"), "");
    EXPECT_NE(wrongArrow("bindings/scene/scene.h", "bindings/embree/rsm.h"), "");
    EXPECT_NE(wrongArrow("bindings/image/image.h", "bindings/cli/options.h"), "");
    EXPECT_NE(wrongArrow("bindings/cli/options.cpp", "tests/support/chi_square.h"), "");
    EXPECT_NE(wrongArrow("bindings/cli/report.cpp", "viz/view.h"), "");
    EXPECT_NE(wrongArrow("bindings/embree/rsm.cpp", "benchmarks/baselines/a.h"), "");
}

TEST(Includes, anArrowThatRunsForwardIsAllowed) {
    EXPECT_EQ(wrongArrow("include/clv/math/hash.h", "include/clv/lang.h"), "");
    EXPECT_EQ(wrongArrow("include/clv/data/ray.h", "include/clv/data/hit.h"), "");
    EXPECT_EQ(wrongArrow("include/clv/cpu/inject.h", "include/clv/stages/inject.h"), "");
    EXPECT_EQ(wrongArrow("include/clv/clv.h", "include/clv/cpu/level.h"), "");
    EXPECT_EQ(wrongArrow("shaders/glsl/inject.comp", "include/clv/stages/inject.h"), "");
    EXPECT_EQ(wrongArrow("bindings/cli/render.cpp", "bindings/embree/rsm.h"), "");
    EXPECT_EQ(wrongArrow("bindings/cli/report.cpp", "benchmarks/baselines/a.h"), "");
    EXPECT_EQ(wrongArrow("bindings/vulkan/a.cpp", "shaders/bindings.h"), "");
    EXPECT_EQ(wrongArrow("tests/cpu/a_test.cpp", "bindings/embree/rsm.h"), "");
    EXPECT_EQ(wrongArrow("viz/a.cpp", "benchmarks/report/a.h"), "");
    EXPECT_EQ(wrongArrow("viz/a.cpp", "bindings/cli/a.h"), "");
    EXPECT_EQ(wrongArrow("tests/viz/a_test.cpp", "viz/a.h"), "");
    EXPECT_EQ(wrongArrow("tests/baselines/a_test.cpp", "benchmarks/baselines/a.h"), "");
}

TEST(Umbrella, includesEveryHeaderOfTheLibrary) {
    std::set<std::string> included;
    for (const Include& include : includesOf("include/clv/clv.h")) included.insert("clv/" + include.name);
    for (const std::string& header : libraryHeaders()) {
        EXPECT_TRUE(header == "clv/clv.h" || included.contains(header)) << "include/clv/clv.h lacks " << header;
    }
}

TEST(Umbrella, versionIsThatOfTheProject) {
    std::string umbrella = readText(kSourceDir / "include/clv/clv.h"), cmake = readText(kSourceDir / "CMakeLists.txt");
    std::smatch version;
    ASSERT_TRUE(std::regex_search(cmake, version, std::regex(R"(project\(clv VERSION (\d+)\.(\d+)\.(\d+))")));
    EXPECT_NE(umbrella.find("#define CLV_VERSION_MAJOR " + version[1].str() + "\n"), std::string::npos);
    EXPECT_NE(umbrella.find("#define CLV_VERSION_MINOR " + version[2].str() + "\n"), std::string::npos);
    EXPECT_NE(umbrella.find("#define CLV_VERSION_PATCH " + version[3].str() + "\n"), std::string::npos);
}

}  // namespace
