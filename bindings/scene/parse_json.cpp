#include <set>

#include "bindings/scene/json_reader.h"

namespace clv {
namespace {

using nlohmann::json;

// Stops at a key that an object has already. A filter for json::parse would do the same, but looks at all elements of an array after each
// object in it: quadratic time.
class KeysOnce : public nlohmann::json_sax<json> {
public:
    std::string twice;

    bool start_object(std::size_t) override {
        keys_.emplace_back();
        return true;
    }
    bool key(string_t& name) override {
        if (keys_.back().insert(name).second) return true;
        twice = name;
        return false;
    }
    bool end_object() override {
        keys_.pop_back();
        return true;
    }

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

private:
    std::vector<std::set<std::string>> keys_;  // of the objects that are open
};

}  // namespace

json parseJson(const std::string& file, std::span<const std::uint8_t> text) {
    try {
        json parsed = json::parse(text.begin(), text.end());
        KeysOnce keys;
        if (!json::sax_parse(text.begin(), text.end(), &keys)) throw InputError(fmt::format("{}: expected '{}' once in its object", file, keys.twice));
        return parsed;
    } catch (const json::parse_error& error) {
        throw InputError(fmt::format("{}: byte {}: expected well-formed JSON", file, error.byte));
    } catch (const json::out_of_range&) {
        throw InputError(fmt::format("{}: expected JSON whose numbers fit into a double", file));
    }
}

}  // namespace clv
