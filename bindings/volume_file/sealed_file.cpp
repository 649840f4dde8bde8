#include "bindings/volume_file/sealed_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/scene.h"
#include "bindings/volume_file/word_checksum.h"

namespace clv {
namespace {

std::string sealOf(std::uint64_t checksum) {
    return fmt::format("\n<!-- clv {:016x} -->\n", checksum);
}

// Of the first `count` bytes.
std::uint64_t checksumOf(std::ifstream& in, std::uintmax_t count) {
    constexpr std::uintmax_t kBlock = 1 << 20;
    WordChecksum sum;
    std::vector<char> block(std::size_t(std::min(count, kBlock)));
    while (count > 0 && in) {
        const auto part = std::span(block).first(std::size_t(std::min(count, kBlock)));
        in.read(part.data(), std::streamsize(part.size()));
        sum.add(std::as_bytes(part));
        count -= part.size();
    }
    return sum.value();
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
    requireFile(file);
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
