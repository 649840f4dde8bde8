// A frame of GPU work as plain data: buffers and images, passes, what each pass reads and writes, and the barriers between them.
//
// The library never calls a graphics API. An engine executes a Frame with its own Vulkan, Direct3D or WebGPU layer: create the
// buffers, fill those that the host owns, and for each step dispatch or draw its passes in order, with their barriers before them.
#ifndef CLV_PLAN_FRAME_H
#define CLV_PLAN_FRAME_H
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "../data/gpu_bindings.h"
#include "../lang.h"

namespace clv {

// Of an element, where a buffer is read through a typed view; of an image's texels.
enum class FrameFormat { none, rgba32Float, rgba32Uint, r32Float, rgba16Float, r32Uint, depth32Float };
enum class FrameSource {
    host,    // written by the host before the first frame, and whenever it likes between frames
    zero,    // zero before the first frame, then written by passes
    passes,  // a pass writes it before any reads it
    shared,  // another frame's buffer of that name, which that frame has written
};

enum class FrameShape { flat, array, volume };  // one layer; a stack of them; a 3D image, whose slices are drawn into as layers are

struct FrameImage {
    FrameFormat format = FrameFormat::none;
    FrameShape shape = FrameShape::flat;
    uvec3 extent{0};            // texels along x and y, layers
};

// A buffer, or an image where that has a format, or an acceleration structure where it has triangles.
struct FrameBuffer {
    std::string name;           // unique in the frame
    std::uint32_t binding = 0;  // CLV_BIND_...
    std::uint64_t bytes = 0;    // > 0; of an acceleration structure with all that building it takes, as the graphics API says
    FrameSource source = FrameSource::passes;  // images are never the host's
    bool readBack = false;      // the host reads it between frames
    FrameImage image{};
    std::uint64_t triangles = 0;  // of an acceleration structure, which a pass builds

    bool isImage() const { return image.format != FrameFormat::none; }
    bool isAcceleration() const { return triangles > 0; }
};

enum class FrameAccess { read, write, readWrite };
enum class FrameBinding {
    uniform,
    storage,
    texel,      // a read-only typed view of a buffer
    image,      // read texel by texel, without a filter
    target,     // drawn into: colours in the order of the fragment shader's outputs, and at most one image of depths
    arguments,  // how much each draw draws: see FrameRaster
    acceleration,  // an acceleration structure: read by ray tracing, written by the pass that builds it
    corners,       // what an acceleration structure is built from: kFrameCornerBytes a triangle
};

// What becomes of the colour that a target holds.
enum class FrameBlend {
    replace,
    add,
    addKeepLargestAlpha,  // red, green and blue are added, alpha is the larger
};

struct FrameUse {
    std::uint32_t buffer = 0;  // index into Frame::buffers
    FrameBinding binding = FrameBinding::storage;
    FrameAccess access = FrameAccess::read;  // a target that is written begins with zeroes; one that is changed, with what it holds
    FrameFormat format = FrameFormat::none;  // of a texel view
    FrameBlend blend = FrameBlend::replace;  // of a colour target
};

// Before the pass runs, what `after` wrote or read in the buffer must be over, and visible.
struct FrameBarrier {
    std::uint32_t buffer = 0;
    std::uint32_t after = 0;   // index of a pass of the same step
};

struct FrameConstant {
    std::uint32_t id = 0;      // CLV_SPEC_...
    std::uint32_t value = 0;
};

enum class FrameTopology { none, triangles, lines };

// How a pass draws. There is a draw for each layer of its targets; a draw tells its shaders the layer's number in a root constant (a
// push constant in Vulkan). No vertex comes from a buffer of vertices: shaders fetch by the vertex' number. Nothing is culled.
// Positions are in Direct3D's clip space, y up, depth from 0 to 1; the largest depth wins, and depths begin with 0, the farthest.
// Lines are one texel wide and follow the diamond-exit rule where the API knows it; see shaders that draw any.
struct FrameRaster {
    FrameTopology topology = FrameTopology::none;  // none: the pass does not draw
    std::uint32_t vertices = 0;                    // of each draw; 0: by the record of the layer in the buffer of arguments
};

// How a pass sends rays by a ray-tracing pipeline: an invocation of its ray generation shader for each thread of its work groups, side by
// side in x and y. There is one miss and one closest-hit shader, number 0 of each, and rays send no further rays.
struct FrameRayShaders {
    std::string miss, hit;  // names of their files without the ending; empty: the pass sends none
};

// Three corners of three floats, m.
inline constexpr std::uint64_t kFrameCornerBytes = 36;

// A record in a buffer of arguments, as Vulkan, Direct3D and WebGPU have it.
struct FrameDrawArguments {
    std::uint32_t vertices = 0, instances = 1, firstVertex = 0, firstInstance = 0;
};

struct FramePass {
    std::string name;                      // for people and timings
    std::string shader;                    // name of a file in shaders/glsl and shaders/hlsl, without its ending; empty: clear or build
    std::vector<FrameConstant> constants;
    std::vector<FrameUse> uses;            // a pass without a shader sets its one buffer to 0, or builds an acceleration structure
    uvec3 groups{1, 1, 1};                 // work groups
    std::vector<FrameBarrier> barriers;    // see addBarriers
    FrameRaster raster{};                  // draws use the vertex and the fragment shader of the name
    FrameRayShaders rays{};                // the ray generation shader of the name sends them

    bool draws() const { return raster.topology != FrameTopology::none; }
    bool sendsRays() const { return !rays.miss.empty() || !rays.hit.empty(); }
    // An acceleration structure: one level of opaque triangles, in the order of their corners, and one instance of it, as it is.
    bool builds() const { return shader.empty() && uses.size() == 2; }
};

// Passes that run one after another. A step begins when everything before it is over.
struct FrameStep {
    std::string name;
    std::vector<FramePass> passes;
};

struct Frame {
    std::vector<FrameBuffer> buffers;  // and images
    std::vector<FrameStep> steps;

    // Memory that the frame's own buffers and images take together, before any of it is taken.
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const FrameBuffer& buffer : buffers) sum += buffer.source == FrameSource::shared ? 0 : buffer.bytes;
        return sum;
    }
    // Index of the buffer of that name; buffers.size() if there is none.
    std::uint32_t bufferIndex(std::string_view name) const {
        std::uint32_t i = 0;
        while (i < buffers.size() && buffers[i].name != name) ++i;
        return i;
    }
};

// Bytes of an element of a typed view, or of a texel; `format` is not `none`.
inline std::uint32_t frameFormatBytes(FrameFormat format) {
    if (format == FrameFormat::rgba32Float || format == FrameFormat::rgba32Uint) return 16u;
    return format == FrameFormat::rgba16Float ? 8u : 4u;
}

inline std::uint64_t frameImageBytes(const FrameImage& image) {
    return std::uint64_t(image.extent.x) * image.extent.y * image.extent.z * frameFormatBytes(image.format);
}

// An image that passes write before they read it.
inline FrameBuffer frameImage(const std::string& name, std::uint32_t binding, const FrameImage& image) {
    return {name, binding, frameImageBytes(image), FrameSource::passes, false, image};
}

inline bool frameReads(FrameAccess access) { return access != FrameAccess::write; }
inline bool frameWrites(FrameAccess access) { return access != FrameAccess::read; }

// Names of the pass's shaders: the vertex and the fragment shader of one that draws; ray generation, miss and closest hit of one that
// sends rays; none of one that clears or builds.
inline std::vector<std::string> frameShaders(const FramePass& pass) {
    if (pass.draws()) return {pass.shader + ".vert", pass.shader + ".frag"};
    if (pass.sendsRays()) return {pass.shader + ".rgen", pass.rays.miss + ".rmiss", pass.rays.hit + ".rchit"};
    return pass.shader.empty() ? std::vector<std::string>() : std::vector{pass.shader};
}

// Whether the use is bound to its number in the pass's shaders; targets and arguments are not.
inline bool frameBinds(const FrameUse& use) { return use.binding != FrameBinding::target && use.binding != FrameBinding::arguments; }

// Layers that a pass draws, one after another; 0 for a pass that does not draw.
inline std::uint32_t frameLayers(const Frame& frame, const FramePass& pass) {
    std::uint32_t layers = 0;
    for (const FrameUse& use : pass.uses) {
        if (use.binding == FrameBinding::target && use.buffer < frame.buffers.size()) layers = std::max(layers, frame.buffers[use.buffer].image.extent.z);
    }
    return layers;
}

// Threads of all the pass's work groups, along each axis.
inline uvec3 frameThreads(const FramePass& pass) { return pass.groups * uvec3(CLV_GROUP_SIZE, 1, 1); }

// Work groups that cover `items` with CLV_GROUP_SIZE threads each, in rows; see clvItem.
inline uvec3 groupsFor(std::uint64_t items) {
    const std::uint64_t groups = (items + CLV_GROUP_SIZE - 1) / CLV_GROUP_SIZE, row = CLV_GROUP_ROW;
    return uvec3(uint(std::min(groups, row)), uint((groups + row - 1) / row), 1);
}

// The passes of a step before pass `p` that must be over before it touches `buffer` with `access`: the last one that wrote it, and
// those that have read it since, if the pass writes. What came earlier is ordered by the barriers of these.
inline std::vector<std::uint32_t> framePrerequisites(const FrameStep& step, std::uint32_t p, std::uint32_t buffer, FrameAccess access) {
    std::vector<std::uint32_t> passes;
    for (std::uint32_t q = p; q-- > 0;) {
        bool reads = false, writes = false;
        for (const FrameUse& earlier : step.passes[q].uses) {
            if (earlier.buffer != buffer) continue;
            reads = reads || frameReads(earlier.access);
            writes = writes || frameWrites(earlier.access);
        }
        if (writes || (reads && frameWrites(access))) passes.push_back(q);
        if (writes) break;
    }
    return passes;
}

// Fills in the barriers of every pass.
inline void addBarriers(Frame& frame) {
    for (FrameStep& step : frame.steps) {
        for (std::uint32_t p = 0; p < step.passes.size(); ++p) {
            FramePass& pass = step.passes[p];
            pass.barriers.clear();
            for (const FrameUse& use : pass.uses) {
                for (std::uint32_t q : framePrerequisites(step, p, use.buffer, use.access)) pass.barriers.push_back({use.buffer, q});
            }
        }
    }
}

}  // namespace clv
#endif
