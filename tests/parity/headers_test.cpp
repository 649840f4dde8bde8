// Every header compiles alone: the shared ones as C++, GLSL and HLSL, those of plan/ and cpu/ as C++.
#include <gtest/gtest.h>

#include "parity/shader_stub.h"

using namespace clv::test;

namespace {

bool isHostOnly(const std::string& header) {
    return header == "clv/clv.h" || header.starts_with("clv/plan/") || header.starts_with("clv/cpu/");
}

std::vector<std::string> sharedHeaders() {
    std::vector<std::string> headers = libraryHeaders();
    std::erase_if(headers, isHostOnly);
    return headers;
}

// What an entry point defines before it includes a header that walks buffers: one line a reader, with the headers of its types.
std::string readersOf(const std::string& header) {
    if (header == "clv/stages/surface.h") return "vec4 clvReadSurface(uint row) { return vec4(0.0, 1.0, 0.0, 0.0); }\n";
    if (header == "clv/stages/texture.h") {
        return "uvec4 clvReadTextureRow(uint row) { return uvec4(row, row, row, row); }\n"
               "vec4 clvReadTextureTexel(uint i) { return vec4(1.0, 1.0, 1.0, 1.0); }\n";
    }
    const std::string triangles = "#ifndef TRIANGLE_READER\n#define TRIANGLE_READER\nvec4 clvReadTriangle(uint row) { return vec4(0.0, 0.0, 0.0, 0.0); }\n#endif\n";
    if (header == "clv/stages/meet_triangle.h") return triangles;
    if (header == "clv/stages/rsm_from_faces.h") {
        return triangles + including("clv/stages/map_face.h") + "uint clvReadFaceTriangle(uvec2 texel, uint face) { return texel.x + face; }\n"
               "ClvMapFace clvReadMapFace(uint i) { ClvMapFace face; face.origin = vec3(0.0, 0.0, 0.0); face.light = i; face.right = face.origin; face.depthScale = 1.0;\n"
               "face.up = face.origin; face.parallel = 0u; face.forward = face.origin; face.pad0 = 0.0; return face; }\n";
    }
    if (header == "clv/stages/trace_bvh.h") {
        return triangles + "vec4 clvReadBvhBoxes(uint row) { return vec4(0.0, 0.0, 0.0, 0.0); }\n"
               "uvec4 clvReadBvhChildren(uint node) { return uvec4(node, node, node, node); }\n";
    }
    if (header == "clv/stages/ray_guide.h") {
        return "uint clvReadGuideCell(uint cell) { return cell; }\n"
               "float clvReadGuideWeight(uint i) { return 0.5; }\n";
    }
    if (header == "clv/stages/pick_texel.h") return "float clvReadTexelSum(uint i) { return 0.5; }\n";
    if (header == "clv/stages/find_slot.h" || header == "clv/stages/gather.h") {
        return including("clv/data/light_volume.h") + "#ifndef SPLIT_READER\n#define SPLIT_READER\nClvSplit clvReadSplit(uint i) {\n"
               "ClvSplit split; split.plane = vec4(1.0, 0.0, 0.0, 0.5); split.front = i; split.back = i; split.firstSlot = i; split.slotCount = 1u; return split; }\n#endif\n";
    }
    const std::string history = "#ifndef HISTORY_READER\n#define HISTORY_READER\nvec4 clvReadHistory(uint row) { return vec4(0.5, 0.5, 0.5, 0.5); }\n#endif\n";
    if (header == "clv/stages/read_record.h") return history;
    if (header == "clv/stages/lookup.h" || header == "clv/stages/deferred.h") {
        return readersOf("clv/stages/find_slot.h") + history + "#ifndef SLOT_READER\n#define SLOT_READER\nuint clvReadTable(uint cell) { return cell; }\n"
               "ClvSlot clvReadSlot(uint i) { ClvSlot slot; slot.openCentroid = vec3(0.0, 0.0, 0.0); slot.openVolume = 1.0; slot.visible = uvec4(i, i, i, i); slot.cell = i;\n"
               "slot.pad0 = i; slot.pad1 = i; slot.pad2 = i; return slot; }\n#endif\n";
    }
    return "";
}

std::string includingWithReaders(const std::string& header) { return including("clv/lang.h") + readersOf(header) + including(header); }

std::string includingAll() {
    std::string all;
    for (const std::string& header : sharedHeaders()) all += includingWithReaders(header);
    return all;
}

TEST(Glsl, everySharedHeaderCompilesAloneAndIsValid) {
    ASSERT_TRUE(hasShaderTools());
    ASSERT_GE(sharedHeaders().size(), 20u);
    for (const std::string& header : sharedHeaders()) EXPECT_TRUE(compilesAsGlsl(includingWithReaders(header)));
}

TEST(Hlsl, everySharedHeaderCompilesAloneAndIsValid) {
    ASSERT_TRUE(hasShaderTools());
    ASSERT_GE(sharedHeaders().size(), 20u);
    for (const std::string& header : sharedHeaders()) EXPECT_TRUE(compilesAsHlsl(includingWithReaders(header)));
}

TEST(Glsl, allSharedHeadersCompileTogether) { EXPECT_TRUE(compilesAsGlsl(includingAll())); }

TEST(Hlsl, allSharedHeadersCompileTogether) { EXPECT_TRUE(compilesAsHlsl(includingAll())); }

const std::string kOnlyCpp = "#include \"clv/lang.h\"\nCLV_FN vec3 f() { return vec3{1.0f}; }";
const std::string kShared = "#include \"clv/lang.h\"\nCLV_FN vec3 f() { return vec3(1.0f, 1.0f, 1.0f); }";

TEST(Glsl, whatOnlyCppTakesIsFound) {
    EXPECT_TRUE(compilesAsGlsl(kShared));
    EXPECT_FALSE(compilesAsGlsl(kOnlyCpp));
    EXPECT_FALSE(compilesAsGlsl(including("clv/no_such_header.h")));
}

TEST(Hlsl, whatOnlyCppTakesIsFound) {
    EXPECT_TRUE(compilesAsHlsl(kShared));
    EXPECT_FALSE(compilesAsHlsl(kOnlyCpp));
    EXPECT_FALSE(compilesAsHlsl(including("clv/no_such_header.h")));
}

void expectHeadersCompile(const std::string& compiler) {
    ASSERT_GE(libraryHeaders().size(), 25u);
    for (const std::string& header : libraryHeaders()) EXPECT_TRUE(compilesAsCpp(compiler, including(header)));
    EXPECT_FALSE(compilesAsCpp(compiler, "int f(int unused) { return 0; }\n")) << "warnings are not errors";
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
