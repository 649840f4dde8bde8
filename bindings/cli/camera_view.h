// Cameras by name.
#pragma once
#include <string>

#include "bindings/scene/scene.h"

namespace clv {

// By name, or by index from 0. Throws InputError that lists the scene's cameras.
const Camera& chooseCamera(const Scene& scene, const std::string& nameOrIndex);

}  // namespace clv
