// Structs that lie in buffers have the same offsets and size in C++, GLSL (std430) and HLSL.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <regex>

#include "clv/data/cascades.h"
#include "clv/data/hit.h"
#include "clv/data/light.h"
#include "clv/data/ray_packed.h"
#include "clv/data/rsm_texel.h"
#include "clv/stages/evaluate.h"
#include "clv/stages/map_face.h"
#include "clv/stages/merge.h"
#include "clv/stages/walk_check.h"
#include "parity/shader_stub.h"

using namespace clv;
using namespace clv::test;

namespace {

struct Layout {
    std::string header;
    std::string name;
    std::size_t size;
    std::vector<std::size_t> offsets;
};

const std::vector<Layout>& layouts() {
    static const std::vector<Layout> all{
        {"data/ray.h", "ClvRay", sizeof(ClvRay),
         {offsetof(ClvRay, origin), offsetof(ClvRay, maxDistance), offsetof(ClvRay, direction), offsetof(ClvRay, dynamicity),
          offsetof(ClvRay, flux), offsetof(ClvRay, pad0)}},
        {"data/rsm_texel.h", "ClvRsmTexel", sizeof(ClvRsmTexel),
         {offsetof(ClvRsmTexel, position), offsetof(ClvRsmTexel, dynamicity), offsetof(ClvRsmTexel, normal),
          offsetof(ClvRsmTexel, valid), offsetof(ClvRsmTexel, flux), offsetof(ClvRsmTexel, pad0)}},
        {"data/hit.h", "ClvHit", sizeof(ClvHit),
         {offsetof(ClvHit, normal), offsetof(ClvHit, distance), offsetof(ClvHit, albedo), offsetof(ClvHit, primitive)}},
        {"data/light.h", "ClvLight", sizeof(ClvLight),
         {offsetof(ClvLight, position), offsetof(ClvLight, type), offsetof(ClvLight, direction), offsetof(ClvLight, innerConeAngle),
          offsetof(ClvLight, intensity), offsetof(ClvLight, outerConeAngle), offsetof(ClvLight, dynamicity), offsetof(ClvLight, pad0),
          offsetof(ClvLight, pad1), offsetof(ClvLight, pad2)}},
        {"data/ray_packed.h", "ClvRayPacked", sizeof(ClvRayPacked), {offsetof(ClvRayPacked, path), offsetof(ClvRayPacked, load)}},
        {"data/light_volume.h", "ClvVolume", sizeof(ClvVolume),
         {offsetof(ClvVolume, origin), offsetof(ClvVolume, cellSize), offsetof(ClvVolume, resolution), offsetof(ClvVolume, storage),
          offsetof(ClvVolume, scroll), offsetof(ClvVolume, pad0)}},
        {"data/light_volume.h", "ClvSplit", sizeof(ClvSplit),
         {offsetof(ClvSplit, plane), offsetof(ClvSplit, front), offsetof(ClvSplit, back), offsetof(ClvSplit, firstSlot), offsetof(ClvSplit, slotCount)}},
        {"data/light_volume.h", "ClvSlot", sizeof(ClvSlot),
         {offsetof(ClvSlot, openCentroid), offsetof(ClvSlot, openVolume), offsetof(ClvSlot, visible), offsetof(ClvSlot, cell), offsetof(ClvSlot, pad0),
          offsetof(ClvSlot, pad1), offsetof(ClvSlot, pad2)}},
        {"data/cascades.h", "ClvCascades", sizeof(ClvCascades),
         {offsetof(ClvCascades, volumes), offsetof(ClvCascades, count), offsetof(ClvCascades, marginCells),
          offsetof(ClvCascades, blendCells), offsetof(ClvCascades, pad0)}},
        {"stages/evaluate.h", "ClvReceiver", sizeof(ClvReceiver),
         {offsetof(ClvReceiver, position), offsetof(ClvReceiver, pad0), offsetof(ClvReceiver, normal), offsetof(ClvReceiver, pad1)}},
        {"stages/walk_check.h", "ClvWalkCheck", sizeof(ClvWalkCheck),
         {offsetof(ClvWalkCheck, begin), offsetof(ClvWalkCheck, end), offsetof(ClvWalkCheck, cells), offsetof(ClvWalkCheck, faults),
          offsetof(ClvWalkCheck, farCell), offsetof(ClvWalkCheck, farAt)}},
        {"stages/map_face.h", "ClvMapFace", sizeof(ClvMapFace),
         {offsetof(ClvMapFace, origin), offsetof(ClvMapFace, light), offsetof(ClvMapFace, right), offsetof(ClvMapFace, depthScale), offsetof(ClvMapFace, up),
          offsetof(ClvMapFace, parallel), offsetof(ClvMapFace, forward), offsetof(ClvMapFace, pad0)}},
        {"stages/merge.h", "ClvMergeSettings", sizeof(ClvMergeSettings),
         {offsetof(ClvMergeSettings, timestep), offsetof(ClvMergeSettings, stillTime), offsetof(ClvMergeSettings, movingTime),
          offsetof(ClvMergeSettings, dynamicityTime)}},
    };
    return all;
}

// Reads the stub that was compiled last: an element of the buffer `items` must have the layout's stride and offsets.
void expectLayoutOfStub(const Layout& layout) {
    std::string text = readText(scratchFolder() / "stub.txt");
    std::smatch stride;
    // The type that lies in the buffer is the runtime array's element; glslang makes a second one without offsets for locals.
    ASSERT_TRUE(std::regex_search(text, stride, std::regex("%\\S+ = OpTypeRuntimeArray %(\\S+)")));
    std::string element = stride[1];
    ASSERT_TRUE(std::regex_search(text, stride, std::regex("OpDecorate %_runtimearr_" + element + " ArrayStride (\\d+)")));
    EXPECT_EQ(std::stoul(stride[1]), layout.size) << layout.name;
    std::map<std::size_t, std::size_t> offsets;
    std::regex member("OpMemberDecorate %" + element + " (\\d+) Offset (\\d+)");
    for (std::sregex_iterator it(text.begin(), text.end(), member), end; it != end; ++it) offsets[std::stoul((*it)[1])] = std::stoul((*it)[2]);
    ASSERT_EQ(offsets.size(), layout.offsets.size()) << layout.name;
    for (std::size_t i = 0; i < layout.offsets.size(); ++i) EXPECT_EQ(offsets[i], layout.offsets[i]) << layout.name << " member " << i;
}

TEST(Layout, ofGlslIsThatOfCpp) {
    ASSERT_TRUE(hasShaderTools());
    for (const Layout& layout : layouts()) {
        std::string buffer = "layout(std430, binding = 0) buffer Items { " + layout.name + " items[]; };";
        ASSERT_TRUE(compilesAsGlsl(including("clv/" + layout.header) + buffer, "items[0] = items[1];"));
        expectLayoutOfStub(layout);
    }
}

TEST(Layout, ofHlslIsThatOfCpp) {
    ASSERT_TRUE(hasShaderTools());
    for (const Layout& layout : layouts()) {
        std::string buffer = "[[vk::binding(0)]] RWStructuredBuffer<" + layout.name + "> items;";
        ASSERT_TRUE(compilesAsHlsl(including("clv/" + layout.header) + buffer, "items[0] = items[1];"));
        expectLayoutOfStub(layout);
    }
}

}  // namespace
