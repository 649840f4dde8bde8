// A number that tells contents apart, for names of cached files: FNV-1a (Fowler, Noll and Vo), 64 bits.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace clv {

class Checksum {
public:
    void add(std::span<const std::byte> bytes) {
        for (const std::byte b : bytes) value_ = (value_ ^ std::uint64_t(b)) * 0x100000001b3u;
    }
    void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
    template <class T>
        requires std::is_trivially_copyable_v<T>
    void add(const std::vector<T>& values) {
        add(std::as_bytes(std::span(values)));
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace clv
