// One function a built-in scene.
#pragma once
#include "bindings/scene/scene.h"

namespace clv {

Scene makeCornell();
Scene makeTwoRooms();
Scene makeAtrium();
Scene makeAtriumTurned();
Scene makeCorridor();
Scene makeFurnaceBox();
Scene makeWhiteSphere();

}  // namespace clv
