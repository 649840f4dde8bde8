// Time to load a scene, over the number of its objects: nothing looks at all others for each.
#include <benchmark/benchmark.h>

#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bindings/scene/glb_container.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

using nlohmann::json;

// Triangles of one buffer, each with a mesh, a node and an accessor of indices.
std::string gltfOf(std::size_t meshes) {
    const std::array<float, 9> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::array<std::uint16_t, 3> indices = {0, 1, 2};
    std::vector<std::uint8_t> binary;
    appendBytes(binary, positions.data(), sizeof positions);
    appendBytes(binary, indices.data(), sizeof indices);
    json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"buffers", {{{"byteLength", binary.size()}}}}};
    document["bufferViews"] = {{{"buffer", 0}, {"byteLength", sizeof positions}}};
    document["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}};
    for (std::size_t i = 0; i < meshes; ++i) {
        document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", sizeof positions}, {"byteLength", sizeof indices}});
        document["accessors"].push_back({{"bufferView", i + 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}});
        document["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", i + 1}}}}});
        document["nodes"].push_back({{"name", fmt::format("leaf {}", i)}, {"mesh", i}});
        document["scenes"][0]["nodes"].push_back(i);
    }
    const std::vector<std::uint8_t> bytes = packGlb(document, binary);
    return {bytes.begin(), bytes.end()};
}

// Triangles of three vertices, each an object of its own.
std::string objOf(std::size_t objects) {
    std::string text;
    for (std::size_t i = 0; i < objects; ++i) text += fmt::format("o leaf{}\nv {} 0 0\nv 1 0 {}\nv 0 1 0\nf -3 -2 -1\n", i, i, i);
    return text;
}

void load(benchmark::State& state, const char* ending, const std::string& text, std::size_t count) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / fmt::format("clv_benchmark_{}{}", getpid(), ending);
    std::ofstream(file, std::ios::binary) << text;
    for (auto _ : state) {
        if (loadScene(file.string()).triangles.size() == count) continue;
        state.SkipWithError("triangles are missing");
        break;
    }
    std::filesystem::remove(file);
    state.counters["bytes"] = double(text.size());
    state.counters["s/object"] = benchmark::Counter(double(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

[[maybe_unused]] const bool kRegistered = [] {
    const auto add = [](const std::string& kind, std::size_t count, const char* ending, std::string (*textOf)(std::size_t)) {
        benchmark::RegisterBenchmark(fmt::format("load/{}/objects:{}", kind, count).c_str(), [=](benchmark::State& state) { load(state, ending, textOf(count), count); })
            ->Unit(benchmark::kMillisecond);
    };
    for (const std::size_t count : {2000, 8000, 32000, 128000}) {
        add("gltf", count, ".glb", gltfOf);
        add("obj", count, ".obj", objOf);
    }
    return true;
}();

}  // namespace
}  // namespace clv
