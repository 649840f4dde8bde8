// Reads JSON with the place of every value at hand, so that an error says where it is and what was expected.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "bindings/scene/scene.h"

namespace clv {

// A value inside a document that outlives it. Every member throws InputError when the value is not what it asks for.
class JsonReader {
public:
    // `file` begins every error.
    JsonReader(std::string file, const nlohmann::json& value) : JsonReader(std::move(file), {}, value) {}

    [[noreturn]] void fail(const std::string& expected) const {
        throw InputError(fmt::format("{}: {}{}expected {}", file_, place_, place_.empty() ? "" : ": ", expected));
    }
    const std::string& place() const { return place_; }

    bool has(const char* key) const { return object().contains(key); }
    JsonReader operator[](const char* key) const {
        if (!has(key)) fail(fmt::format("a member '{}'", key));
        return {file_, place_.empty() ? key : place_ + "." + key, value_->at(key)};
    }
    // Elements of the array `key`; none when there is no such member.
    std::vector<JsonReader> elements(const char* key) const { return has(key) ? (*this)[key].elements() : std::vector<JsonReader>(); }
    std::vector<JsonReader> elements() const {
        if (!value_->is_array()) fail("an array");
        std::vector<JsonReader> all;
        all.reserve(value_->size());
        for (std::size_t i = 0; i < value_->size(); ++i) all.push_back(element(i));
        return all;
    }
    // Of an array that has it.
    JsonReader element(std::size_t index) const { return {file_, fmt::format("{}[{}]", place_, index), value_->at(index)}; }
    std::vector<std::string> keys() const {
        std::vector<std::string> all;
        for (const auto& item : object().items()) all.push_back(item.key());
        return all;
    }

    double number() const {
        if (!value_->is_number()) fail("a number");
        return value_->get<double>();
    }
    double number(const char* key, double otherwise) const { return has(key) ? (*this)[key].number() : otherwise; }
    std::string text() const {
        if (!value_->is_string()) fail("a string");
        return value_->get<std::string>();
    }
    std::string text(const char* key, const std::string& otherwise) const { return has(key) ? (*this)[key].text() : otherwise; }
    // A whole number in [0, limit).
    std::size_t index(std::size_t limit = std::size_t(1) << 48) const {
        if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() >= limit)
            fail(fmt::format("a whole number from 0 to {}", limit == 0 ? "-1 (there is none to refer to)" : std::to_string(limit - 1)));
        return value_->get<std::uint64_t>();
    }
    std::size_t index(const char* key, std::size_t otherwise) const { return has(key) ? (*this)[key].index() : otherwise; }
    // Exactly `count` numbers.
    std::vector<double> numbers(std::size_t count) const {
        std::vector<double> all;
        for (const JsonReader& element : elements()) all.push_back(element.number());
        if (all.size() != count) fail(fmt::format("{} numbers", count));
        return all;
    }
    glm::dvec3 vector() const {
        const std::vector<double> n = numbers(3);
        return {n[0], n[1], n[2]};
    }
    glm::dvec3 vector(const char* key, const glm::dvec3& otherwise) const { return has(key) ? (*this)[key].vector() : otherwise; }

private:
    JsonReader(std::string file, std::string place, const nlohmann::json& value)
        : file_(std::move(file)), place_(std::move(place)), value_(&value) {}
    const nlohmann::json& object() const {
        if (!value_->is_object()) fail("an object");
        return *value_;
    }

    std::string file_;
    std::string place_;
    const nlohmann::json* value_;
};

// Throws InputError that says at which byte the text stops being JSON, or which key an object has twice.
nlohmann::json parseJson(const std::string& file, std::span<const std::uint8_t> text);

}  // namespace clv
