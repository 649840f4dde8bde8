#include "bindings/cli/write_text.h"

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace clv {

void writeText(const std::string& file, std::string_view text) {
    std::ofstream output(file, std::ios::binary);
    output << text;
    output.close();
    if (!output) throw std::runtime_error(fmt::format("{}: cannot be written", file));
}

}  // namespace clv
