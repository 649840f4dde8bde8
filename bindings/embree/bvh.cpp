#include "bindings/embree/bvh.h"

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include "clv/math/finite.h"

namespace clv {
namespace {

constexpr std::size_t kBranching = 4;
// A walk leaves at most all children but one behind at every node on its way down.
constexpr unsigned kMaxDepth = kClvBvhStack / (kBranching - 1);
constexpr unsigned kMaxLeafSize = 4;  // triangles

struct BuildNode {
    bool leaf;
    std::uint32_t count;  // children of a node, triangles of a leaf
    std::array<RTCBounds, kBranching> bounds;
    union {
        std::array<BuildNode*, kBranching> children;
        std::array<std::uint32_t, kMaxLeafSize> triangles;
    };
};

BuildNode* newNode(RTCThreadLocalAllocator allocator, bool leaf, std::size_t count) {
    auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode;
    node->leaf = leaf;
    node->count = std::uint32_t(count);
    return node;
}

RTCBuildArguments buildArguments() {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = kBranching;
    arguments.maxDepth = kMaxDepth;
    arguments.maxLeafSize = kMaxLeafSize;
    arguments.createNode = [](RTCThreadLocalAllocator allocator, unsigned count, void*) -> void* { return newNode(allocator, false, count); };
    arguments.createLeaf = [](RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) -> void* {
        BuildNode* leaf = newNode(allocator, true, count);
        for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
        return leaf;
    };
    arguments.setNodeChildren = [](void* node, void** children, unsigned count, void*) {
        std::copy_n(reinterpret_cast<BuildNode**>(children), count, static_cast<BuildNode*>(node)->children.begin());
    };
    arguments.setNodeBounds = [](void* node, const RTCBounds** bounds, unsigned count, void*) {
        for (unsigned i = 0; i < count; ++i) static_cast<BuildNode*>(node)->bounds[i] = *bounds[i];
    };
    return arguments;
}

std::vector<RTCBuildPrimitive> primitivesOf(const Scene& scene) {
    std::vector<RTCBuildPrimitive> primitives;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const glm::uvec3& c = scene.triangles[t];
        const vec3 a = scene.positions[c.x], b = scene.positions[c.y], d = scene.positions[c.z];
        if (!clvIsFinite(a) || !clvIsFinite(b) || !clvIsFinite(d) || cross(b - a, d - a) == vec3(0.0f)) continue;
        const vec3 lo = min(min(a, b), d), hi = max(max(a, b), d);
        primitives.push_back({lo.x, lo.y, lo.z, 0, hi.x, hi.y, hi.z, t});
    }
    return primitives;
}

// Writes a tree in rows, each node before its children.
class BvhWriter {
public:
    BvhWriter(const Scene& scene, Bvh& bvh) : scene_(scene), bvh_(bvh) {}

    // The root may be a leaf, or null where there is nothing.
    void write(const BuildNode* root) {
        if (root && !root->leaf) {
            addNode(*root);
            return;
        }
        BuildNode above{.leaf = false, .count = root ? 1u : 0u, .bounds = {}, .children = {}};
        if (root) {
            const Bounds& b = scene_.bounds;
            above.bounds[0] = {b.lo.x, b.lo.y, b.lo.z, 0.0f, b.hi.x, b.hi.y, b.hi.z, 0.0f};
            above.children[0] = const_cast<BuildNode*>(root);
        }
        addNode(above);
    }

private:
    std::uint32_t addNode(const BuildNode& node) {
        const auto index = std::uint32_t(bvh_.children.size());
        bvh_.boxes.resize(bvh_.boxes.size() + kClvBvhBoxRows, vec4(kClvFar));
        bvh_.children.push_back(uvec4(kClvNoChild));
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const RTCBounds& b = node.bounds[i];
            const std::array<float, kClvBvhBoxRows> sides{b.lower_x, b.upper_x, b.lower_y, b.upper_y, b.lower_z, b.upper_z};
            for (std::uint32_t row = 0; row < kClvBvhBoxRows; ++row) bvh_.boxes[index * kClvBvhBoxRows + row][int(i)] = sides[row];
            const BuildNode& child = *node.children[i];
            const std::uint32_t written = child.leaf ? addLeaf(child) : addNode(child);
            bvh_.children[index][int(i)] = written;
        }
        return index;
    }

    std::uint32_t addLeaf(const BuildNode& leaf) {
        const auto first = std::uint32_t(bvh_.triangles.size() / kClvTriangleRows);
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const std::uint32_t t = leaf.triangles[i];
            const glm::uvec3& c = scene_.triangles[t];
            const vec3 a = scene_.positions[c.x];
            bvh_.triangles.push_back(vec4(a, float(t & 0xffffu)));
            bvh_.triangles.push_back(vec4(scene_.positions[c.y] - a, float(t >> 16)));
            bvh_.triangles.push_back(vec4(scene_.positions[c.z] - a, 0.0f));
        }
        return clvBvhLeaf(first, leaf.count);
    }

    const Scene& scene_;
    Bvh& bvh_;
};

}  // namespace

Bvh buildBvh(const Scene& scene) {
    std::vector<RTCBuildPrimitive> primitives = primitivesOf(scene);
    const RTCDevice device = rtcNewDevice(nullptr);
    if (!device) throw std::runtime_error("Embree cannot start on this processor");
    const RTCBVH tree = rtcNewBVH(device);
    RTCBuildArguments arguments = buildArguments();
    arguments.bvh = tree;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    const BuildNode* root = nullptr;
    // On one thread: how threads share the work decides the order of triangles, and with it how equal ones are split.
    if (!primitives.empty()) tbb::task_arena(1).execute([&] { root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments)); });
    const RTCError error = rtcGetDeviceError(device);
    Bvh bvh;
    if (error == RTC_ERROR_NONE) BvhWriter(scene, bvh).write(root);
    rtcReleaseBVH(tree);
    rtcReleaseDevice(device);
    if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build a tree of " + std::to_string(primitives.size()) + " triangles");
    return bvh;
}

}  // namespace clv
