// Where the view is taken from.
#pragma once
#include <string>

#include <vtkCamera.h>

#include "bindings/volume_file/baked_volume.h"

namespace clv {

struct CameraPose {
    glm::vec3 position{0.0f}, target{0.0f, 0.0f, -1.0f};  // m, relative to the volume's anchor
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float yfov = 0.6f;                                    // rad
};

Bounds boundsOf(const ClvVolume& grid);
// Of cascades, which reach far beyond a scene, what of the scene lies in the outermost one; all of that one where the scene is
// unknown or elsewhere. Of a single grid all.
Bounds litBounds(const BakedVolume& volume);

// From outside, so that all of it fits in a picture of this aspect.
CameraPose overview(const Bounds& bounds, float aspect);
CameraPose poseOf(const Camera& camera);
Camera cameraOf(const CameraPose& pose);
// The name or index of one of `scene`'s cameras (null: there are none), or px,py,pz,tx,ty,tz[,yfov] in world space. Throws InputError.
CameraPose parsePose(const std::string& text, const BakedVolume& volume, const Scene* scene);

void place(vtkCamera& camera, const CameraPose& pose);

}  // namespace clv
