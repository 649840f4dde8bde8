// What a scene alone says about the light to compute.
#pragma once
#include "bindings/scene/scene.h"
#include "clv/plan/needs.h"

namespace clv {

// True of a lamp that is on.
bool sendsLight(const NamedLight& light);

// m, how far above its surface a ray starts so that it does not meet it again. Positions relative to the anchor of the bounds.
float surfaceOffset(const Bounds& bounds);

// Lights, colours and the directions that surfaces face. A scene alone stands still.
SceneFacts sceneFacts(const Scene& scene);

}  // namespace clv
