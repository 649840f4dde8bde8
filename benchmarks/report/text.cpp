#include "benchmarks/report/text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace clv {

std::string percentText(double fraction) {
    if (!std::isfinite(fraction)) return "∞";
    return fmt::format("{:.{}f} %", 100.0 * fraction, std::abs(fraction) < 0.995 ? 1 : 0);
}

std::string timeText(double seconds) {
    const double milliseconds = 1e3 * seconds;
    if (milliseconds < 10.0) return fmt::format("{:.2f} ms", milliseconds);
    if (milliseconds < 1000.0) return fmt::format("{:.{}f} ms", milliseconds, milliseconds < 100.0 ? 1 : 0);
    return fmt::format("{:.{}f} s", seconds, seconds < 100.0 ? 1 : 0);
}

std::string countText(std::uint64_t count) {
    if (count >= 1u << 20 && count % (1u << 20) == 0) return fmt::format("{}M", count >> 20);
    if (count >= 1u << 10 && count % (1u << 10) == 0) return fmt::format("{}k", count >> 10);
    return std::to_string(count);
}

std::string groupedText(double count) {
    std::string text = fmt::format("{:.0f}", count);
    for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
    return text;
}

std::string bytesText(std::size_t bytes) {
    if (bytes < 1u << 20) return fmt::format("{:.1f} KiB", double(bytes) / double(1u << 10));
    return fmt::format("{:.1f} MiB", double(bytes) / double(1u << 20));
}

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
            case '&': safe += "&amp;"; break;
            case '<': safe += "&lt;"; break;
            case '>': safe += "&gt;"; break;
            case '"': safe += "&quot;"; break;
            default: safe += c;
        }
    }
    return safe;
}

std::string base64(const std::string& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < count ? std::uint8_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[three >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

}  // namespace clv
