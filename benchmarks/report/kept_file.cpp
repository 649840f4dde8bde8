#include "benchmarks/report/kept_file.h"

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace clv {

void keepFile(const std::filesystem::path& file, std::string_view bytes) {
    const std::filesystem::path unfinished = file.string() + ".unfinished";
    std::ofstream output(unfinished, std::ios::binary);
    output << bytes;
    output.close();
    if (!output) {
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
        throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
    }
    std::filesystem::rename(unfinished, file);
}

}  // namespace clv
