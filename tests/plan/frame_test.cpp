// Barriers between the passes of a frame, and the check that finds what is wrong with a description.
#include <gtest/gtest.h>

#include <functional>

#include "clv/plan/frame_check.h"
#include "clv/plan/triangle_corners.h"

using namespace clv;

namespace {

FrameUse reads(std::uint32_t buffer) { return {buffer, FrameBinding::storage, FrameAccess::read, FrameFormat::none}; }
FrameUse writes(std::uint32_t buffer) { return {buffer, FrameBinding::storage, FrameAccess::write, FrameFormat::none}; }
FrameUse changes(std::uint32_t buffer) { return {buffer, FrameBinding::storage, FrameAccess::readWrite, FrameFormat::none}; }
FramePass pass(const std::string& name, std::vector<FrameUse> uses) { return {name, name, {}, std::move(uses), uvec3(1), {}}; }

// Barriers of a step whose passes use one buffer each time as given: for each pass, the passes that it waits for.
std::vector<std::vector<std::uint32_t>> barriersOf(const std::vector<FrameUse>& uses) {
    Frame frame;
    frame.buffers = {{"a", 0, 16, FrameSource::zero, true}};
    frame.steps = {{"step", {}}};
    for (const FrameUse& use : uses) frame.steps[0].passes.push_back(pass("p", {use}));
    addBarriers(frame);
    std::vector<std::vector<std::uint32_t>> after;
    for (const FramePass& p : frame.steps[0].passes) {
        after.emplace_back();
        for (const FrameBarrier& barrier : p.barriers) after.back().push_back(barrier.after);
    }
    return after;
}

using Passes = std::vector<std::vector<std::uint32_t>>;

TEST(Barriers, stayAwayBetweenReads) { EXPECT_EQ(barriersOf({reads(0), reads(0), reads(0)}), (Passes{{}, {}, {}})); }

TEST(Barriers, orderAReadAfterTheLastWriteAlone) { EXPECT_EQ(barriersOf({writes(0), writes(0), reads(0), reads(0)}), (Passes{{}, {0}, {1}, {1}})); }

TEST(Barriers, orderAWriteAfterEveryReadSinceTheLastWrite) { EXPECT_EQ(barriersOf({writes(0), reads(0), reads(0), writes(0)}), (Passes{{}, {0}, {0}, {2, 1, 0}})); }

TEST(Barriers, orderPassesThatChangeABufferInARow) { EXPECT_EQ(barriersOf({changes(0), changes(0), changes(0)}), (Passes{{}, {0}, {1}})); }

TEST(Barriers, concernTheBufferThatIsShared) {
    Frame frame;
    frame.buffers = {{"a", 0, 16, FrameSource::passes}, {"b", 1, 16, FrameSource::passes, true}};
    frame.steps = {{"step", {pass("first", {writes(0)}), pass("second", {writes(1)}), pass("third", {reads(0), changes(1)})}}};
    addBarriers(frame);
    ASSERT_EQ(frame.steps[0].passes[2].barriers.size(), 2u);
    EXPECT_EQ(frame.steps[0].passes[2].barriers[0].buffer, 0u);
    EXPECT_EQ(frame.steps[0].passes[2].barriers[0].after, 0u);
    EXPECT_EQ(frame.steps[0].passes[2].barriers[1].buffer, 1u);
    EXPECT_EQ(frame.steps[0].passes[2].barriers[1].after, 1u);
}

TEST(Barriers, areNotNeededBetweenSteps) {
    Frame frame;
    frame.buffers = {{"a", 0, 16, FrameSource::passes}};
    frame.steps = {{"one", {pass("writes", {writes(0)})}}, {"two", {pass("reads", {reads(0)})}}};
    addBarriers(frame);
    EXPECT_TRUE(frame.steps[1].passes[0].barriers.empty());
    EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
}

// Two steps, every kind of binding and source, a pass without a shader: nothing is wrong with it.
Frame goodFrame() {
    Frame frame;
    frame.buffers = {{"constants", 0, 64, FrameSource::host},     {"rows", 1, 1024, FrameSource::host},   {"counts", 2, 256, FrameSource::passes},
                     {"history", 3, 4096, FrameSource::zero, true}, {"result", 4, 256, FrameSource::passes, true}};
    frame.steps = {{"light",
                    {{"clear", "", {}, {writes(2)}, uvec3(1), {}},
                     {"count", "count", {{CLV_SPEC_STRIDE, 8}, {CLV_SPEC_CHANNELS, 3}}, {{0, FrameBinding::uniform}, {1, FrameBinding::texel, FrameAccess::read, FrameFormat::rgba32Float}, changes(2)}, uvec3(16, 1, 1), {}},
                     {"merge", "merge", {}, {reads(2), changes(3)}, uvec3(16, 1, 1), {}}}},
                   {"evaluate", {{"evaluate", "evaluate", {}, {reads(3), writes(4)}, uvec3(4, 1, 1), {}}}}};
    addBarriers(frame);
    return frame;
}

// Expects that `breakIt` gives the good frame exactly one fault, which holds `words`.
void expectFault(const std::function<void(Frame&)>& breakIt, const std::string& words, const FrameLimits& limits = {}) {
    Frame frame = goodFrame();
    breakIt(frame);
    const std::vector<std::string> faults = checkFrame(frame, limits);
    ASSERT_EQ(faults.size(), 1u) << words << (faults.size() > 1 ? "; " + faults[0] + "; " + faults[1] : "");
    EXPECT_NE(faults[0].find(words), std::string::npos) << faults[0];
}

TEST(FrameCheck, findsNothingInAGoodFrame) { EXPECT_EQ(checkFrame(goodFrame()), std::vector<std::string>()); }

TEST(FrameCheck, findsAMissingBarrier) {
    expectFault([](Frame& f) { f.steps[0].passes[1].barriers.clear(); }, "count has no barrier for counts after clear");
    expectFault([](Frame& f) { f.steps[0].passes[2].barriers.clear(); }, "merge has no barrier for counts after count");
}

TEST(FrameCheck, findsABarrierThatIsNotBehindAnEarlierPass) {
    expectFault([](Frame& f) { f.steps[0].passes[1].barriers.push_back({2, 1}); }, "count has a barrier that is not after an earlier pass");
    expectFault([](Frame& f) { f.steps[0].passes[1].barriers.push_back({5, 0}); }, "count has a barrier that is not after an earlier pass");
}

TEST(FrameCheck, findsAReadBeforeAnyWrite) {
    expectFault([](Frame& f) { f.steps[0].passes.erase(f.steps[0].passes.begin()), addBarriers(f); }, "count reads counts, which nothing has written");
    expectFault([](Frame& f) { f.buffers[3].source = FrameSource::passes; }, "merge reads history, which nothing has written");
    expectFault([](Frame& f) { std::swap(f.steps[0], f.steps[1]), f.buffers[3].source = FrameSource::passes, f.steps[1].passes[2].uses[1] = writes(3); }, "evaluate reads history, which nothing has written");
}

TEST(FrameCheck, findsBuffersThatServeNobody) {
    expectFault([](Frame& f) { f.buffers.push_back({"spare", 9, 16, FrameSource::host}); }, "spare is declared and unused");
    expectFault([](Frame& f) { f.buffers[4].readBack = false; }, "result is written and never read");
}

TEST(FrameCheck, findsBuffersOfNoUsableSize) {
    expectFault([](Frame& f) { f.buffers[2].bytes = 0; }, "counts has no bytes");
    expectFault([](Frame& f) { f.buffers[2].bytes = 255; }, "counts is no whole number of words");
    expectFault([](Frame& f) { f.buffers[1].bytes = 1000; }, "rows in a format that its bytes are no multiple of");
}

TEST(FrameCheck, findsNamesAndNumbersGivenTwice) {
    expectFault([](Frame& f) { f.buffers[1].name = "constants"; }, "constants is declared twice");
    expectFault([](Frame& f) { f.steps[1].name = "light"; }, "light is declared twice");
    expectFault([](Frame& f) { f.buffers[4].binding = 3; }, "evaluate binds the number of result twice");
    expectFault([](Frame& f) { f.steps[0].passes[1].constants[1].id = CLV_SPEC_STRIDE; }, "count sets constant");
}

TEST(FrameCheck, findsUsesThatNoApiAllows) {
    expectFault([](Frame& f) { f.steps[0].passes[1].uses[0].access = FrameAccess::readWrite; }, "writes constants through a read-only view");
    expectFault([](Frame& f) { f.steps[0].passes[1].uses[1].format = FrameFormat::none; }, "uses rows with a format where it has none, or without");
    expectFault([](Frame& f) { f.steps[0].passes[2].uses[0].format = FrameFormat::r32Float; }, "uses counts with a format where it has none, or without");
    expectFault([](Frame& f) { f.steps[1].passes[0].uses.push_back(reads(5)); }, "evaluate uses a buffer that is not declared");
    expectFault([](Frame& f) { f.steps[0].passes[0].uses = {changes(2)}, f.buffers[2].source = FrameSource::zero; }, "clear has no shader");
}

TEST(FrameCheck, findsWorkThatADeviceDoesNotTake) {
    expectFault([](Frame& f) { f.steps[0].passes[1].groups = uvec3(65536, 1, 1); }, "count has 65536 work groups along an axis, more than 65535");
    expectFault([](Frame& f) { f.steps[0].passes[1].groups = uvec3(1, 0, 1); }, "count has no work groups");
    expectFault([](Frame& f) { f.steps[0].passes[2].groups = uvec3(4, 1, 1); }, "count has 16 work groups along an axis, more than 15", {.groups = 15});
    expectFault([](Frame& f) { f.steps.pop_back(), f.buffers.pop_back(); }, "merge has 2 storage buffers, more than 1", {.storageBuffers = 1, .storageBytes = 4096});
    expectFault([](Frame&) {}, "count uses constants of 64 bytes, more than 63", {.uniformBytes = 63});
    expectFault([](Frame& f) { f.steps[1].passes[0].uses = {writes(4)}; }, "merge uses history of 4096 bytes, more than 4095", {.storageBytes = 4095});
    expectFault([](Frame&) {}, "count uses rows of 64 elements, more than 63", {.texelElements = 63});
}

// Builds an acceleration structure of four triangles, and searches it.
Frame buildingFrame() {
    Frame frame;
    frame.buffers = {{"corners", 0, 4 * kFrameCornerBytes, FrameSource::host}, {"structure", 1, 1000, FrameSource::passes}, {"result", 2, 256, FrameSource::passes, true}};
    frame.buffers[1].triangles = 4;
    frame.steps = {{"scene", {{"build", "", {}, {{0, FrameBinding::corners}, {1, FrameBinding::acceleration, FrameAccess::write}}, uvec3(1), {}},
                              {"search", "search", {}, {{1, FrameBinding::acceleration}, writes(2)}, uvec3(1), {}}}}};
    addBarriers(frame);
    return frame;
}

TEST(Building, isFreeOfFaultsAndWaitedFor) {
    const Frame frame = buildingFrame();
    EXPECT_EQ(checkFrame(frame, {.storageBytes = 999}), std::vector<std::string>());
    ASSERT_EQ(frame.steps[0].passes[1].barriers.size(), 1u);
    EXPECT_EQ(frame.steps[0].passes[1].barriers[0].buffer, 1u);
    EXPECT_TRUE(frame.steps[0].passes[0].builds());
    EXPECT_FALSE(frame.steps[0].passes[1].builds());
}

TEST(Building, needsCornersAndAStructure) {
    const auto expect = [](const std::function<void(Frame&, std::vector<FramePass>&)>& breakIt, const std::string& words) {
        Frame frame = buildingFrame();
        breakIt(frame, frame.steps[0].passes);
        const std::vector<std::string> faults = checkFrame(frame);
        EXPECT_TRUE(std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) { return fault.find(words) != std::string::npos; })) << words;
    };
    expect([](Frame&, auto& passes) { passes[1].barriers.clear(); }, "search has no barrier for structure after build");
    expect([](Frame&, auto& passes) { passes.erase(passes.begin()); }, "search reads structure, which nothing has written");
    expect([](Frame& f, auto&) { f.buffers[0].bytes -= 4; }, "build has no corners for some of its triangles");
    expect([](Frame&, auto& passes) { passes[0].uses[0] = reads(0); }, "build has no shader: it must read corners and write an acceleration structure");
    expect([](Frame&, auto& passes) { passes[0].uses.pop_back(); }, "build has no shader");
    expect([](Frame&, auto& passes) { passes[0].uses.erase(passes[0].uses.begin()); }, "build has no shader");
    expect([](Frame& f, auto&) { f.buffers[1].triangles = 0; }, "uses structure as an acceleration structure");
    expect([](Frame&, auto& passes) { passes[1].uses[0] = reads(1); }, "search uses structure as a buffer");
    expect([](Frame&, auto& passes) { passes[1].uses[0].access = FrameAccess::readWrite; }, "search writes structure through a read-only view");
    expect([](Frame&, auto& passes) { passes[1].uses.push_back({0, FrameBinding::corners}); }, "search binds corners to a shader");
    expect([](Frame& f, auto&) { f.buffers[1].source = FrameSource::host; }, "structure is not built by a pass, or is read as data");
    expect([](Frame& f, auto&) { f.buffers[1].readBack = true; }, "structure is not built by a pass, or is read as data");
}

// The same, searched by rays that a pipeline sends.
Frame sendingFrame() {
    Frame frame = buildingFrame();
    frame.steps[0].passes[1].rays = {"none", "nearest"};
    frame.steps[0].passes[1].groups = uvec3(3, 2, 1);
    return frame;
}

TEST(SendingRays, takesThreeShadersAndAnInvocationAThread) {
    const Frame frame = sendingFrame();
    const FramePass& pass = frame.steps[0].passes[1];
    EXPECT_TRUE(pass.sendsRays());
    EXPECT_FALSE(frame.steps[0].passes[0].sendsRays());
    EXPECT_EQ(frameShaders(pass), (std::vector<std::string>{"search.rgen", "none.rmiss", "nearest.rchit"}));
    EXPECT_EQ(frameThreads(pass), uvec3(3 * CLV_GROUP_SIZE, 2, 1));
    EXPECT_EQ(checkFrame(frame, {.raySenders = 6 * CLV_GROUP_SIZE}), std::vector<std::string>());
}

TEST(SendingRays, needsAStructureAndSomebodyWhoAnswers) {
    const auto expect = [](const std::function<void(Frame&, FramePass&)>& breakIt, const std::string& words, const FrameLimits& limits = {}) {
        Frame frame = sendingFrame();
        breakIt(frame, frame.steps[0].passes[1]);
        const std::vector<std::string> faults = checkFrame(frame, limits);
        EXPECT_TRUE(std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) { return fault.find(words) != std::string::npos; })) << words;
    };
    expect([](Frame&, FramePass& pass) { pass.rays.miss.clear(); }, "search sends rays and names no shader for those that miss");
    expect([](Frame&, FramePass& pass) { pass.rays.hit.clear(); }, "search sends rays and names no shader for those that hit");
    expect([](Frame&, FramePass& pass) { pass.uses.erase(pass.uses.begin()); }, "search sends rays and reads no acceleration structure");
    expect([](Frame&, FramePass& pass) { pass.raster = {FrameTopology::lines, 2}; }, "search sends rays and draws");
    expect([](Frame&, FramePass& pass) { pass.shader.clear(); }, "search sends rays and has no shader that does");
    expect([](Frame&, FramePass&) {}, "search sends rays from 384 invocations, more than 383", {.raySenders = 383});
}

TEST(Building, takesCornersInTheOrderOfTheTriangles) {
    const std::vector<vec4> rows{vec4(1, 2, 3, 7), vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(4, 5, 6, 8), vec4(0, 0, 2, 0), vec4(3, 0, 0, 0)};
    const std::vector<vec3> two{vec3(1, 2, 3), vec3(2, 2, 3), vec3(1, 3, 3), vec3(4, 5, 6), vec3(4, 5, 8), vec3(7, 5, 6)};
    EXPECT_EQ(triangleCorners(rows, 2), two);
    std::vector<vec3> padded = two;
    padded.resize(9, two[0]);
    EXPECT_EQ(triangleCorners(rows, 3), padded);
    EXPECT_EQ(triangleCorners({}, 1), std::vector<vec3>(3, vec3(0.0f)));
}

// Draws three layers into two volumes and depths, by lines whose number a pass has counted, and reads what was drawn.
Frame drawingFrame() {
    Frame frame;
    frame.buffers = {{"draws", 0, 3 * sizeof(FrameDrawArguments), FrameSource::passes},
                     frameImage("light", 1, {FrameFormat::rgba32Float, FrameShape::volume, uvec3(4, 5, 3)}),
                     frameImage("dark", 2, {FrameFormat::rgba16Float, FrameShape::volume, uvec3(4, 5, 3)}),
                     frameImage("depths", 3, {FrameFormat::depth32Float, FrameShape::flat, uvec3(4, 5, 1)}),
                     {"result", 4, 256, FrameSource::passes, true}};
    const FrameUse light{1, FrameBinding::target, FrameAccess::write, FrameFormat::none, FrameBlend::addKeepLargestAlpha};
    const FrameUse dark{2, FrameBinding::target, FrameAccess::write}, depths{3, FrameBinding::target, FrameAccess::write};
    frame.steps = {{"light",
                    {{"count", "count", {}, {writes(0)}, uvec3(1), {}},
                     {"draw", "draw", {}, {{0, FrameBinding::arguments}, light, dark, depths}, uvec3(1), {}, {FrameTopology::lines}},
                     {"read", "read", {}, {{1, FrameBinding::image}, {2, FrameBinding::image}, writes(4)}, uvec3(1), {}}}}};
    addBarriers(frame);
    return frame;
}

void expectDrawingFault(const std::function<void(Frame&)>& breakIt, const std::string& words, const FrameLimits& limits = {}) {
    Frame frame = drawingFrame();
    breakIt(frame);
    const std::vector<std::string> faults = checkFrame(frame, limits);
    ASSERT_EQ(faults.size(), 1u) << words << (faults.size() > 1 ? "; " + faults[0] + "; " + faults[1] : "");
    EXPECT_NE(faults[0].find(words), std::string::npos) << faults[0];
}

FramePass& drawOf(Frame& frame) { return frame.steps[0].passes[1]; }

TEST(Drawing, isFreeOfFaultsAndStatesItsMemory) {
    const Frame frame = drawingFrame();
    EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
    EXPECT_EQ(frameLayers(frame, frame.steps[0].passes[1]), 3u);
    EXPECT_EQ(frameLayers(frame, frame.steps[0].passes[0]), 0u);
    EXPECT_EQ(frame.bytes(), 3 * 16 + 60 * 16 + 60 * 8 + 20 * 4 + 256u);
}

TEST(Drawing, waitsForItsArgumentsAndIsWaitedFor) {
    const Frame frame = drawingFrame();
    const FrameStep& step = frame.steps[0];
    ASSERT_EQ(step.passes[1].barriers.size(), 1u);
    EXPECT_EQ(step.passes[1].barriers[0].buffer, 0u);
    ASSERT_EQ(step.passes[2].barriers.size(), 2u);
    EXPECT_EQ(step.passes[2].barriers[0].after, 1u);
    expectDrawingFault([](Frame& f) { drawOf(f).barriers.clear(); }, "draw has no barrier for draws after count");
    expectDrawingFault([](Frame& f) { f.steps[0].passes[2].barriers.pop_back(); }, "read has no barrier for dark after draw");
}

TEST(Drawing, needsToKnowHowMuchAndWhereTo) {
    expectDrawingFault([](Frame& f) { drawOf(f).raster.vertices = 3; }, "draw must say how much it draws, once");
    expectDrawingFault([](Frame& f) { drawOf(f).raster.topology = FrameTopology::none; }, "draw has targets and does not draw");
    expectDrawingFault([](Frame& f) { f.buffers[0].bytes -= 16; }, "draw has no arguments for some of its draws");
    expectDrawingFault([](Frame& f) { drawOf(f).uses[2].access = FrameAccess::read, f.buffers[2].source = FrameSource::zero; }, "draw only reads its target dark");
    expectDrawingFault([](Frame& f) { drawOf(f).uses[3].blend = FrameBlend::add; }, "draw blends depths");
    expectDrawingFault([](Frame& f) { f.buffers[3] = frameImage("depths", 3, {FrameFormat::depth32Float, FrameShape::flat, uvec3(5, 5, 1)}); }, "draw draws into images of different sizes");
    expectDrawingFault([](Frame& f) { f.buffers[2] = frameImage("dark", 2, {FrameFormat::rgba16Float, FrameShape::volume, uvec3(4, 5, 2)}); }, "draw draws into images of different sizes");
    expectDrawingFault([](Frame& f) { drawOf(f).uses = {drawOf(f).uses[0], drawOf(f).uses[3]}, f.buffers[1].source = f.buffers[2].source = FrameSource::zero; }, "draw draws into no image of colours");
    expectDrawingFault([](Frame&) {}, "draw draws into 2 images, more than 1", {.colourTargets = 1});
}

TEST(Drawing, keepsWhatATargetHeldOnlyWhereItWasWritten) {
    expectDrawingFault([](Frame& f) { drawOf(f).uses[1].access = FrameAccess::readWrite; }, "draw reads light, which nothing has written");
    Frame frame = drawingFrame();
    drawOf(frame).uses[1].access = FrameAccess::readWrite, frame.buffers[1].source = FrameSource::zero;
    EXPECT_EQ(checkFrame(frame), std::vector<std::string>());
}

TEST(Images, areFoundWhereADescriptionIsWrong) {
    expectDrawingFault([](Frame& f) { f.buffers[1].bytes += 16; }, "image light has not the bytes of its texels");
    expectDrawingFault([](Frame& f) { f.buffers[1].source = FrameSource::host; }, "image light is the host's to fill");
    expectDrawingFault([](Frame& f) { f.buffers[1].image.shape = FrameShape::flat; }, "image light is flat and has layers");
    expectDrawingFault([](Frame& f) { f.steps[0].passes[2].uses[0].binding = FrameBinding::storage; }, "read uses light as a buffer");
    expectDrawingFault([](Frame& f) { f.steps[0].passes[2].uses.push_back({0, FrameBinding::image}), addBarriers(f); }, "read uses draws as an image");
    expectDrawingFault([](Frame& f) { f.steps[0].passes[2].uses[0].access = FrameAccess::readWrite, addBarriers(f); }, "read writes light through a read-only view");
    expectDrawingFault([](Frame& f) { f.buffers[1].image.shape = FrameShape::array; }, "image light is larger than a device takes", {.imageLayers = 2});
    expectDrawingFault([](Frame& f) { f.buffers[1].image.shape = FrameShape::array; }, "image dark is larger than a device takes", {.volumeSide = 4});
}

}  // namespace
