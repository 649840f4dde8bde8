// Tells contents apart: FNV-1a (Fowler, Noll and Vo) by words of eight bytes. Each step can be undone, so that two contents which differ
// in a single word never share a checksum.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace clv {

class WordChecksum {
public:
    // A last word that is not whole is filled up with zeros.
    void add(std::span<const std::byte> bytes) {
        std::size_t i = 0;
        for (; i + 8 <= bytes.size(); i += 8) addWord(bytes.data() + i, 8);
        if (i < bytes.size()) addWord(bytes.data() + i, bytes.size() - i);
    }
    std::uint64_t value() const { return sum_; }

private:
    void addWord(const std::byte* bytes, std::size_t count) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes, count);
        sum_ = (sum_ ^ word) * 0x100000001b3u;
    }

    std::uint64_t sum_ = 0xcbf29ce484222325u;
};

}  // namespace clv
