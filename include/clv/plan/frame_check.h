// Says what is wrong with a frame's description, in words; the null back end of the tests.
#ifndef CLV_PLAN_FRAME_CHECK_H
#define CLV_PLAN_FRAME_CHECK_H
#include <algorithm>
#include <set>

#include "frame.h"

namespace clv {

// One line a fault; empty: the steps may run in their order. Every read has a write before it, every buffer is used, names and the
// bindings of a pass are unique, no two passes that touch the same data lack a barrier between them.
inline std::vector<std::string> checkFrame(const Frame& frame) {
    std::vector<std::string> faults;
    auto fault = [&](const std::string& words) { faults.push_back(words); };
    std::set<std::string> names;
    std::vector<bool> filled(frame.buffers.size()), used(frame.buffers.size());
    for (std::size_t i = 0; i < frame.buffers.size(); ++i) {
        const FrameBuffer& buffer = frame.buffers[i];
        if (!names.insert(buffer.name).second) fault("buffer " + buffer.name + " is declared twice");
        if (buffer.bytes == 0) fault("buffer " + buffer.name + " has no bytes");
        filled[i] = buffer.source != FrameSource::passes;
    }
    for (const FrameStep& step : frame.steps) {
        for (std::uint32_t p = 0; p < step.passes.size(); ++p) {
            const FramePass& pass = step.passes[p];
            std::set<std::uint32_t> bindings;
            if (pass.groups.x == 0 || pass.groups.y == 0 || pass.groups.z == 0) fault("pass " + pass.name + " has no work groups");
            if (std::max({pass.groups.x, pass.groups.y, pass.groups.z}) > 65535u) fault("pass " + pass.name + " has more than 65535 work groups along an axis");
            if (pass.shader.empty() && (pass.uses.size() != 1 || pass.uses[0].access != FrameAccess::write)) {
                fault("pass " + pass.name + " has no shader: it must write one buffer and read none");
            }
            for (const FrameUse& use : pass.uses) {
                if (use.buffer >= frame.buffers.size()) {
                    fault("pass " + pass.name + " uses a buffer that is not declared");
                    continue;
                }
                const std::string& buffer = frame.buffers[use.buffer].name;
                used[use.buffer] = true;
                if (!bindings.insert(frame.buffers[use.buffer].binding).second) fault("pass " + pass.name + " binds " + buffer + "'s number twice");
                if (use.binding != FrameBinding::storage && frameWrites(use.access)) fault("pass " + pass.name + " writes " + buffer + " through a read-only view");
                if ((use.binding == FrameBinding::texel) != (use.format != FrameFormat::none)) fault("pass " + pass.name + " reads " + buffer + " with a format where it has none, or without");
                if (frameReads(use.access) && !filled[use.buffer]) fault("pass " + pass.name + " reads " + buffer + ", which nothing has written");
                if (frameWrites(use.access)) filled[use.buffer] = true;
                for (std::uint32_t q : framePrerequisites(step, p, use.buffer, use.access)) {
                    const bool ordered = std::any_of(pass.barriers.begin(), pass.barriers.end(),
                                                     [&](const FrameBarrier& b) { return b.buffer == use.buffer && b.after == q; });
                    if (!ordered) fault("pass " + pass.name + " has no barrier for " + buffer + " after " + step.passes[q].name);
                }
            }
        }
    }
    for (std::size_t i = 0; i < frame.buffers.size(); ++i) {
        if (!used[i]) fault("buffer " + frame.buffers[i].name + " is declared and unused");
    }
    return faults;
}

}  // namespace clv
#endif
