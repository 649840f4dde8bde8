// Rooms made up from a seed: scenes that nobody has looked at while working on the library.
#pragma once
#include <cstdint>

#include "bindings/scene/scene.h"

namespace clv {

// A house of one to six rooms with doorways, now and then windows or rooms without a roof; boxes, columns and drapes in them; one or two
// lamps. Size, albedos and, in every third scene or so, a turn of the whole are drawn too. Point lights, spots and suns take turns as the
// first lamp from seed to seed. A camera in each room looks across it, and the first lamp lights something of the first room.
Scene makeGeneratedScene(std::uint32_t seed);

}  // namespace clv
