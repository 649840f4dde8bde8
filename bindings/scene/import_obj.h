// Imports .obj files, in metres, Y up.
#pragma once
#include <string>

#include "bindings/scene/scene.h"

namespace clv {

Scene importObj(const std::string& file);

}  // namespace clv
