// The project's own files, as tests that judge the source itself read them.
#ifndef CLV_TESTS_SUPPORT_PROJECT_FILES_H
#define CLV_TESTS_SUPPORT_PROJECT_FILES_H
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace clv::test {

namespace fs = std::filesystem;

inline const fs::path kSourceDir = CLV_SOURCE_DIR;

inline std::string readText(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

// Files below `folder` (relative to the project, "" for all of it), as sorted relative paths with forward slashes.
// Hidden folders other than .ci and .github, .git (a file in a worktree), and what .gitignore names as outputs, are no part of the
// project.
inline std::vector<std::string> projectFiles(const std::string& folder) {
    std::vector<std::string> files;
    fs::path root = kSourceDir / folder;
    if (!fs::exists(root)) return files;
    for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator(); ++it) {
        std::string name = it->path().filename().string();
        bool top = it->path().parent_path() == kSourceDir;
        bool hidden = name[0] == '.' && name != ".ci" && name != ".github";
        bool output = top && (name.starts_with("build") || name == "out" || name == "demo-out");
        if (it->is_directory() && (hidden || output)) {
            it.disable_recursion_pending();
        } else if (it->is_regular_file() && name != ".git") {
            files.push_back(it->path().lexically_relative(kSourceDir).generic_string());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

// The library's headers, relative to include/, e.g. "clv/math/hash.h".
inline std::vector<std::string> libraryHeaders() {
    std::vector<std::string> headers;
    for (const std::string& file : projectFiles("include")) {
        if (file.ends_with(".h")) headers.push_back(file.substr(std::string("include/").size()));
    }
    return headers;
}

}  // namespace clv::test
#endif
