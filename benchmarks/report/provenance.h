// Where measurements come from: the program, the machine and the time.
#pragma once
#include <string>

#include <nlohmann/json.hpp>

namespace clv {

// Of this program's file: measurements of the same program can be told from those of another, committed or not.
std::string programChecksum();

// Commit, compiler, processor, hardware threads, and the date (UTC).
nlohmann::ordered_json provenance();

}  // namespace clv
