// Writes JSON, value by value, into a text.
#pragma once
#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace clv {

class Json {
public:
    Json(const char* text) : Json(std::string(text)) {}
    Json(const std::string& text) : text_("\"") {
        for (const char c : text) {
            if (c == '"' || c == '\\') text_ += '\\';
            text_ += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
        text_ += '"';
    }
    Json(bool value) : text_(value ? "true" : "false") {}
    template <class Number>
        requires std::is_arithmetic_v<Number>
    Json(Number value) {
        std::ostringstream stream;
        stream.precision(6);
        stream << value;
        text_ = std::isfinite(double(value)) ? stream.str() : "null";
    }
    Json(const std::vector<Json>& items) : text_("[") {
        for (const Json& item : items) text_.append(text_.size() > 1 ? "," : "").append(item.text_);
        text_ += "]";
    }
    using Member = std::pair<std::string, Json>;
    static Json object(const std::vector<Member>& members) {
        Json json(false);
        json.text_ = "{";
        for (const auto& [name, value] : members) json.text_.append(json.text_.size() > 1 ? "," : "").append(Json(name).text_).append(":").append(value.text_);
        json.text_ += "}";
        return json;
    }

    const std::string& text() const { return text_; }

private:
    std::string text_;
};

}  // namespace clv
