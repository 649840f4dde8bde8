// The shaders in other languages: those that use core features alone go through SPIRV-Cross to Metal and to Direct3D's shader model 5,
// and what the others need is what docs/gpu.md says.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "bindings/vulkan/shader_interface.h"
#include "shaders/shader_code.h"
#include "support/project_files.h"

using namespace clv;
using namespace clv::test;

namespace {

std::string nameOf(const ShaderCode& shader) { return std::string(shader.language == ShaderLanguage::glsl ? "GLSL " : "HLSL ") + std::string(shader.name); }

// What a shader needs beside compute, storage buffers and typed views: the words of the table in docs/gpu.md.
std::string needsOf(const ShaderCode& shader) {
    const ShaderInterface needs = shaderInterface(shader.words);
    std::string words;
    if (needs.floatAtomics) words = "float atomics";
    if (needs.rayQueries) words += words.empty() ? "ray queries" : ", ray queries";
    if (needs.rayPipelines) words += words.empty() ? "ray-tracing pipelines" : ", ray-tracing pipelines";
    if (needs.shuffles) words += words.empty() ? "subgroup shuffles" : ", subgroup shuffles";
    return words;
}

std::string stageOf(const ShaderCode& shader) { return shader.name.ends_with(".vert") ? "vert" : shader.name.ends_with(".frag") ? "frag" : "comp"; }

// What an entry point begins with in Metal.
std::string metalKeyword(const ShaderCode& shader) { return stageOf(shader) == "vert" ? "vertex " : stageOf(shader) == "frag" ? "fragment " : "kernel void main0("; }

class Portability : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = fs::temp_directory_path() / "clv_portability_XXXXXX";
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }

    // Whether the command ends well; its words are kept.
    bool runs(const std::string& command) {
        const bool good = std::system((command + " >" + file("log") + " 2>&1").c_str()) == 0;
        log_ = readText(file("log"));
        return good;
    }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    void writeSpirv(const ShaderCode& shader) const {
        std::ofstream(file("shader.spv"), std::ios::binary).write(reinterpret_cast<const char*>(shader.words.data()), std::streamsize(shader.words.size_bytes()));
    }
    // Translates the shader.spv, and says whether SPIRV-Cross could.
    bool translates(const std::string& arguments, const std::string& output) { return runs("spirv-cross " + file("shader.spv") + " " + arguments + " --output " + file(output)); }

    fs::path folder_;
    std::string log_;
};

constexpr const char* kMetal = "--msl --msl-version 20100";
constexpr const char* kShaderModel5 = "--hlsl --shader-model 50";
constexpr const char* kShaderModel6 = "--hlsl --shader-model 60";

TEST_F(Portability, coreShadersBecomeMetalAndShaderModel5) {
    int translated = 0;
    for (const ShaderCode& shader : shaderCodes()) {
        if (!needsOf(shader).empty()) continue;
        writeSpirv(shader);
        EXPECT_TRUE(translates(kMetal, "shader.metal")) << nameOf(shader) << ": " << log_;
        EXPECT_NE(readText(file("shader.metal")).find(metalKeyword(shader)), std::string::npos) << nameOf(shader);
        ASSERT_TRUE(translates(kShaderModel5, "shader.hlsl")) << nameOf(shader) << ": " << log_;
        // What came out is HLSL: glslang takes it, and the validator takes what that makes of it.
        EXPECT_TRUE(runs("glslangValidator --quiet -V --target-env vulkan1.1 -D -S " + stageOf(shader) + " -e main --auto-map-bindings -o " + file("again.spv") + " " + file("shader.hlsl"))) << nameOf(shader) << ": " << log_;
        EXPECT_TRUE(runs("spirv-val --target-env vulkan1.1 " + file("again.spv"))) << nameOf(shader) << ": " << log_;
        ++translated;
    }
    EXPECT_GT(translated, 0);
}

TEST_F(Portability, subgroupShufflesNeedShaderModel6) {
    for (const ShaderCode& shader : shaderCodes()) {
        if (needsOf(shader) != "subgroup shuffles") continue;
        writeSpirv(shader);
        EXPECT_FALSE(translates(kShaderModel5, "shader.hlsl")) << nameOf(shader) << " could lose its row in docs/gpu.md";
        EXPECT_TRUE(translates(kShaderModel6, "shader.hlsl")) << nameOf(shader) << ": " << log_;
        EXPECT_TRUE(translates(kMetal, "shader.metal")) << nameOf(shader) << ": " << log_;
    }
}

// SPIRV-Cross writes GLSL's atomicAdd into Metal, which has no such function, without an error: such shaders are not for Metal.
TEST_F(Portability, floatAtomicsAreOfGlslAlone) {
    for (const ShaderCode& shader : shaderCodes()) {
        if (needsOf(shader).find("float atomics") == std::string::npos) continue;
        EXPECT_EQ(shader.language, ShaderLanguage::glsl) << nameOf(shader);
        writeSpirv(shader);
        EXPECT_FALSE(translates(kShaderModel5, "shader.hlsl")) << nameOf(shader) << " could lose its row in docs/gpu.md";
        ASSERT_TRUE(translates(kMetal, "shader.metal")) << nameOf(shader) << ": " << log_;
        EXPECT_NE(readText(file("shader.metal")).find("= atomicAdd("), std::string::npos) << nameOf(shader) << " could lose its row in docs/gpu.md";
    }
}

// glslang's HLSL knows no RayQuery, but SPIRV-Cross writes it.
TEST_F(Portability, rayQueriesBecomeMetal24AndShaderModel65) {
    int found = 0;
    for (const ShaderCode& shader : shaderCodes()) {
        if (needsOf(shader) != "ray queries") continue;
        EXPECT_EQ(shader.language, ShaderLanguage::glsl) << nameOf(shader);
        writeSpirv(shader);
        ASSERT_TRUE(translates("--hlsl --shader-model 65", "shader.hlsl")) << nameOf(shader) << ": " << log_;
        EXPECT_NE(readText(file("shader.hlsl")).find(".TraceRayInline("), std::string::npos) << nameOf(shader);
        EXPECT_FALSE(translates(kMetal, "shader.metal")) << nameOf(shader) << " could do with less than Metal 2.4";
        ASSERT_TRUE(translates("--msl --msl-version 20400", "shader.metal")) << nameOf(shader) << ": " << log_;
        EXPECT_NE(readText(file("shader.metal")).find("intersection_query<"), std::string::npos) << nameOf(shader);
        ++found;
    }
    EXPECT_GT(found, 0);
}

// SPIRV-Cross writes no stage of theirs in another language.
TEST_F(Portability, rayTracingPipelinesAreOfGlslAlone) {
    int found = 0;
    for (const ShaderCode& shader : shaderCodes()) {
        if (needsOf(shader) != "ray-tracing pipelines") continue;
        EXPECT_EQ(shader.language, ShaderLanguage::glsl) << nameOf(shader);
        writeSpirv(shader);
        if (shader.name.ends_with(".rmiss")) continue;  // it writes a number alone, which comes out as a function that nothing calls
        EXPECT_FALSE(translates("--hlsl --shader-model 65", "shader.hlsl")) << nameOf(shader) << " could be more portable than docs/gpu.md says";
        EXPECT_FALSE(translates("--msl --msl-version 30000", "shader.metal")) << nameOf(shader) << " could be more portable than docs/gpu.md says";
        ++found;
    }
    EXPECT_GT(found, 0);
}

// Rows of the table in docs/gpu.md: shader -> what GLSL needs, what HLSL needs.
std::map<std::string, std::pair<std::string, std::string>> documentedNeeds() {
    std::map<std::string, std::pair<std::string, std::string>> rows;
    std::istringstream lines(readText(kSourceDir / "docs/gpu.md"));
    bool inTable = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("| shader |")) inTable = true;
        if (line.empty()) inTable = false;
        if (!inTable || line.starts_with("| shader |") || line.starts_with("|---")) continue;
        std::vector<std::string> cells;
        std::istringstream row(line.substr(1));
        for (std::string cell; std::getline(row, cell, '|');) {
            const auto first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
            cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
        }
        // Several shaders may share a row.
        std::istringstream names(cells.at(0));
        for (std::string name; std::getline(names, name, ',');) {
            name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == '`' || c == ' '; }), name.end());
            rows[name] = {cells.at(1), cells.at(2)};
        }
    }
    return rows;
}

TEST(Needs, ofShadersAreAsDocumented) {
    const auto rows = documentedNeeds();
    std::set<std::string> built;
    for (const ShaderCode& shader : shaderCodes()) {
        const std::string name(shader.name);
        built.insert(name);
        ASSERT_TRUE(rows.contains(name)) << "the table of docs/gpu.md lacks " << name;
        const std::string& documented = shader.language == ShaderLanguage::glsl ? rows.at(name).first : rows.at(name).second;
        EXPECT_EQ(documented, needsOf(shader).empty() ? "core" : needsOf(shader)) << nameOf(shader);
    }
    for (const auto& [name, needs] : rows) EXPECT_TRUE(built.contains(name)) << "docs/gpu.md has a row for " << name << ", which is not built";
}

}  // namespace
