#include "bindings/volume_file/sealed_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "bindings/scene/scene.h"

namespace clv {
namespace {

std::string sealOf(std::uint64_t checksum) {
    return fmt::format("\n<!-- clv {:016x} -->\n", checksum);
}

// Of the first `count` bytes: FNV-1a (Fowler, Noll and Vo) by words of eight bytes. Each step can be undone, so that two files which
// differ in a single word never share a checksum.
std::uint64_t checksumOf(std::ifstream& in, std::uintmax_t count) {
    std::uint64_t sum = 0xcbf29ce484222325u;
    std::vector<char> block(std::size_t(std::min<std::uintmax_t>((count + 7) / 8 * 8, 1 << 20)));
    while (count > 0 && in) {
        const std::size_t size = std::size_t(std::min<std::uintmax_t>(count, block.size()));
        std::fill_n(block.begin() + std::ptrdiff_t(size), size % 8 == 0 ? 0 : 8 - size % 8, '\0');
        in.read(block.data(), std::streamsize(size));
        for (std::size_t i = 0; i < size; i += 8) {
            std::uint64_t word;
            std::memcpy(&word, block.data() + i, 8);
            sum = (sum ^ word) * 0x100000001b3u;
        }
        count -= size;
    }
    return sum;
}

}  // namespace

void sealFile(const std::string& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream in(file, std::ios::binary);
    const std::string seal = sealOf(checksumOf(in, error ? 0 : size));
    std::ofstream out(file, std::ios::binary | std::ios::app);
    out << seal << std::flush;
    if (error || !in || !out) throw std::runtime_error(fmt::format("{}: cannot be written; expected room for it", file));
}

void checkSeal(const std::string& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) throw InputError(file + ": no such file");
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream in(file, std::ios::binary);
    if (error || !in) throw InputError(file + ": cannot be read");
    std::string found = sealOf(0);
    if (size > found.size()) {
        const std::string expected = sealOf(checksumOf(in, size - found.size()));
        in.read(found.data(), std::streamsize(found.size()));
        if (in && found == expected) return;
    }
    throw InputError(file + ": damaged, or not written by clv bake; expected its checksum at the end");
}

}  // namespace clv
