// clv info: the Vulkan devices of the machine, and the path that a frame takes on each.
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/run_command.h"

namespace {

using namespace clv;
using Json = nlohmann::json;

TEST(Info, listsTheVulkanDevicesAndTheirPaths) {
    const CommandResult result = runCommand({"info", "--json"});
    ASSERT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    const Json report = Json::parse(result.out);
    EXPECT_FALSE(report.contains("vulkan_missing"));
    EXPECT_EQ(report.at("backends"), Json({"cpu", "vulkan"}));
    ASSERT_FALSE(report.at("vulkan_devices").empty()) << "these tests need a Vulkan device, mesa-vulkan-drivers for one";
    const std::set<std::string> types{"discrete", "integrated", "virtual", "cpu", "other"}, ways{"bricks", "bricks without subgroups", "float atomics", "fixed point"},
        traces{"bvh in compute", "ray queries in compute", "ray-tracing pipelines"};
    std::size_t index = 0;
    for (const Json& device : report["vulkan_devices"]) {
        EXPECT_EQ(device.at("index"), index++);
        EXPECT_NE(device.at("name"), "");
        EXPECT_NE(device.at("driver"), "");
        EXPECT_TRUE(types.contains(device.at("type")));
        EXPECT_TRUE(device.at("vulkan").get<std::string>().starts_with("1."));
        EXPECT_GT(device.at("memory_mib"), 0);
        EXPECT_GE(device.at("subgroup_size"), 0);
        EXPECT_TRUE(ways.contains(device.at("inject")));
        EXPECT_TRUE(traces.contains(device.at("trace")));
    }
}

TEST(Info, namesTheDevicesToPeople) {
    const std::string name = Json::parse(runCommand({"info", "--json"}).out).at("vulkan_devices").at(0).at("name");
    const std::string text = runCommand({"info"}).out;
    EXPECT_NE(text.find(name), std::string::npos);
    EXPECT_NE(text.find("vulkan_devices"), std::string::npos);
}

TEST(Info, saysWhyThereIsNoDevice) {
    for (const char* variable : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) setenv(variable, "/nowhere.json", 1);
    const CommandResult json = runCommand({"info", "--json"}), text = runCommand({"info"});
    for (const char* variable : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) unsetenv(variable);
    EXPECT_EQ(json.status, 0);
    const Json report = Json::parse(json.out);
    EXPECT_TRUE(report.at("vulkan_devices").empty());
    EXPECT_EQ(report.at("backends"), Json::array({"cpu"}));
    EXPECT_EQ(report.at("vulkan_missing"), "Vulkan: no driver is installed");
    EXPECT_NE(text.out.find("Vulkan: no driver is installed"), std::string::npos);
}

}  // namespace
