#include "bindings/vulkan/shader_interface.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace clv {
namespace {

// Numbers of the SPIR-V specification, version 1.3, sections 3.7 to 3.32.
constexpr std::uint32_t kMagic = 0x07230203, kHeaderWords = 5;
enum Op : std::uint32_t { kOpCapability = 17, kOpTypeInt = 21, kOpTypeImage = 25, kOpTypeSampledImage = 27, kOpTypeStruct = 30, kOpTypePointer = 32, kOpVariable = 59, kOpDecorate = 71, kOpMemberDecorate = 72, kOpTypeAccelerationStructureKhr = 5341 };
enum Decoration : std::uint32_t { kSpecId = 1, kBufferBlock = 3, kNonWritable = 24, kBinding = 33, kDescriptorSet = 34 };
enum StorageClass : std::uint32_t { kUniformConstant = 0, kUniform = 2, kStorageBuffer = 12 };
enum Capability : std::uint32_t { kGroupNonUniformShuffle = 65, kRayQueryKhr = 4472, kRayTracingKhr = 4479, kAtomicFloat32AddExt = 6033 };
constexpr std::uint32_t kDim2D = 1, kDim3D = 2, kDimBuffer = 5, kStorageImage = 2;

using Words = std::span<const std::uint32_t>;

// What the instructions say of each id.
struct Module {
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> decorations;  // id -> decoration -> its operand, or 0
    std::map<std::uint32_t, std::set<std::uint32_t>> readOnlyMembers;             // of a struct
    std::map<std::uint32_t, Words> types, variables;                              // id -> its instruction
    std::set<std::uint32_t> capabilities;

    explicit Module(Words words) {
        if (words.size() < kHeaderWords || words[0] != kMagic) throw std::runtime_error("a shader is no SPIR-V");
        for (std::size_t at = kHeaderWords; at < words.size();) {
            const std::uint32_t length = words[at] >> 16;
            if (length == 0 || length > words.size() - at) throw std::runtime_error("a shader's SPIR-V is cut short");
            read(words.subspan(at, length));
            at += length;
        }
    }

    void read(Words instruction) {
        switch (instruction[0] & 0xffffu) {
            case kOpCapability: capabilities.insert(instruction[1]); break;
            case kOpDecorate: decorations[instruction[1]][instruction[2]] = instruction.size() > 3 ? instruction[3] : 0; break;
            case kOpMemberDecorate:
                if (instruction[3] == kNonWritable) readOnlyMembers[instruction[1]].insert(instruction[2]);
                break;
            case kOpTypeInt:
            case kOpTypeImage:
            case kOpTypeSampledImage:
            case kOpTypeStruct:
            case kOpTypeAccelerationStructureKhr:
            case kOpTypePointer: types[instruction[1]] = instruction; break;
            case kOpVariable: variables[instruction[2]] = instruction; break;
        }
    }
    std::uint32_t opOf(std::uint32_t type) const {
        const auto found = types.find(type);
        return found == types.end() ? 0 : found->second[0] & 0xffffu;
    }
    bool isDecorated(std::uint32_t id, std::uint32_t decoration) const {
        const auto found = decorations.find(id);
        return found != decorations.end() && found->second.contains(decoration);
    }

    // Of a variable that is bound to a number.
    ShaderBinding binding(std::uint32_t id, Words variable) const {
        ShaderBinding binding{.number = decorations.at(id).at(kBinding)};
        const std::uint32_t pointee = types.at(variable[1])[3];
        if (opOf(pointee) == kOpTypeAccelerationStructureKhr) {
            binding.kind = FrameBinding::acceleration;
            return binding;
        }
        if (variable[3] == kUniformConstant) {
            const std::uint32_t image = opOf(pointee) == kOpTypeSampledImage ? types.at(pointee)[2] : pointee;
            const std::uint32_t dimension = opOf(image) == kOpTypeImage ? types.at(image)[3] : kDimBuffer + 1;
            const bool known = dimension == kDim2D || dimension == kDim3D || dimension == kDimBuffer;
            if (!known || types.at(image)[7] == kStorageImage) {
                throw std::runtime_error("a shader binds something other than a buffer or an image that it reads to number " + std::to_string(binding.number));
            }
            binding.kind = dimension == kDimBuffer ? FrameBinding::texel : FrameBinding::image;
            binding.shape = dimension == kDim3D ? FrameShape::volume : types.at(image)[5] != 0 ? FrameShape::array : FrameShape::flat;
            binding.integers = opOf(types.at(image)[2]) == kOpTypeInt;
            return binding;
        }
        const bool storage = variable[3] == kStorageBuffer || isDecorated(pointee, kBufferBlock);
        binding.kind = storage ? FrameBinding::storage : FrameBinding::uniform;
        const auto readOnly = readOnlyMembers.find(pointee);
        const std::size_t members = types.at(pointee).size() - 2;
        binding.writable = storage && !isDecorated(id, kNonWritable) && (readOnly == readOnlyMembers.end() || readOnly->second.size() < members);
        return binding;
    }
};

std::string kindName(FrameBinding kind) {
    switch (kind) {
        case FrameBinding::uniform: return "a uniform buffer";
        case FrameBinding::texel: return "a typed view";
        case FrameBinding::image: return "an image";
        case FrameBinding::acceleration: return "an acceleration structure";
        default: return "a storage buffer";
    }
}

bool holdsIntegers(FrameFormat format) { return format == FrameFormat::rgba32Uint || format == FrameFormat::r32Uint; }

// What the pass needs of the device beside its shader.
std::vector<std::string> missingFeatures(const Frame& frame, const FramePass& pass, const VulkanFeatures& features) {
    std::vector<std::string> lines;
    if (pass.draws() && !features.draws) lines.push_back("pass " + pass.name + " draws, and the device's queue does not");
    for (const FrameUse& use : pass.uses) {
        const FrameBuffer& buffer = frame.buffers[use.buffer];
        const bool adds = use.binding == FrameBinding::target && use.blend != FrameBlend::replace;
        if (adds && buffer.image.format == FrameFormat::rgba32Float && !features.blendsFloats) lines.push_back("pass " + pass.name + " adds up floats of 32 bits in " + buffer.name + ", which the device does not");
    }
    return lines;
}

}  // namespace

ShaderInterface shaderInterface(std::span<const std::uint32_t> words) {
    const Module module(words);
    ShaderInterface shader;
    for (const auto& [id, variable] : module.variables) {
        if (module.isDecorated(id, kBinding)) shader.bindings.push_back(module.binding(id, variable));
    }
    for (const auto& [id, decorations] : module.decorations) {
        if (decorations.contains(kSpecId)) shader.constants.push_back(decorations.at(kSpecId));
    }
    shader.floatAtomics = module.capabilities.contains(kAtomicFloat32AddExt);
    shader.rayQueries = module.capabilities.contains(kRayQueryKhr);
    shader.rayPipelines = module.capabilities.contains(kRayTracingKhr);
    shader.shuffles = module.capabilities.contains(kGroupNonUniformShuffle);
    return shader;
}

ShaderInterface together(const ShaderInterface& a, const ShaderInterface& b) {
    ShaderInterface sum = a;
    for (const ShaderBinding& binding : b.bindings) {
        const auto same = std::find_if(sum.bindings.begin(), sum.bindings.end(), [&](const ShaderBinding& known) { return known.number == binding.number; });
        if (same == sum.bindings.end()) {
            sum.bindings.push_back(binding);
        } else {
            same->writable = same->writable || binding.writable;
        }
    }
    for (const std::uint32_t id : b.constants) {
        if (std::find(sum.constants.begin(), sum.constants.end(), id) == sum.constants.end()) sum.constants.push_back(id);
    }
    sum.floatAtomics = a.floatAtomics || b.floatAtomics;
    sum.shuffles = a.shuffles || b.shuffles;
    sum.rayQueries = a.rayQueries || b.rayQueries;
    sum.rayPipelines = a.rayPipelines || b.rayPipelines;
    return sum;
}

std::vector<std::string> shaderMismatches(const Frame& frame, const FramePass& pass, const ShaderInterface& shader, const VulkanFeatures& features) {
    std::vector<std::string> lines = missingFeatures(frame, pass, features);
    const auto line = [&](const std::string& words) { lines.push_back("pass " + pass.name + ": the shader " + pass.shader + " " + words); };
    for (const FrameUse& use : pass.uses) {
        if (!frameBinds(use)) continue;
        const FrameBuffer& buffer = frame.buffers[use.buffer];
        const auto bound = std::find_if(shader.bindings.begin(), shader.bindings.end(), [&](const ShaderBinding& b) { return b.number == buffer.binding; });
        const std::string what = buffer.name + " (binding " + std::to_string(buffer.binding) + ")";
        if (bound == shader.bindings.end()) {
            line("does not bind " + what);
        } else if (bound->kind != use.binding) {
            line("binds " + what + " as " + kindName(bound->kind) + ", not as " + kindName(use.binding));
        } else if (use.binding == FrameBinding::image && bound->shape != buffer.image.shape) {
            line("reads " + what + " as an image of another shape");
        } else if ((use.binding == FrameBinding::texel || use.binding == FrameBinding::image) && bound->integers != holdsIntegers(buffer.isImage() ? buffer.image.format : use.format)) {
            line("reads " + what + " as " + (bound->integers ? "integers, not floats" : "floats, not integers"));
        } else if (bound->writable && !frameWrites(use.access)) {
            line("may write " + what + ", which the pass only reads");
        } else if (!bound->writable && frameWrites(use.access)) {
            line("cannot write " + what + ", which the pass writes");
        }
    }
    for (const ShaderBinding& bound : shader.bindings) {
        const bool given = std::any_of(pass.uses.begin(), pass.uses.end(), [&](const FrameUse& use) { return frameBinds(use) && frame.buffers[use.buffer].binding == bound.number; });
        if (!given) line("binds number " + std::to_string(bound.number) + ", for which the pass has no buffer");
    }
    for (const FrameConstant& constant : pass.constants) {
        if (std::find(shader.constants.begin(), shader.constants.end(), constant.id) == shader.constants.end()) line("has no constant " + std::to_string(constant.id));
    }
    if (shader.floatAtomics && !features.floatAtomics) line("needs atomic additions of floats, which are not switched on");
    if (shader.rayQueries && !features.rayQueries) line("needs ray queries, which are not switched on");
    if (shader.rayPipelines && !features.rayPipelines) line("needs ray-tracing pipelines, which are not switched on");
    if (shader.shuffles && features.subgroupSize == 0) line("needs subgroups that can shuffle");
    return lines;
}

}  // namespace clv
