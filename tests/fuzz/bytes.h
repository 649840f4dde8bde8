// Values out of the bytes that a fuzzer tries: what is left when they have run out is 0.
#ifndef CLV_TESTS_FUZZ_BYTES_H
#define CLV_TESTS_FUZZ_BYTES_H
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>

namespace clv::test {

class FuzzBytes {
public:
    FuzzBytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    std::uint8_t byte() { return take<std::uint8_t>(); }
    bool flag() { return byte() & 1; }
    // The bits of any value.
    template <class Value>
    Value take() {
        Value value{};
        const std::size_t bytes = std::min(sizeof value, left_.size());
        if (bytes > 0) std::memcpy(&value, left_.data(), bytes);
        left_ = left_.subspan(bytes);
        return value;
    }
    // Mostly a value in [lo, hi], now and then any bits, or one that is hard to compute with.
    template <class Float>
    Float number(Float lo, Float hi) {
        using Limits = std::numeric_limits<Float>;
        constexpr Float kHard[] = {0, -Float(0), Limits::denorm_min(), Limits::min(), Limits::max(), Limits::lowest(), Limits::infinity(), Limits::quiet_NaN()};
        const std::uint8_t choice = byte();
        if (choice < std::size(kHard)) return kHard[choice];
        if (choice < 16) return take<Float>();
        return lo + (hi - lo) * Float(take<std::uint16_t>()) / Float(65535);
    }
    int integer(int lo, int hi) {
        constexpr int kHard[] = {0, -1, 1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
        const std::uint8_t choice = byte();
        if (choice < std::size(kHard)) return kHard[choice];
        if (choice < 16) return take<int>();
        return lo + take<std::uint16_t>() % (hi - lo + 1);
    }

private:
    std::span<const std::uint8_t> left_;
};

// Ends the program where a claim does not hold, in every kind of build.
inline void require(bool holds, const char* claim) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", claim);
    std::abort();
}

}  // namespace clv::test

// What every fuzzer and the replay of its corpus call.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
#endif
