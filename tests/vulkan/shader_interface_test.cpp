// What shaders say of themselves, and how passes that do not match them are found.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "bindings/vulkan/shader_interface.h"
#include "clv/plan/light_frame.h"
#include "shaders/shader_code.h"
#include "vulkan/rays_frame.h"

using namespace clv;
using namespace clv::test;

namespace shader_interface_test {

constexpr ShaderLanguage kLanguages[] = {ShaderLanguage::glsl, ShaderLanguage::hlsl};

TEST(ShaderInterface, saysWhatAShaderBinds) {
    for (const ShaderLanguage language : kLanguages) {
        ShaderInterface shader = shaderInterface(shaderCode("rays", language));
        std::sort(shader.bindings.begin(), shader.bindings.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
        ASSERT_EQ(shader.bindings.size(), 4u);
        EXPECT_EQ(shader.bindings[0].number, std::uint32_t(CLV_BIND_FRAME));
        EXPECT_EQ(shader.bindings[0].kind, FrameBinding::uniform);
        EXPECT_EQ(shader.bindings[1].number, std::uint32_t(CLV_BIND_TEXELS));
        EXPECT_EQ(shader.bindings[2].number, std::uint32_t(CLV_BIND_TEXEL_SUMS));
        EXPECT_EQ(shader.bindings[3].number, std::uint32_t(CLV_BIND_RAYS));
        for (int i = 1; i < 4; ++i) {
            EXPECT_EQ(shader.bindings[i].kind, FrameBinding::storage);
            EXPECT_EQ(shader.bindings[i].writable, i == 3);
        }
        EXPECT_TRUE(shader.constants.empty());
        EXPECT_FALSE(shader.floatAtomics);
        EXPECT_FALSE(shader.shuffles);
    }
}

// Expects that `breakIt` makes exactly one mismatch, which holds `words`, of the rays' pass and their shader.
void expectMismatch(const std::function<void(Frame&, ShaderInterface&)>& breakIt, const std::string& words) {
    for (const ShaderLanguage language : kLanguages) {
        RaysFrame scene;
        ShaderInterface shader = shaderInterface(shaderCode("rays", language));
        breakIt(scene.frame, shader);
        const auto lines = shaderMismatches(scene.frame, scene.frame.steps[0].passes[0], shader, {});
        ASSERT_EQ(lines.size(), 1u) << words;
        EXPECT_NE(lines[0].find("pass rays: the shader rays " + words), std::string::npos) << lines[0];
    }
}

std::vector<FrameUse>& usesOf(Frame& frame) { return frame.steps[0].passes[0].uses; }

TEST(ShaderInterface, findsWhatDoesNotMatch) {
    expectMismatch([](Frame& f, ShaderInterface&) { usesOf(f).erase(usesOf(f).begin() + 1); }, "binds number 7, for which the pass has no buffer");
    expectMismatch([](Frame& f, ShaderInterface&) { f.buffers.push_back({"hits", CLV_BIND_HITS, 16}), usesOf(f).push_back({4}); }, "does not bind hits (binding 10)");
    expectMismatch([](Frame& f, ShaderInterface&) { usesOf(f)[0].binding = FrameBinding::storage; }, "binds frame (binding 0) as a uniform buffer, not as a storage buffer");
    expectMismatch([](Frame& f, ShaderInterface&) { usesOf(f)[1].binding = FrameBinding::texel; }, "binds texels (binding 7) as a storage buffer, not as a typed view");
    expectMismatch([](Frame& f, ShaderInterface&) { usesOf(f)[1].access = FrameAccess::write; }, "cannot write texels (binding 7), which the pass writes");
    expectMismatch([](Frame& f, ShaderInterface&) { usesOf(f)[3].access = FrameAccess::read; }, "may write rays (binding 9), which the pass only reads");
    expectMismatch([](Frame& f, ShaderInterface&) { f.steps[0].passes[0].constants = {{CLV_SPEC_STRIDE, 8}}; }, "has no constant 3");
    expectMismatch([](Frame&, ShaderInterface& s) { s.floatAtomics = true; }, "needs atomic additions of floats");
    expectMismatch([](Frame&, ShaderInterface& s) { s.rayQueries = true; }, "needs ray queries, which are not switched on");
    expectMismatch([](Frame&, ShaderInterface& s) { s.rayPipelines = true; }, "needs ray-tracing pipelines, which are not switched on");
    expectMismatch([](Frame&, ShaderInterface& s) { s.shuffles = true; }, "needs subgroups that can shuffle");
}

TEST(ShaderInterface, tellsIntegersFromFloatsInTypedViews) {
    RaysFrame scene;
    ShaderInterface shader{.bindings = {{CLV_BIND_FRAME, FrameBinding::uniform}, {CLV_BIND_TEXELS, FrameBinding::texel, false, true}, {CLV_BIND_TEXEL_SUMS}, {CLV_BIND_RAYS, FrameBinding::storage, true}},
                           .constants = {}};
    FramePass& pass = scene.frame.steps[0].passes[0];
    pass.uses[1] = {1, FrameBinding::texel, FrameAccess::read, FrameFormat::rgba32Uint};
    EXPECT_EQ(shaderMismatches(scene.frame, pass, shader, {}), std::vector<std::string>());
    pass.uses[1].format = FrameFormat::rgba32Float;
    EXPECT_EQ(shaderMismatches(scene.frame, pass, shader, {}).size(), 1u);
}

// A frame with one pass that draws two faces, and one that reads what was drawn.
struct DrawnFrame {
    Frame frame;
    ShaderInterface shaders;

    DrawnFrame() {
        frame.buffers = {{"frame", CLV_BIND_FRAME, sizeof(ClvFrame), FrameSource::host}, {"faces", CLV_BIND_MAP_FACES, 128, FrameSource::host},
                         {"triangles", CLV_BIND_TRIANGLES, 48, FrameSource::host}, frameImage("seen", CLV_BIND_FACE_TRIANGLES, {FrameFormat::r32Uint, FrameShape::array, uvec3(8, 8, 2)})};
        frame.steps = {{"rsm", {{"faces", "map_faces", {}, {{0, FrameBinding::uniform}, {1}, {2, FrameBinding::texel, FrameAccess::read, FrameFormat::rgba32Float}, {3, FrameBinding::target, FrameAccess::write}},
                                 uvec3(1), {}, {FrameTopology::triangles, 3}}}}};
    }
    FramePass& pass() { return frame.steps[0].passes[0]; }
};

TEST(ShaderInterface, putsTheShadersOfADrawTogether) {
    for (const ShaderLanguage language : kLanguages) {
        const ShaderInterface both = together(shaderInterface(shaderCode("map_faces.frag", language)), shaderInterface(shaderCode("map_faces.vert", language)));
        EXPECT_EQ(both.bindings.size(), 3u);
        DrawnFrame drawn;
        EXPECT_EQ(shaderMismatches(drawn.frame, drawn.pass(), both, {.draws = true}), std::vector<std::string>());
        EXPECT_EQ(shaderMismatches(drawn.frame, drawn.pass(), both, {}), std::vector<std::string>{"pass faces draws, and the device's queue does not"});
        // Integers are not added up; floats need a device that does.
        drawn.frame.buffers[3].image.format = FrameFormat::rgba32Float;
        drawn.pass().uses[3].blend = FrameBlend::add;
        EXPECT_EQ(shaderMismatches(drawn.frame, drawn.pass(), both, {.draws = true}).size(), 1u);
        EXPECT_EQ(shaderMismatches(drawn.frame, drawn.pass(), both, {.draws = true, .blendsFloats = true}), std::vector<std::string>());
    }
    const ShaderInterface a{.bindings = {{3, FrameBinding::storage, false}}, .constants = {1}, .floatAtomics = true}, b{.bindings = {{3, FrameBinding::storage, true}, {4}}, .constants = {1, 2}, .shuffles = true, .rayPipelines = true};
    const ShaderInterface sum = together(a, b);
    EXPECT_EQ(sum.bindings.size(), 2u);
    EXPECT_TRUE(sum.bindings[0].writable);
    EXPECT_EQ(sum.constants, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_TRUE(sum.floatAtomics && sum.shuffles && sum.rayPipelines);
}

TEST(ShaderInterface, tellsImagesByTheirShapeAndTexels) {
    for (const ShaderLanguage language : kLanguages) {
        const ShaderInterface shader = shaderInterface(shaderCode("rsm_from_faces", language));
        const auto image = std::find_if(shader.bindings.begin(), shader.bindings.end(), [](const ShaderBinding& b) { return b.number == CLV_BIND_FACE_TRIANGLES; });
        ASSERT_NE(image, shader.bindings.end());
        EXPECT_EQ(image->kind, FrameBinding::image);
        EXPECT_EQ(image->shape, FrameShape::array);
        EXPECT_TRUE(image->integers);
        DrawnFrame drawn;
        const FramePass reads{"reads", "rsm_from_faces", {}, {{3, FrameBinding::image}}, uvec3(1), {}};
        const ShaderInterface alone{.bindings = {*image}, .constants = {}};
        EXPECT_EQ(shaderMismatches(drawn.frame, reads, alone, {}), std::vector<std::string>());
        drawn.frame.buffers[3].image.shape = FrameShape::volume;
        EXPECT_NE(shaderMismatches(drawn.frame, reads, alone, {}).at(0).find("reads seen (binding 33) as an image of another shape"), std::string::npos);
        drawn.frame.buffers[3].image = {FrameFormat::rgba32Float, FrameShape::array, uvec3(8, 8, 2)};
        EXPECT_NE(shaderMismatches(drawn.frame, reads, alone, {}).at(0).find("reads seen (binding 33) as integers, not floats"), std::string::npos);
    }
}

TEST(ShaderInterface, tellsAccelerationStructures) {
    for (const std::string_view name : {"trace_query", "trace.rgen"}) {
        const ShaderInterface shader = shaderInterface(shaderCode(name, ShaderLanguage::glsl));
        EXPECT_EQ(shader.rayQueries, name == "trace_query");
        EXPECT_EQ(shader.rayPipelines, name == "trace.rgen");
        const auto structure = std::find_if(shader.bindings.begin(), shader.bindings.end(), [](const ShaderBinding& b) { return b.number == CLV_BIND_ACCELERATION; });
        ASSERT_NE(structure, shader.bindings.end());
        EXPECT_EQ(structure->kind, FrameBinding::acceleration);
        EXPECT_FALSE(structure->writable);
    }
    // What answers a ray binds nothing.
    for (const std::string_view name : {"nearest.rmiss", "nearest.rchit"}) EXPECT_TRUE(shaderInterface(shaderCode(name, ShaderLanguage::glsl)).bindings.empty());
}

TEST(ShaderInterface, refusesWhatIsNoSpirv) {
    const std::vector<std::uint32_t> text{0x6c6c6568, 0x6f77206f, 0, 0, 0};
    EXPECT_THROW(shaderInterface(text), std::runtime_error);
    EXPECT_THROW(shaderInterface({}), std::runtime_error);
    const auto words = shaderCode("rays", ShaderLanguage::glsl);  // its first instruction takes the words 5 and 6
    EXPECT_THROW(shaderInterface(words.first(6)), std::runtime_error);
}

// GLSL and HLSL of a name bind the same and take the same constants.
TEST(ShaderInterface, isTheSameInBothLanguages) {
    int compared = 0;
    for (const ShaderCode& glsl : shaderCodes()) {
        if (glsl.language != ShaderLanguage::glsl || shaderInterface(glsl.words).rayQueries || shaderInterface(glsl.words).rayPipelines) continue;
        ShaderInterface a = shaderInterface(glsl.words), b = shaderInterface(shaderCode(glsl.name, ShaderLanguage::hlsl));
        for (ShaderInterface* shader : {&a, &b}) {
            std::sort(shader->bindings.begin(), shader->bindings.end(), [](const auto& x, const auto& y) { return x.number < y.number; });
            std::sort(shader->constants.begin(), shader->constants.end());
        }
        ASSERT_EQ(a.bindings.size(), b.bindings.size()) << glsl.name;
        for (std::size_t i = 0; i < a.bindings.size(); ++i) {
            EXPECT_EQ(a.bindings[i].number, b.bindings[i].number) << glsl.name;
            EXPECT_EQ(a.bindings[i].kind, b.bindings[i].kind) << glsl.name << " " << a.bindings[i].number;
            EXPECT_EQ(a.bindings[i].writable, b.bindings[i].writable) << glsl.name << " " << a.bindings[i].number;
            EXPECT_EQ(a.bindings[i].integers, b.bindings[i].integers) << glsl.name << " " << a.bindings[i].number;
        }
        EXPECT_EQ(a.constants, b.constants) << glsl.name;
        ++compared;
    }
    EXPECT_GT(compared, 0);
}

}  // namespace shader_interface_test
