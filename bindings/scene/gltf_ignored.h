// What of a glTF file plays no part in diffuse light, and what must not be passed over.
#pragma once
#include "bindings/scene/json_reader.h"
#include "bindings/scene/scene_builder.h"

namespace clv {

// Tells the builder of every feature that is left out. Throws InputError when leaving one out would change the geometry.
void noteIgnoredFeatures(const JsonReader& root, SceneBuilder& builder);

}  // namespace clv
