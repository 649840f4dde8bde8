// The scenes and cases of a run on a GPU, computed on the CPU.
#pragma once
#include <string>
#include <vector>

#include "benchmarks/gpu_run/stored.h"

namespace clv {

// A built-in scene; it must have no textures.
StoredScene storedScene(const std::string& name);

std::vector<StoredCase> storedCases();

}  // namespace clv
