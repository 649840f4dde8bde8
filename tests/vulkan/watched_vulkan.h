// A Vulkan loader for tests: passes calls on to the system's, counts them, and fails or hides what a test asks it to.
#ifndef CLV_TESTS_VULKAN_WATCHED_VULKAN_H
#define CLV_TESTS_VULKAN_WATCHED_VULKAN_H
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace clv::test {

struct WatchedVulkan {
    std::map<std::string, int> calls;     // of the functions that take memory, make objects or submit work
    std::uint64_t bytesTaken = 0;         // of memory, all allocations together

    std::string failing;                  // name of a function that fails
    int failure = 0;                      // with this VkResult
    int failAfter = 0;                    // calls of it that succeed first
    int devices = 1;                      // the first device, this often
    bool discrete = false;                // they are cards of their own
    bool oldDevices = false;              // they have Vulkan 1.0 alone
    bool coreFeaturesOnly = false;        // they have neither extensions nor subgroups that shuffle
    bool separateMemory = false;          // the host does not reach the device's memory
    std::uint64_t heapBytes = 0;          // of every heap; 0: as it is
};

// File name of the loader, for VulkanOptions::loader.
inline std::string watchedLoader() { return CLV_WATCHED_VULKAN; }

// What it watches, as new.
inline WatchedVulkan& watchVulkan() {
    static void* library = dlopen(CLV_WATCHED_VULKAN, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    WatchedVulkan& watched = *reinterpret_cast<WatchedVulkan* (*)()>(dlsym(library, "clvWatchedVulkan"))();
    watched = WatchedVulkan();
    return watched;
}

// Calls so far that take memory or make objects.
inline int creations(const WatchedVulkan& watched) {
    int sum = 0;
    for (const auto& [name, count] : watched.calls) {
        if (name.starts_with("vkCreate") || name.starts_with("vkAllocate")) sum += count;
    }
    return sum;
}

}  // namespace clv::test
#endif
