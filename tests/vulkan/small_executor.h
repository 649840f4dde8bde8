// Runs a Frame with Vulkan's C functions alone, as an engine would; shares no code with bindings/vulkan.
#ifndef CLV_TESTS_VULKAN_SMALL_EXECUTOR_H
#define CLV_TESTS_VULKAN_SMALL_EXECUTOR_H
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "clv/plan/frame.h"

namespace clv::test {

// Throws std::runtime_error where Vulkan has refused.
void check(VkResult result);
VkFormat formatOf(FrameFormat format);

// On the first device. All buffers lie in memory that the host reaches, images where the device likes them. Frames build no acceleration
// structures here. Whatever Vulkan refuses ends in std::runtime_error.
class SmallExecutor {
public:
    explicit SmallExecutor(const Frame& frame, bool floatAtomics = false);
    ~SmallExecutor();
    SmallExecutor(const SmallExecutor&) = delete;
    SmallExecutor& operator=(const SmallExecutor&) = delete;

    template <class T>
    void upload(const std::string& buffer, std::span<const T> items) { uploadBytes(buffer, std::as_bytes(items)); }
    template <class T>
    void upload(const std::string& buffer, const T& item) { uploadBytes(buffer, std::as_bytes(std::span(&item, 1))); }
    template <class T>
    void download(const std::string& buffer, std::span<T> items) const { downloadBytes(buffer, std::as_writable_bytes(items)); }
    void run(const std::string& step);

private:
    struct Buffer {
        VkBuffer handle = VK_NULL_HANDLE;  // one of these is null
        VkImage image = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::byte* mapped = nullptr;       // of a buffer
    };
    struct Pass {
        VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        VkPipeline pipeline = VK_NULL_HANDLE;
        VkDescriptorPool pool = VK_NULL_HANDLE;
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::vector<VkBufferView> views;
        std::vector<VkImageView> imageViews;
        VkRenderPass renderPass = VK_NULL_HANDLE;     // of one that draws
        std::vector<VkFramebuffer> framebuffers;      // a layer each
    };

    void uploadBytes(const std::string& buffer, std::span<const std::byte> bytes);
    void downloadBytes(const std::string& buffer, std::span<std::byte> bytes) const;
    void openDevice(bool floatAtomics);
    Buffer makeBuffer(const FrameBuffer& description) const;
    Buffer makeImage(const FrameBuffer& description) const;
    VkDeviceMemory takeMemory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) const;
    Pass makePass(const FramePass& description) const;
    VkPipelineShaderStageCreateInfo makeStage(const std::string& shader, const VkSpecializationInfo& constants, VkShaderStageFlagBits stage) const;
    VkImageView makeView(std::uint32_t buffer, VkImageViewType type, std::uint32_t firstLayer, std::uint32_t layers) const;
    void makeRenderPass(const FramePass& description, Pass& pass) const;
    void makeDrawPipeline(const FramePass& description, const VkSpecializationInfo& constants, Pass& pass) const;
    void recordDraws(const FramePass& description, const Pass& pass) const;
    std::vector<FrameUse> targetsOf(const FramePass& description) const;
    bool isDepth(const FrameUse& use) const { return frame_.buffers[use.buffer].image.format == FrameFormat::depth32Float; }
    void begin() const;
    void submit() const;
    void wait() const;
    void bind(Pass& pass, const FrameUse& use) const;
    void record(const FramePass& description, const Pass& pass) const;
    void layOutImages() const;

    Frame frame_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    bool diamondLines_ = false;  // lines by the diamond-exit rule
    std::vector<Buffer> buffers_;
    std::vector<std::vector<Pass>> steps_;
};

}  // namespace clv::test
#endif
