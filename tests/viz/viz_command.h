// Runs the built `clv-viz` as its users do, and the volumes that it opens.
#pragma once
#include <cstdlib>
#include <filesystem>

#include "cli/run_command.h"
#include "support/temporary_folder.h"
#include "viz/baked_scene.h"

namespace clv::test {

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class VizCommand : public TemporaryFolder {
protected:
    // Writes the volume as V.vtm.
    std::string bake(const std::string& scene, int resolution) const {
        writeVolume("V.vtm", bakedScene(scene, resolution), pathOf());
        return file("V.vtm");
    }
    // For files in the test's folder.
    PathOfName pathOf() const {
        return [this](const std::string& name) {
            std::filesystem::create_directories((folder_ / name).parent_path());
            return file(name);
        };
    }
    static CommandResult runViz(const std::vector<std::string>& arguments) { return RunningCommand(arguments, false, kProgram).wait(); }

    static constexpr const char* kProgram = CLV_BINARY_DIR "/clv-viz";
};

}  // namespace clv::test
