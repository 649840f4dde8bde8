// Imports .gltf and .glb files.
#pragma once
#include <string>

#include "bindings/scene/scene.h"

namespace clv {

Scene importGltf(const std::string& file);

}  // namespace clv
