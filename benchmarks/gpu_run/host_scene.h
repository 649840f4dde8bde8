// A stored scene on the host: the shaders' own walk through its tree, for what a run needs before the GPU begins.
#pragma once
#include <cstdint>
#include <vector>

#include "benchmarks/gpu_run/stored.h"
#include "clv/cpu/parallel.h"
#include "clv/cpu/scene_probe.h"
#include "clv/stages/evaluate.h"

namespace clv {

// What buildLevel asks, answered by the tree. The scene must outlive it. Not watertight: good for times, not for measured light.
SceneProbe probeOf(const StoredScene& scene);

// What each pixel of a picture by the scene's camera shows; pixels that show nothing are left out.
std::vector<ClvReceiver> visibleReceivers(const StoredScene& scene, std::uint32_t width, std::uint32_t height, const ParallelFor& parallelFor);

// On all threads of this machine.
ParallelFor threadsFor();

}  // namespace clv
