// A frame of GPU work as plain data: buffers, passes, what each pass reads and writes, and the barriers between them.
//
// The library never calls a graphics API. An engine executes a Frame with its own Vulkan, Direct3D or WebGPU layer: create the
// buffers, fill those that the host owns, and for each step dispatch its passes in order, with their barriers before them.
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

enum class FrameFormat { none, rgba32Float, rgba32Uint, r32Float };  // of an element, where a buffer is read through a typed view
enum class FrameSource {
    host,    // written by the host before the first frame, and whenever it likes between frames
    zero,    // zero before the first frame, then written by passes
    passes,  // a pass writes it before any reads it
};

struct FrameBuffer {
    std::string name;           // unique in the frame
    std::uint32_t binding = 0;  // CLV_BIND_...
    std::uint64_t bytes = 0;    // > 0
    FrameSource source = FrameSource::passes;
    bool readBack = false;      // the host reads it between frames
};

enum class FrameAccess { read, write, readWrite };
enum class FrameBinding { uniform, storage, texel };  // `texel`: a read-only typed view

struct FrameUse {
    std::uint32_t buffer = 0;  // index into Frame::buffers
    FrameBinding binding = FrameBinding::storage;
    FrameAccess access = FrameAccess::read;
    FrameFormat format = FrameFormat::none;  // of a texel view
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

struct FramePass {
    std::string name;                      // for people and timings
    std::string shader;                    // name of a file in shaders/glsl and shaders/hlsl, without its ending; empty: clear
    std::vector<FrameConstant> constants;
    std::vector<FrameUse> uses;            // a pass without a shader sets its one buffer to 0
    uvec3 groups{1, 1, 1};                 // work groups
    std::vector<FrameBarrier> barriers;    // see addBarriers
};

// Passes that run one after another. A step begins when everything before it is over.
struct FrameStep {
    std::string name;
    std::vector<FramePass> passes;
};

struct Frame {
    std::vector<FrameBuffer> buffers;
    std::vector<FrameStep> steps;

    // Memory that the buffers take together, before any of it is taken.
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const FrameBuffer& buffer : buffers) sum += buffer.bytes;
        return sum;
    }
    // Index of the buffer of that name; buffers.size() if there is none.
    std::uint32_t bufferIndex(std::string_view name) const {
        std::uint32_t i = 0;
        while (i < buffers.size() && buffers[i].name != name) ++i;
        return i;
    }
};

// Bytes of an element of a typed view; `format` is not `none`.
inline std::uint32_t frameFormatBytes(FrameFormat format) { return format == FrameFormat::r32Float ? 4u : 16u; }

inline bool frameReads(FrameAccess access) { return access != FrameAccess::write; }
inline bool frameWrites(FrameAccess access) { return access != FrameAccess::read; }

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
