// The standard streams as the process finds them: closed, full, or a terminal.
#pragma once
#include <string_view>

namespace clv {

// Gives those that are closed a descriptor that cannot be written, so that no file takes their place. Call it at the start of main().
void fillStandardDescriptors();

// A stderr that cannot be written changes nothing.
void writeStderr(std::string_view text);
// One line; control characters, which input may hold, show as \x1b.
void sayOnStderr(std::string_view line);

}  // namespace clv
