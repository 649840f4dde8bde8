// The light of the GPU is the CPU's, run for run; what goes wrong with a device is one line, and `auto` goes on with the CPU.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vulkan/vulkan_core.h>

#include "benchmarks/report/metrics.h"
#include "bindings/cli/pipeline.h"
#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/builtin_scenes.h"
#include "cli/run_command.h"
#include "support/temporary_folder.h"
#include "vulkan/watched_vulkan.h"

namespace clv::test {
namespace {

using Json = nlohmann::json;

struct Light {
    std::vector<glm::vec3> irradiance;
    PipelineReport report;
};

class Backends : public testing::Test {
protected:
    static LightOptions options(std::uint64_t rays, bool allBounces = false) {
        LightOptions options;
        options.rays = rays, options.allBounces = allBounces;
        return options;
    }
    static std::vector<ReferencePoint> seenPoints(const Scene& scene) {
        std::vector<ReferencePoint> points;
        for (const ClvReceiver& r : visiblePoints(EmbreeScene(scene), 500, 7)) points.push_back({r.position, r.normal});
        return points;
    }
    static Light lightBy(const std::string& backend, const Scene& scene, LightOptions options, std::uint32_t seed = 1) {
        options.backend.choice = backend;
        const auto points = seenPoints(scene);
        Light light;
        light.irradiance.resize(points.size());
        light.report = lightPoints(scene, options, seed, tbbParallelFor(2), points, light.irradiance);
        return light;
    }
    static bool sameBits(const Light& a, const Light& b) {
        return a.irradiance.size() == b.irradiance.size() && std::memcmp(a.irradiance.data(), b.irradiance.data(), a.irradiance.size() * sizeof(glm::vec3)) == 0;
    }
    static double difference(const Light& a, const Light& b) { return summarizeErrors(a.irradiance, b.irradiance).relativeRmse; }
    static void expectTheCpusLight(const Scene& scene, const LightOptions& options) {
        const Light cpu = lightBy("cpu", scene, options), gpu = lightBy("vulkan", scene, options);
        EXPECT_LE(difference(gpu, cpu), 1e-3) << scene.name;
        EXPECT_GT(meanIrradiance(cpu.irradiance), 0.0);
        EXPECT_EQ(cpu.report.backend, "cpu");
        EXPECT_EQ(gpu.report.backend, "vulkan");
        EXPECT_FALSE(gpu.report.device.empty());
        EXPECT_EQ(gpu.report.rays, cpu.report.rays);
        EXPECT_EQ(gpu.report.sweeps, cpu.report.sweeps);
        EXPECT_EQ(gpu.report.guided, cpu.report.guided);
        EXPECT_EQ(gpu.report.channels, cpu.report.channels);
        ASSERT_EQ(gpu.report.levels.size(), cpu.report.levels.size());
        for (std::size_t l = 0; l < gpu.report.levels.size(); ++l) EXPECT_EQ(gpu.report.levels[l].first, cpu.report.levels[l].first);
    }
};

TEST_F(Backends, giveTheSameLight) {
    for (const char* name : {"cornell", "two_rooms", "atrium", "atrium_turned", "white_sphere"}) {
        LightOptions coarse = options(128 << 10);
        coarse.resolution = 16;
        expectTheCpusLight(makeBuiltinScene(name), coarse);
    }
}

// From the second bounce on rays leave places that others have hit: the smallest rounding leads to other rays, and what is left between the
// back ends is noise of some bounces. It must be less than what another seed makes of all of them, and none of it a bias.
TEST_F(Backends, agreeOnAllBouncesBetterThanSeedsDo) {
    LightOptions coarse = options(512 << 10, true);
    coarse.resolution = 16;
    for (const char* name : {"cornell", "two_rooms"}) {
        const Scene scene = makeBuiltinScene(name);
        double backends = 0.0, seeds = 0.0, bias = 0.0, spread = 0.0;
        for (const std::uint32_t seed : {1u, 2u, 3u}) {
            const Light cpu = lightBy("cpu", scene, coarse, seed), gpu = lightBy("vulkan", scene, coarse, seed);
            backends += std::pow(difference(gpu, cpu), 2.0);
            const Light other = lightBy("cpu", scene, coarse, seed + 10);
            seeds += std::pow(difference(other, cpu), 2.0);
            spread += std::pow(meanIrradiance(other.irradiance) / meanIrradiance(cpu.irradiance) - 1.0, 2.0);
            bias += meanIrradiance(gpu.irradiance) / meanIrradiance(cpu.irradiance) - 1.0;
            EXPECT_GT(gpu.report.sweeps, 2u);
        }
        EXPECT_LT(backends, seeds) << name;
        EXPECT_LT(std::abs(bias) / 3.0, 2.0 * std::sqrt(spread / 3.0)) << name;
        RecordProperty(std::string(name) + " backends, seeds, bias, spread", testing::PrintToString(std::vector<double>{std::sqrt(backends / 3.0), std::sqrt(seeds / 3.0), bias / 3.0, std::sqrt(spread / 3.0)}));
    }
}

// Levels join and go; shots are larger than what the device takes at once.
TEST_F(Backends, chooseTheSameLevels) {
    for (const char* name : {"cornell", "two_rooms"}) expectTheCpusLight(makeBuiltinScene(name), options(1 << 20));
}

TEST_F(Backends, giveTheSameLightWithASimplerSceneForRays) {
    LightOptions coarse = options(64 << 10);
    coarse.resolution = 16;
    const Scene cornell = makeBuiltinScene("cornell");
    const double share = lightBy("cpu", cornell, coarse).report.shareThatMeets;
    // Where rays pass through walls that the proxy lacks, rounding may decide on which side of one a piece counts.
    coarse.proxy = "cornell";
    expectTheCpusLight(cornell, coarse);
    coarse.proxy = "furnace_box";
    const Light cpu = lightBy("cpu", cornell, coarse), gpu = lightBy("vulkan", cornell, coarse);
    EXPECT_EQ(gpu.report.shareThatMeets, cpu.report.shareThatMeets);
    EXPECT_GT(gpu.report.shareThatMeets, share + 0.05);
    EXPECT_LE(difference(gpu, cpu), 0.05);
}

TEST_F(Backends, giveTheSameBitsFromRunToRunWhereThatIsAskedFor) {
    LightOptions repeatable = options(64 << 10);
    repeatable.backend.repeatable = true, repeatable.resolution = 16;
    for (const char* name : {"cornell", "atrium"}) {
        const Scene scene = makeBuiltinScene(name);
        expectTheCpusLight(scene, repeatable);
        LightOptions all = repeatable;
        all.allBounces = true;
        for (const LightOptions& bounces : {repeatable, all}) EXPECT_TRUE(sameBits(lightBy("vulkan", scene, bounces), lightBy("vulkan", scene, bounces))) << name;
    }
}

class FailingDevices : public Backends {
protected:
    void SetUp() override {
        watched = &watchVulkan();
        coarse = options(64 << 10);
        coarse.resolution = 8, coarse.backend.loader = watchedLoader();
    }
    void TearDown() override { watchVulkan(); }

    void expectFailure(const std::string& words) {
        try {
            lightBy("vulkan", scene, coarse);
            ADD_FAILURE() << "did not fail: " << words;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
    void expectTheCpu(const std::string& reason) {
        const Light light = lightBy("auto", scene, coarse);
        EXPECT_EQ(light.report.backend, "cpu");
        EXPECT_NE(light.report.whyCpu.find(reason), std::string::npos) << light.report.whyCpu;
        EXPECT_TRUE(sameBits(light, lightBy("cpu", scene, coarse)));
    }

    WatchedVulkan* watched = nullptr;
    const Scene scene = makeBuiltinScene("cornell");
    LightOptions coarse;
};

TEST_F(FailingDevices, autoTakesAGpu) {
    watched->discrete = true;
    const Light light = lightBy("auto", scene, coarse);
    EXPECT_EQ(light.report.backend, "vulkan");
    EXPECT_EQ(light.report.whyCpu, "");
}

TEST_F(FailingDevices, autoLeavesTheProcessorsOwnDeviceAlone) { expectTheCpu("no device but the processor"); }

TEST_F(FailingDevices, endInOneLineWithoutALoaderOrADevice) {
    coarse.backend.loader = "/nowhere/libvulkan.so";
    expectFailure("Vulkan: no loader");
    expectTheCpu("Vulkan: no loader");
    coarse.backend.loader = watchedLoader();
    watched->devices = 0;
    expectFailure("Vulkan: no device");
    expectTheCpu("Vulkan: no device");
}

TEST_F(FailingDevices, endInOneLineWhereTheDeviceIsLostInTheMiddle) {
    watched->discrete = true;
    for (const int submissions : {0, 3, 6}) {
        watched->calls.clear();
        watched->failing = "vkQueueSubmit", watched->failure = VK_ERROR_DEVICE_LOST, watched->failAfter = submissions;
        expectFailure("Vulkan: the device was lost");
        watched->calls.clear();
        expectTheCpu("Vulkan: the device was lost");
    }
}

TEST_F(FailingDevices, endInOneLineWhereMemoryRunsOut) {
    watched->discrete = true;
    watched->failing = "vkAllocateMemory", watched->failure = VK_ERROR_OUT_OF_DEVICE_MEMORY, watched->failAfter = 15;
    expectFailure("Vulkan: the device is out of memory");
    watched->calls.clear();
    expectTheCpu("Vulkan: the device is out of memory");
}

// The command as its users run it.
class VulkanCommand : public TemporaryFolder {
protected:
    CommandResult irradiance(const std::string& backend, const std::vector<std::string>& more = {}) const {
        const std::string points = write("p.csv", "px,py,pz,nx,ny,nz\n0.3,0,0.2,0,1,0\n0.1,0,0.4,0,1,0\n");
        std::vector<std::string> all = {"irradiance", "--scene", "cornell", "--points", points, "--out", file("r.csv"), "--rays", "32k", "--resolution", "8", "--backend", backend, "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return runCommand(all);
    }
};

// Variables of the environment for a while.
struct Environment {
    explicit Environment(std::vector<std::pair<const char*, const char*>> v) : variables(std::move(v)) {
        for (const auto& [name, value] : variables) setenv(name, value, 1);
    }
    ~Environment() {
        for (const auto& [name, value] : variables) unsetenv(name);
    }
    std::vector<std::pair<const char*, const char*>> variables;
};

TEST_F(VulkanCommand, saysWhatComputed) {
    const CommandResult result = irradiance("vulkan", {"--device", "0"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json report = Json::parse(result.out);
    EXPECT_EQ(report.at("backend"), "vulkan");
    EXPECT_NE(report.at("device"), "");
    for (const char* stage : {"rsm_ms", "rays_ms", "trace_ms", "inject_ms", "evaluate_ms"}) EXPECT_GT(report.at("stages").at(stage), 0.0) << stage;
    EXPECT_EQ(result.err, "");
}

TEST_F(VulkanCommand, breaksNoRuleOfVulkans) {
    const Environment validated({{"VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation"}, {"VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"}});
    const CommandResult result = irradiance("vulkan", {"--bounces", "all"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out.find("Validation"), std::string::npos) << result.out;
    EXPECT_EQ(result.err, "");
}

TEST_F(VulkanCommand, withoutADriverIsAFailureInOneLineAndAutoGoesOn) {
    const Environment none({{"VK_ICD_FILENAMES", "/nowhere.json"}, {"VK_DRIVER_FILES", "/nowhere.json"}});
    const CommandResult vulkan = irradiance("vulkan"), automatic = irradiance("auto");
    EXPECT_EQ(vulkan.status, 1);
    EXPECT_EQ(vulkan.err, "clv irradiance: Vulkan: no driver is installed\n");
    EXPECT_EQ(vulkan.out, "");
    ASSERT_EQ(automatic.status, 0);
    EXPECT_EQ(automatic.err, "clv: --backend auto takes the CPU: Vulkan: no driver is installed\n");
    EXPECT_EQ(Json::parse(automatic.out).at("backend"), "cpu");
    EXPECT_EQ(Json::parse(automatic.out).at("why_cpu"), "Vulkan: no driver is installed");
}

TEST_F(VulkanCommand, aDeviceThatIsNotThereIsAFailure) {
    const CommandResult result = irradiance("vulkan", {"--device", "no such device"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("no device with \"no such device\" in its name"), std::string::npos) << result.err;
}

TEST_F(VulkanCommand, rendersTheCpusPicture) {
    Json errors[2];
    for (int k = 0; k < 2; ++k) {
        const CommandResult result = runCommand({"render", "--scene", "cornell", "--width", "48", "--rays", "64k", "--resolution", "16", "--samples", "4", "--error-samples", "64",
                                                 "--backend", k == 0 ? "cpu" : "vulkan", "--out", file(k == 0 ? "cpu" : "vulkan"), "--json"});
        ASSERT_EQ(result.status, 0) << result.err;
        errors[k] = Json::parse(result.out).at("errors");
    }
    // The same truth: its noise is the same for both.
    EXPECT_NEAR(errors[0].at("relative_rmse").get<double>(), errors[1].at("relative_rmse").get<double>(), 1e-3);
    EXPECT_NEAR(errors[0].at("bias").get<double>(), errors[1].at("bias").get<double>(), 1e-3);
}

}  // namespace
}  // namespace clv::test
