#include "bindings/scene/file_bytes.h"

#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "bindings/scene/scene.h"

namespace clv {

bool isFile(const std::filesystem::path& name) {
    std::error_code error;
    return std::filesystem::is_regular_file(name, error);
}

void requireFile(const std::string& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw InputError(file + ": expected a file, not a folder");
    if (!isFile(file)) throw InputError(file + ": no such file");
}

std::vector<std::uint8_t> readFileBytes(const std::string& file) {
    std::error_code error;
    requireFile(file);
    std::ifstream in(file, std::ios::binary);
    std::vector<std::uint8_t> bytes(std::filesystem::file_size(file, error));
    in.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
    if (!in || error) throw InputError(file + ": cannot be read");
    return bytes;
}

void writeFileBytes(const std::string& file, const std::vector<std::uint8_t>& bytes) {
    const std::string temporary = fmt::format("{}.{}.tmp", file, getpid());
    std::ofstream out(temporary, std::ios::binary);
    if (!out) throw InputError(file + ": cannot be written; expected a folder that exists and can be written to");
    out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    out.close();
    std::error_code error;
    if (out) std::filesystem::rename(temporary, file, error);
    if (!out || error) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw std::runtime_error(file + ": cannot be written; expected room for it");
    }
}

}  // namespace clv
