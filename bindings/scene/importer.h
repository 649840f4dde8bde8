// Scene files are read in a process of their own, so that nothing in one can end the program.
#pragma once
#include "bindings/scene/scene.h"
#include "bindings/scene/worker_process.h"

namespace clv {

// From here on loadScene reads files in such processes. Call it at the start of main(), before any thread is started; without it files are read
// in the program's own process.
void startImporter();

// Reads a .glb, .gltf or .obj file where loadScene would. Throws InputError; what ends a process of the importer is one too.
Scene importScene(const std::string& file);

// The work of an importer's process, and what asks for it.
void serveImport(const std::string& file, int out);
Scene importApart(WorkerProcess& importer, const std::string& file);

}  // namespace clv
