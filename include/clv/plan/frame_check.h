// Says what is wrong with a frame's description, in words; the null back end of the tests.
#ifndef CLV_PLAN_FRAME_CHECK_H
#define CLV_PLAN_FRAME_CHECK_H
#include <algorithm>
#include <set>

#include "frame.h"

namespace clv {

// What a device takes. The defaults are what desktop devices have in common under Vulkan, Direct3D 12 and WebGPU.
struct FrameLimits {
    std::uint32_t groups = 65535;                        // of a pass, along an axis
    std::uint32_t storageBuffers = 16;                   // of a pass
    std::uint64_t uniformBytes = std::uint64_t(1) << 14;  // of a uniform buffer
    std::uint64_t storageBytes = std::uint64_t(1) << 27;  // of a storage buffer
    std::uint64_t texelElements = std::uint64_t(1) << 27;  // of a typed view
    std::uint32_t imageSide = 8192;                       // texels of a flat image or an array
    std::uint32_t imageLayers = 256;                      // of an array
    std::uint32_t volumeSide = 2048;                      // texels of a 3D image
    std::uint32_t colourTargets = 8;                      // of a pass
    std::uint64_t raySenders = std::uint64_t(1) << 30;    // invocations of a pass that sends rays
};

namespace detail {

class FrameCheck {
public:
    FrameCheck(const Frame& frame, const FrameLimits& limits) : frame_(frame), limits_(limits), filled_(frame.buffers.size()), used_(frame.buffers.size()), wanted_(frame.buffers.size()) {}

    std::vector<std::string> faults() {
        checkBuffers();
        std::set<std::string> steps;
        for (const FrameStep& step : frame_.steps) {
            if (!steps.insert(step.name).second) fault("step " + step.name + " is declared twice");
            for (std::uint32_t p = 0; p < step.passes.size(); ++p) {
                checkPass(step.passes[p]);
                checkBarriers(step, p);
                for (const FrameUse& use : step.passes[p].uses) {
                    if (isDeclared(use)) checkUse(step, p, use);
                }
            }
        }
        checkNothingIsIdle();
        return std::move(faults_);
    }

private:
    void fault(const std::string& words) { faults_.push_back(words); }
    bool isDeclared(const FrameUse& use) const { return use.buffer < frame_.buffers.size(); }

    void checkBuffers() {
        std::set<std::string> names;
        for (std::size_t i = 0; i < frame_.buffers.size(); ++i) {
            const FrameBuffer& buffer = frame_.buffers[i];
            if (!names.insert(buffer.name).second) fault("buffer " + buffer.name + " is declared twice");
            if (buffer.bytes == 0) fault("buffer " + buffer.name + " has no bytes");
            if (buffer.bytes % 4 != 0) fault("buffer " + buffer.name + " is no whole number of words of 4 bytes");
            if (buffer.isImage()) checkImage(buffer);
            if (buffer.isAcceleration() && (buffer.isImage() || buffer.readBack || (buffer.source != FrameSource::passes && buffer.source != FrameSource::shared))) {
                fault("acceleration structure " + buffer.name + " is not built by a pass, or is read as data");
            }
            filled_[i] = buffer.source != FrameSource::passes;
            wanted_[i] = buffer.readBack;
        }
    }

    void checkImage(const FrameBuffer& buffer) {
        const FrameImage& image = buffer.image;
        const std::uint32_t most = std::max(image.extent.x, image.extent.y);
        if (buffer.bytes != frameImageBytes(image)) fault("image " + buffer.name + " has not the bytes of its texels");
        if (buffer.source == FrameSource::host) fault("image " + buffer.name + " is the host's to fill");
        if (image.shape == FrameShape::flat && image.extent.z != 1) fault("image " + buffer.name + " is flat and has layers");
        const bool isVolume = image.shape == FrameShape::volume;
        if (std::max(most, isVolume ? image.extent.z : 0u) > (isVolume ? limits_.volumeSide : limits_.imageSide) || (!isVolume && image.extent.z > limits_.imageLayers)) {
            fault("image " + buffer.name + " is larger than a device takes");
        }
    }

    void checkPass(const FramePass& pass) {
        const std::uint32_t most = std::max({pass.groups.x, pass.groups.y, pass.groups.z});
        if (std::min({pass.groups.x, pass.groups.y, pass.groups.z}) == 0) fault("pass " + pass.name + " has no work groups");
        if (most > limits_.groups) fault("pass " + pass.name + " has " + std::to_string(most) + " work groups along an axis, more than " + std::to_string(limits_.groups));
        const bool clears = pass.uses.size() == 1 && pass.uses[0].access == FrameAccess::write && pass.uses[0].binding != FrameBinding::acceleration;
        if (pass.builds()) {
            checkBuild(pass);
        } else if (pass.shader.empty() && !clears) {
            fault("pass " + pass.name + " has no shader: it must write one buffer and read none");
        }
        std::set<std::uint32_t> ids, bindings;
        for (const FrameConstant& constant : pass.constants) {
            if (!ids.insert(constant.id).second) fault("pass " + pass.name + " sets constant " + std::to_string(constant.id) + " twice");
        }
        std::uint32_t storage = 0;
        for (const FrameUse& use : pass.uses) {
            if (use.binding == FrameBinding::storage) ++storage;
            if (!isDeclared(use)) {
                fault("pass " + pass.name + " uses a buffer that is not declared");
            } else if (!bindings.insert(frame_.buffers[use.buffer].binding).second) {
                fault("pass " + pass.name + " binds the number of " + frame_.buffers[use.buffer].name + " twice");
            }
        }
        if (storage > limits_.storageBuffers) fault("pass " + pass.name + " has " + std::to_string(storage) + " storage buffers, more than " + std::to_string(limits_.storageBuffers));
        checkDraws(pass);
        if (pass.sendsRays()) checkRays(pass);
    }

    // What a pass sends rays among, and what answers.
    void checkRays(const FramePass& pass) {
        if (pass.rays.miss.empty() || pass.rays.hit.empty()) fault("pass " + pass.name + " sends rays and names no shader for those that " + (pass.rays.miss.empty() ? "miss" : "hit"));
        if (pass.draws() || pass.shader.empty()) fault("pass " + pass.name + " sends rays and " + (pass.draws() ? "draws" : "has no shader that does"));
        const bool searches = std::ranges::any_of(pass.uses, [](const FrameUse& use) { return use.binding == FrameBinding::acceleration; });
        if (!searches) fault("pass " + pass.name + " sends rays and reads no acceleration structure");
        const uvec3 threads = frameThreads(pass);
        const std::uint64_t senders = std::uint64_t(threads.x) * threads.y * threads.z;
        if (senders > limits_.raySenders) fault("pass " + pass.name + " sends rays from " + std::to_string(senders) + " invocations, more than " + std::to_string(limits_.raySenders));
    }

    // From what, and for how many triangles.
    void checkBuild(const FramePass& pass) {
        const FrameUse &from = pass.uses[0], &to = pass.uses[1];
        const bool right = from.binding == FrameBinding::corners && from.access == FrameAccess::read && to.binding == FrameBinding::acceleration && to.access == FrameAccess::write;
        if (!right) fault("pass " + pass.name + " has no shader: it must read corners and write an acceleration structure");
        if (right && isDeclared(from) && isDeclared(to) && frame_.buffers[from.buffer].bytes < frame_.buffers[to.buffer].triangles * kFrameCornerBytes) {
            fault("pass " + pass.name + " has no corners for some of its triangles");
        }
    }

    // What a pass draws into, and how much.
    void checkDraws(const FramePass& pass) {
        std::uint32_t colours = 0, depths = 0, arguments = 0;
        const uvec3* extent = nullptr;
        for (const FrameUse& use : pass.uses) {
            if (use.binding == FrameBinding::arguments) ++arguments;
            if (use.binding != FrameBinding::target || !isDeclared(use)) continue;
            const FrameImage& image = frame_.buffers[use.buffer].image;
            const bool isDepth = image.format == FrameFormat::depth32Float;
            ++(isDepth ? depths : colours);
            if (isDepth && use.blend != FrameBlend::replace) fault("pass " + pass.name + " blends depths");
            // One layer of depths serves all draws, one after another.
            const bool fits = extent == nullptr || (image.extent.x == extent->x && image.extent.y == extent->y && ((isDepth && image.extent.z == 1) || image.extent.z == extent->z));
            if (!fits) fault("pass " + pass.name + " draws into images of different sizes");
            if (extent == nullptr) extent = &image.extent;
        }
        if (!pass.draws()) {
            if (colours + depths + arguments > 0) fault("pass " + pass.name + " has targets and does not draw");
            return;
        }
        if (colours == 0) fault("pass " + pass.name + " draws into no image of colours");
        if (colours > limits_.colourTargets) fault("pass " + pass.name + " draws into " + std::to_string(colours) + " images, more than " + std::to_string(limits_.colourTargets));
        if (depths > 1) fault("pass " + pass.name + " has two images of depths");
        if (arguments > 1 || (arguments == 1) == (pass.raster.vertices > 0)) fault("pass " + pass.name + " must say how much it draws, once");
    }

    void checkBarriers(const FrameStep& step, std::uint32_t p) {
        for (const FrameBarrier& barrier : step.passes[p].barriers) {
            if (barrier.buffer >= frame_.buffers.size() || barrier.after >= p) fault("pass " + step.passes[p].name + " has a barrier that is not after an earlier pass of its step, or for no buffer");
        }
    }

    void checkUse(const FrameStep& step, std::uint32_t p, const FrameUse& use) {
        const FramePass& pass = step.passes[p];
        const FrameBuffer& buffer = frame_.buffers[use.buffer];
        used_[use.buffer] = true;
        const bool isTarget = use.binding == FrameBinding::target;
        if (use.binding != FrameBinding::storage && !isTarget && !pass.shader.empty() && frameWrites(use.access)) fault("pass " + pass.name + " writes " + buffer.name + " through a read-only view");
        if (isTarget && !frameWrites(use.access)) fault("pass " + pass.name + " only reads its target " + buffer.name);
        const bool isAcceleration = use.binding == FrameBinding::acceleration;
        if (buffer.isAcceleration() != isAcceleration) fault("pass " + pass.name + " uses " + buffer.name + (isAcceleration ? " as an acceleration structure" : " as a buffer"));
        if (use.binding == FrameBinding::corners && !pass.builds()) fault("pass " + pass.name + " binds corners to a shader");
        if (buffer.isImage() != (isTarget || use.binding == FrameBinding::image)) fault("pass " + pass.name + " uses " + buffer.name + (buffer.isImage() ? " as a buffer" : " as an image"));
        if (use.binding == FrameBinding::arguments && buffer.bytes < frameLayers(frame_, pass) * sizeof(FrameDrawArguments)) fault("pass " + pass.name + " has no arguments for some of its draws");
        if ((use.binding == FrameBinding::texel) != (use.format != FrameFormat::none)) fault("pass " + pass.name + " uses " + buffer.name + " with a format where it has none, or without");
        checkSize(pass, buffer, use);
        if (frameReads(use.access)) {
            if (!filled_[use.buffer]) fault("pass " + pass.name + " reads " + buffer.name + ", which nothing has written");
            wanted_[use.buffer] = true;
        }
        if (frameWrites(use.access)) filled_[use.buffer] = true;
        if (buffer.image.format == FrameFormat::depth32Float) wanted_[use.buffer] = true;  // by the test of depths itself
        for (std::uint32_t q : framePrerequisites(step, p, use.buffer, use.access)) {
            const bool ordered = std::any_of(pass.barriers.begin(), pass.barriers.end(), [&](const FrameBarrier& b) { return b.buffer == use.buffer && b.after == q; });
            if (!ordered) fault("pass " + pass.name + " has no barrier for " + buffer.name + " after " + step.passes[q].name);
        }
    }

    void checkSize(const FramePass& pass, const FrameBuffer& buffer, const FrameUse& use) {
        std::uint64_t size = buffer.bytes, most = limits_.storageBytes;
        const char* unit = " bytes";
        if (buffer.isImage() || buffer.isAcceleration()) return;  // see checkImage; structures know other limits
        if (use.binding == FrameBinding::uniform) most = limits_.uniformBytes;
        if (use.format != FrameFormat::none) {
            size = buffer.bytes / frameFormatBytes(use.format), most = limits_.texelElements, unit = " elements";
            if (buffer.bytes % frameFormatBytes(use.format) != 0) fault("pass " + pass.name + " reads " + buffer.name + " in a format that its bytes are no multiple of");
        }
        if (size > most) fault("pass " + pass.name + " uses " + buffer.name + " of " + std::to_string(size) + unit + ", more than " + std::to_string(most));
    }

    void checkNothingIsIdle() {
        for (std::size_t i = 0; i < frame_.buffers.size(); ++i) {
            const std::string& name = frame_.buffers[i].name;
            if (!used_[i]) {
                fault("buffer " + name + " is declared and unused");
            } else if (!wanted_[i]) {
                fault("buffer " + name + " is written and never read");
            }
        }
    }

    const Frame& frame_;
    const FrameLimits& limits_;
    std::vector<bool> filled_, used_, wanted_;  // of each buffer: has data; a pass has it; somebody reads it
    std::vector<std::string> faults_;
};

}  // namespace detail

// One line a fault; empty: the steps may run in their order on a device with these limits. Every read has a write before it, every
// buffer is used, names and the bindings of a pass are unique, no two passes that touch the same data lack a barrier between them.
inline std::vector<std::string> checkFrame(const Frame& frame, const FrameLimits& limits = {}) { return detail::FrameCheck(frame, limits).faults(); }

}  // namespace clv
#endif
