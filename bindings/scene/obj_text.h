// The lines of .obj files and their material libraries, and what stands on them.
#pragma once
#include <functional>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace clv {

struct ObjLine {
    const std::string& file;
    std::size_t number;
    std::string place() const { return fmt::format("{}:{}", file, number); }
    [[noreturn]] void fail(const std::string& expected) const;
};

// Calls `take` with each line's keyword and what follows it; words.str() is the line, without a byte order mark, blanks at both ends and comments behind numbers. A line
// that goes on after a backslash is whole. Throws InputError.
void forEachObjLine(const std::string& file, const std::function<void(const ObjLine&, const std::string& keyword, std::istringstream& words)>& take);

// What is left of the line: a name, which may hold spaces.
std::string restOf(std::istringstream& words);

// The numbers that are left on the line; throws InputError where one is none or is misread by assimp, or where there are not as many as one of `counts` says.
std::vector<double> numbersOf(const ObjLine& line, std::istringstream& words, std::initializer_list<std::size_t> counts, const char* expected);

}  // namespace clv
