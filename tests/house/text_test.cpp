// What the project's files must not say.
#include <gtest/gtest.h>

#include <regex>

#include "support/project_files.h"

using namespace clv::test;

namespace {

// An absolute path into one machine's workspace. Written in two pieces, so that this file does not find itself.
const std::regex kMachinePath("(^|[\\s\"'`(=:])/" "work(/|\\b)");

bool isText(const std::string& text) { return text.find('\0') == std::string::npos; }

TEST(Text, noFileNamesAFolderOfOneMachine) {
    int read = 0;
    for (const std::string& file : projectFiles("")) {
        std::string text = readText(kSourceDir / file);
        if (!isText(text)) continue;
        ++read;
        std::istringstream lines(text);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            EXPECT_FALSE(std::regex_search(line, kMachinePath)) << file << ":" << number << ": " << line;
        }
    }
    EXPECT_GT(read, 30) << "the project's files were not found";
}

TEST(Text, aFolderOfOneMachineIsFound) {
    const std::string path = std::string("/") + "work";
    EXPECT_TRUE(std::regex_search(path + "/main/x", kMachinePath));
    EXPECT_TRUE(std::regex_search("see " + path, kMachinePath));
    EXPECT_TRUE(std::regex_search("\"" + path + "/shared\"", kMachinePath));
    EXPECT_FALSE(std::regex_search("the frame" + path + "s", kMachinePath));
    EXPECT_FALSE(std::regex_search("../shared/scenes, src" + path + "/x", kMachinePath));
}

TEST(Text, everyHeaderHasAGuardNamedAfterItsPathAndSaysWhatItIsFor) {
    for (const std::string& header : libraryHeaders()) {
        std::string guard = header, text = readText(kSourceDir / "include" / header);
        for (char& c : guard) c = c == '/' || c == '.' ? '_' : char(std::toupper(c));
        EXPECT_NE(text.find("#ifndef " + guard + "\n#define " + guard + "\n"), std::string::npos) << header;
        EXPECT_TRUE(text.starts_with("// ")) << header;
    }
}

}  // namespace
