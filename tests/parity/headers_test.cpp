// Every header compiles alone: the shared ones as C++, GLSL and HLSL, those of plan/ and cpu/ as C++.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/project_files.h"

using namespace clv::test;

namespace {

const fs::path kInclude = kSourceDir / "include";

bool isHostOnly(const std::string& header) {
    return header == "clv/clv.h" || header.starts_with("clv/plan/") || header.starts_with("clv/cpu/");
}

std::vector<std::string> sharedHeaders() {
    std::vector<std::string> headers = libraryHeaders();
    std::erase_if(headers, isHostOnly);
    return headers;
}

bool hasTool(const std::string& name) { return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0; }

// A folder for one test's files.
fs::path scratchFolder() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    fs::path folder = fs::path(CLV_BINARY_DIR) / "parity" / (std::string(test->test_suite_name()) + "." + test->name());
    fs::create_directories(folder);
    return folder;
}

struct Source {
    std::string name;
    std::string text;
};

// Writes the source into the scratch folder and runs a command there; a failure shows what it printed.
testing::AssertionResult run(const Source& source, const std::string& command) {
    fs::path folder = scratchFolder();
    std::ofstream(folder / source.name) << source.text;
    std::string line = "cd '" + folder.string() + "' && (" + command + ") > log.txt 2>&1";
    if (std::system(line.c_str()) == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << source.text << command << "\n" << readText(folder / "log.txt");
}

const std::string kIncludeOption = " -I'" + kInclude.string() + "'";
// Functions that the stub does not call are kept, so that spirv-val sees all of them.
const std::string kGlslang = "glslangValidator -V --target-env vulkan1.1 --keep-uncalled -o out.spv" + kIncludeOption;
const std::string kValidate = " && spirv-val --target-env vulkan1.1 out.spv";

testing::AssertionResult compilesAsGlsl(const std::string& code) {
    Source source{"stub.comp", "#version 450\n#extension GL_GOOGLE_include_directive : require\n" + code +
                                   "\nlayout(local_size_x = 1) in;\nvoid main() {}\n"};
    return run(source, kGlslang + " stub.comp" + kValidate);
}

testing::AssertionResult compilesAsHlsl(const std::string& code) {
    Source source{"stub.hlsl", code + "\n[numthreads(1, 1, 1)] void main() {}\n"};
    return run(source, kGlslang + " -D -DCLV_HLSL -S comp -e main stub.hlsl" + kValidate);
}

testing::AssertionResult compilesAsCpp(const std::string& compiler, const std::string& code) {
    Source source{"stub.cpp", code + "\n"};
    return run(source, compiler + " -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only" + kIncludeOption + " stub.cpp");
}

std::string including(const std::string& header) { return "#include \"" + header + "\""; }

TEST(Glsl, everySharedHeaderCompilesAloneAndIsValid) {
    ASSERT_TRUE(hasTool("glslangValidator") && hasTool("spirv-val")) << "install glslang-tools and spirv-tools";
    ASSERT_GE(sharedHeaders().size(), 20u);
    for (const std::string& header : sharedHeaders()) EXPECT_TRUE(compilesAsGlsl(including(header)));
}

TEST(Hlsl, everySharedHeaderCompilesAloneAndIsValid) {
    ASSERT_TRUE(hasTool("glslangValidator") && hasTool("spirv-val")) << "install glslang-tools and spirv-tools";
    ASSERT_GE(sharedHeaders().size(), 20u);
    for (const std::string& header : sharedHeaders()) EXPECT_TRUE(compilesAsHlsl(including(header)));
}

TEST(Glsl, allSharedHeadersCompileTogether) {
    std::string all;
    for (const std::string& header : sharedHeaders()) all += including(header) + "\n";
    EXPECT_TRUE(compilesAsGlsl(all));
}

TEST(Hlsl, allSharedHeadersCompileTogether) {
    std::string all;
    for (const std::string& header : sharedHeaders()) all += including(header) + "\n";
    EXPECT_TRUE(compilesAsHlsl(all));
}

TEST(Glsl, aHeaderThatOnlyCppTakesIsFound) {
    EXPECT_FALSE(compilesAsGlsl("#include \"clv/lang.h\"\nvec3 f() { return vec3{1.0f}; }"));
    EXPECT_FALSE(compilesAsGlsl("#include \"clv/no_such_header.h\""));
}

TEST(Hlsl, aHeaderThatOnlyCppTakesIsFound) {
    EXPECT_FALSE(compilesAsHlsl("#include \"clv/lang.h\"\nvec3 f() { return vec3{1.0f}; }"));
    EXPECT_FALSE(compilesAsHlsl("#include \"clv/no_such_header.h\""));
}

void expectHeadersCompile(const std::string& compiler) {
    ASSERT_GE(libraryHeaders().size(), 25u);
    for (const std::string& header : libraryHeaders()) EXPECT_TRUE(compilesAsCpp(compiler, including(header)));
    EXPECT_FALSE(compilesAsCpp(compiler, "int f(int unused) { return 0; }")) << "warnings are not errors";
}

TEST(Cpp, everyHeaderCompilesAloneWithGccWithoutWarnings) {
    if (!hasTool("g++")) GTEST_SKIP() << "g++ is not installed: its warnings were not checked";
    expectHeadersCompile("g++");
}

TEST(Cpp, everyHeaderCompilesAloneWithClangWithoutWarnings) {
    if (!hasTool("clang++-14")) GTEST_SKIP() << "clang++-14 is not installed: its warnings were not checked";
    expectHeadersCompile("clang++-14");
}

}  // namespace
