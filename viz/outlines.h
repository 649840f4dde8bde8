// Lines that say where things are: cascades, the camera, lights, edges of the scene.
#pragma once
#include "bindings/volume_file/baked_volume.h"
#include "viz/drawing.h"

namespace clv {

// A box around each cascade, in a colour of its own.
void drawBoxes(const BakedVolume& volume, Drawing& drawing);
// The edges of a cell.
void drawCellEdges(const ShownCell& cell, FlatLines& lines);
// Of the camera that the cascades stand around, else of the scene's first one; `scene` may be null. Throws InputError where there is none.
void drawFrustum(const BakedVolume& volume, const Scene* scene, Drawing& drawing);
// A cross at each lamp, and the way that the light goes; of a directional light, at the middle of the volume.
void drawLights(const BakedVolume& volume, Drawing& drawing);
void drawWireframe(const Scene& scene, Drawing& drawing);

}  // namespace clv
