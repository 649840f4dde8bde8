#include "bindings/scene/importer.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <unistd.h>

#include "bindings/scene/import_gltf.h"
#include "bindings/scene/import_obj.h"
#include "bindings/scene/scene_bytes.h"

namespace clv {
namespace {

constexpr unsigned kMostSeconds = 600;  // ten million triangles take one of 60 s

enum class Answer : char { scene, badInput, failure };

// The process has one importer, as it has one main().
std::unique_ptr<WorkerProcess>& importer() {
    static std::unique_ptr<WorkerProcess> instance;
    return instance;
}

std::uint64_t memoryOfMachine() { return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE)); }

Scene importHere(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension == ".obj" ? importObj(file) : importGltf(file);
}

void answer(int out, Answer kind, const std::string& text) {
    writeAll(out, &kind, sizeof kind);
    writeText(out, text);
}

}  // namespace

void startImporter() {
    try {
        importer() = std::make_unique<WorkerProcess>(serveImport, WorkLimits{kMostSeconds, memoryOfMachine()});
    } catch (const std::runtime_error&) {
        // A machine that allows no further process.
    }
}

Scene importScene(const std::string& file) { return importer() ? importApart(*importer(), file) : importHere(file); }

void serveImport(const std::string& file, int out) {
    try {
        const Scene scene = importHere(file);
        const Answer kind = Answer::scene;
        writeAll(out, &kind, sizeof kind);
        writeScene(out, scene);
    } catch (const InputError& error) {
        answer(out, Answer::badInput, error.what());
    } catch (const std::bad_alloc&) {
        answer(out, Answer::badInput, file + ": more memory is needed than there is; expected a smaller file");
    } catch (const std::exception& error) {
        answer(out, Answer::failure, error.what());
    }
}

Scene importApart(WorkerProcess& process, const std::string& file) {
    Scene scene;
    try {
        process.run(file, [&](int in) {
            Answer kind{};
            readAll(in, &kind, sizeof kind);
            if (kind == Answer::badInput) throw InputError(readText(in));
            if (kind == Answer::failure) throw std::runtime_error(readText(in));
            scene = readScene(in);
        });
    } catch (const WorkFailure& failure) {
        throw InputError(fmt::format("{}: cannot be read: the process that read it failed: {}; expected a sound file", file, failure.what()));
    }
    return scene;
}

}  // namespace clv
