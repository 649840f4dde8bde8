#include <algorithm>
#include <cctype>
#include <filesystem>

#include "bindings/scene/importer.h"
#include "bindings/scene/scene.h"

namespace clv {

Scene loadScene(const std::string& fileOrName) {
    std::string extension = std::filesystem::path(fileOrName).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (extension == ".glb" || extension == ".gltf" || extension == ".obj") return importScene(fileOrName);
    return makeBuiltinScene(fileOrName);
}

}  // namespace clv
