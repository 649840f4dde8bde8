// Compiles small shaders and C++ files that include the library's headers, with the tools of the command line.
#ifndef CLV_TESTS_PARITY_SHADER_STUB_H
#define CLV_TESTS_PARITY_SHADER_STUB_H
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/project_files.h"

namespace clv::test {

inline bool hasTool(const std::string& name) { return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0; }

// The shader tools are part of what this project is tested with: without them its tests fail.
inline testing::AssertionResult hasShaderTools() {
    for (const char* tool : {"glslangValidator", "spirv-val", "spirv-dis"}) {
        if (!hasTool(tool)) return testing::AssertionFailure() << tool << " is missing: install glslang-tools and spirv-tools";
    }
    return testing::AssertionSuccess();
}

// A folder for the running test's files.
inline fs::path scratchFolder() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    fs::path folder = fs::path(CLV_BINARY_DIR) / "parity" / (std::string(test->test_suite_name()) + "." + test->name());
    fs::create_directories(folder);
    return folder;
}

// Writes a source file into the scratch folder and runs a command there; a failure shows what it printed.
inline testing::AssertionResult run(const std::string& name, const std::string& source, const std::string& command) {
    fs::path folder = scratchFolder();
    std::ofstream(folder / name) << source;
    std::string line = "cd '" + folder.string() + "' && (" + command + ") > log.txt 2>&1";
    if (std::system(line.c_str()) == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << source << command << "\n" << readText(folder / "log.txt");
}

inline std::string including(const std::string& header) { return "#include \"" + header + "\"\n"; }

inline const std::string kIncludeOption = " -I'" + (kSourceDir / "include").string() + "'";

// Functions that the stub does not call are kept, so that spirv-val sees all of them. Leaves stub.spv and its text, stub.txt.
inline std::string glslangCommand(const std::string& arguments) {
    return "glslangValidator -V --target-env vulkan1.1 --keep-uncalled -o stub.spv" + kIncludeOption + " " + arguments +
           " && spirv-val --target-env vulkan1.1 stub.spv && spirv-dis -o stub.txt stub.spv";
}

inline testing::AssertionResult compilesAsGlsl(const std::string& declarations, const std::string& body = "") {
    return run("stub.comp",
               "#version 450\n#extension GL_GOOGLE_include_directive : require\n" + declarations +
                   "\nlayout(local_size_x = 1) in;\nvoid main() { " + body + " }\n",
               glslangCommand("stub.comp"));
}

inline testing::AssertionResult compilesAsHlsl(const std::string& declarations, const std::string& body = "") {
    return run("stub.hlsl", declarations + "\n[numthreads(1, 1, 1)] void main() { " + body + " }\n",
               glslangCommand("-D -DCLV_HLSL -S comp -e main stub.hlsl"));
}

inline testing::AssertionResult compilesAsCpp(const std::string& compiler, const std::string& declarations) {
    return run("stub.cpp", declarations,
               compiler + " -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only" + kIncludeOption + " stub.cpp");
}

}  // namespace clv::test
#endif
