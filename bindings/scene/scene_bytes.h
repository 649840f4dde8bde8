// A scene through a pipe, between processes of the same program.
#pragma once
#include "bindings/scene/scene.h"

namespace clv {

// Throws std::runtime_error where the other end is closed early.
void writeScene(int out, const Scene& scene);
Scene readScene(int in);

void writeText(int out, const std::string& text);
std::string readText(int in);

}  // namespace clv
