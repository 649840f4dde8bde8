// A window's picture as a file.
#pragma once
#include <string>

#include <vtkRenderWindow.h>

namespace clv {

// Draws the window and writes it as PNG, complete or not at all. Throws InputError where it cannot be, and std::runtime_error where there is no room.
void writePicture(vtkRenderWindow& window, const std::string& file);

}  // namespace clv
