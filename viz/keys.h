// What the keys do, and the help that lists them.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace clv {

class Inspector;

struct Key {
    std::string symbol;   // as X names it
    std::string shown;    // in the help
    std::string meaning;
    std::function<void(Inspector&)> act;
};
const std::vector<Key>& keys();
// A line a key, and one for each thing that the mouse does.
std::string keyHelp();

}  // namespace clv
