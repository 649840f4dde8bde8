// Documents lead where they say.
#include <gtest/gtest.h>

#include <regex>

#include "support/project_files.h"

using namespace clv::test;

namespace {

// What the links and pictures of a Markdown text point to within the project, without the place in the file. Blocks of code have none.
std::vector<std::string> localTargets(const std::string& markdown) {
    static const std::regex link(R"(\]\(([^)#]+)[^)]*\))"), block("```[^`]*```");
    const std::string text = std::regex_replace(markdown, block, "");
    std::vector<std::string> targets;
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
        if ((*it)[1].str().find("://") == std::string::npos) targets.push_back((*it)[1]);
    }
    return targets;
}

TEST(Links, ofDocumentsLeadToFilesOfTheProject) {
    int links = 0;
    for (const std::string& file : projectFiles("")) {
        if (!file.ends_with(".md")) continue;
        for (const std::string& target : localTargets(readText(kSourceDir / file))) {
            ++links;
            EXPECT_TRUE(fs::exists(kSourceDir / fs::path(file).parent_path() / target)) << file << " links to " << target;
        }
    }
    EXPECT_GT(links, 20) << "the documents were not found";
}

TEST(Links, areFoundInText) {
    const std::vector<std::string> expected{"a/b.h", "../c.md", "d.png"};
    EXPECT_EQ(localTargets("see [b](a/b.h), [c](../c.md#place) ![d](d.png) and [web](https://example.org/x), f(x)\n```\na[9](x)\n```\n"), expected);
}

}  // namespace
