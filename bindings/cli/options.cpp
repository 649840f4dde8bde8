#include "bindings/cli/options.h"

#include <charconv>
#include <limits>
#include <thread>

#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include "bindings/cli/standard_streams.h"
#include "bindings/embree/task_pool.h"

namespace clv {
namespace {

constexpr int kMaxThreads = 1024;

template <class Value>
CLI::Option* addCount(CLI::App& command, const std::string& name, Value& value, const std::string& description) {
    return command.add_option_function<std::string>(
        name, [name, &value](const std::string& text) { value = parseCount(name, text); }, description + " (65536, 64k, 4M)");
}

}  // namespace

void addCommonOptions(CLI::App& command, CommonOptions& options) {
    command.add_flag("--json", options.json, "Print one JSON object on stdout, and nothing else there");
    command.add_option("--backend", options.backend, "What computes: auto, cpu or vulkan")
        ->check(CLI::IsMember({"auto", "cpu", "vulkan"}))
        ->capture_default_str();
    command.add_option("--threads", options.threads, "Threads to use; 0: all of the machine's")
        ->check(CLI::Range(0, kMaxThreads))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Seed of the random numbers; results are the same for the same seed")
        ->check(CLI::Range(std::uint32_t(0), std::numeric_limits<std::uint32_t>::max()))
        ->capture_default_str();
}

int threadCount(const CommonOptions& options) {
    return options.threads > 0 ? options.threads : int(std::max(1u, std::thread::hardware_concurrency()));
}

ParallelFor parallelForOf(const CommonOptions& options) {
    return tbbParallelFor(threadCount(options));
}

Report startReport(const CLI::App& command, const CommonOptions& options, bool usesGpu) {
    if (options.backend == "vulkan" && !usesGpu)
        throw InputError(fmt::format("--backend vulkan: {} computes on the CPU alone; expected auto or cpu", command.get_name()));
    return {{"command", command.get_name()}, {"backend", "cpu"}, {"threads", threadCount(options)}, {"seed", options.seed}};
}

void addSceneOptions(CLI::App& command, SceneOptions& options, bool required) {
    auto* scene = command.add_option("--scene", options.scene, "A .glb, .gltf or .obj file, or the name of a built-in scene");
    required ? scene->required() : scene->capture_default_str();
    command.add_option("--lights", options.lights, "A JSON file of lights that replace those of the scene");
}

Scene loadScene(const SceneOptions& options, Report& report) {
    Scene scene = loadScene(options.scene);
    if (!options.lights.empty()) scene.lights = loadLights(options.lights, scene.anchor);
    if (scene.lights.empty())
        throw InputError(fmt::format("{}: no lights; expected KHR_lights_punctual in the scene, or --lights FILE",
                                     options.lights.empty() ? options.scene : options.lights));
    report["scene"] = options.scene;
    report["triangles"] = scene.triangles.size();
    report["lights"] = scene.lights.size();
    if (scene.droppedTriangles > 0) report["dropped_triangles"] = scene.droppedTriangles;
    for (const std::string& warning : scene.warnings) sayOnStderr("clv: " + warning);
    if (!scene.warnings.empty()) report["scene_warnings"] = scene.warnings;
    if (!scene.ignored.empty()) report["ignored"] = scene.ignored;
    return scene;
}

std::uint64_t parseCount(const std::string& option, const std::string& text) {
    std::uint64_t count = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, count);
    const std::string_view suffix(rest, std::size_t(end - rest));
    int shift = -1;
    if (suffix.empty()) shift = 0;
    if (suffix == "k") shift = 10;
    if (suffix == "M") shift = 20;
    if (error != std::errc() || shift < 0 || count == 0 || count > (UINT64_MAX >> 24))
        throw InputError(fmt::format("{}: expected a count such as 65536, 64k or 4M, found \"{}\"", option, text));
    return count << shift;
}

CLI::Option* addCountOption(CLI::App& command, const std::string& name, std::uint64_t& value, const std::string& description) { return addCount(command, name, value, description); }
CLI::Option* addCountOption(CLI::App& command, const std::string& name, std::optional<std::uint64_t>& value, const std::string& description) { return addCount(command, name, value, description); }

CLI::Validator finiteNumber(double above, double atMost, const std::string& expected) {
    return CLI::Validator(
        [=](std::string& text) {
            double number = 0.0;
            // Comparisons that a value that is not a number fails.
            const bool good = CLI::detail::lexical_cast(text, number) && number > above && number <= atMost;
            return good ? std::string() : fmt::format("expected {}, found \"{}\"", expected, text);
        },
        "NUMBER");
}

CLI::Option* addPositiveOption(CLI::App& command, const std::string& name, double& value, const std::string& description) {
    return command.add_option(name, value, description)->check(finiteNumber(0.0, std::numeric_limits<double>::max(), "a number above 0"));
}

void addPointOptions(CLI::App& command, std::string& points, std::string& out, const std::string& columns) {
    command.add_option("--points", points, "CSV file with the header px,py,pz,nx,ny,nz (m, world space; unit normals)")->required();
    command.add_option("--out", out, "CSV file to write: the same columns and " + columns)->required();
}

void addBouncesOption(CLI::App& command, bool& allBounces) {
    command
        .add_option_function<std::string>(
            "--bounces", [&allBounces](const std::string& text) { allBounces = text == "all"; },
            "one: light, one surface, receiver; all: every path")
        ->check(CLI::IsMember({"one", "all"}))
        ->default_str("one");
}

}  // namespace clv
