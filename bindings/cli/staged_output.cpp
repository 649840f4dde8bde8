#include "bindings/cli/staged_output.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <regex>

#include <fmt/format.h>

#include "bindings/cli/interrupt.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace fs = std::filesystem;
namespace {

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Throws InputError for a name that no file can have, such as one that is too long.
fs::file_type typeOf(const fs::path& name) {
    std::error_code error;
    const fs::file_status status = fs::status(name, error);
    if (!fs::status_known(status)) throw InputError(fmt::format("{}: expected the name of a file: {}", name.string(), error.message()));
    return status.type();
}

// The file that a symbolic link leads to: renaming would replace the link.
fs::path behindLinks(fs::path file) {
    constexpr int kMostLinks = 40;  // in a row; more are a circle
    std::error_code error;
    for (int k = 0; k < kMostLinks && fs::is_symlink(file, error); ++k) file = file.parent_path() / fs::read_symlink(file, error);
    return file;
}

}  // namespace

fs::path outputFolder(const std::string& name) {
    std::error_code error;
    fs::create_directory(name, error);
    if (typeOf(name) != fs::file_type::directory) throw InputError(fmt::format("{}: expected a folder, or a name for a new one", name));
    return name;
}

void keepInputs(const std::string& out, std::initializer_list<std::string> inputs) {
    std::error_code none;
    for (const std::string& input : inputs) {
        if (fs::equivalent(out, input, none)) throw InputError(fmt::format("--out {}: would replace {}, which is read; expected another name", out, input));
    }
}

StagedOutput::StagedOutput(const fs::path& folder) : folder_(folder) {
    hidden_ = guardFolder([&] {
        std::string pattern = (folder / ".clv-XXXXXX").string();
        if (!mkdtemp(pattern.data()))
            throw InputError(fmt::format("{}: expected a folder that can be written: {}", folder.string(), std::strerror(errno)));
        return fs::path(pattern);
    });
}

StagedOutput::~StagedOutput() {
    std::error_code ignored;
    fs::remove_all(hidden_, ignored);
    unguardFolder(hidden_);
}

std::string withFinalNames(const std::string& message) {
    static const std::regex hidden(R"(\.clv-[0-9A-Za-z]{6}/)");
    return std::regex_replace(message, hidden, "");
}

std::string StagedOutput::path(const std::string& name) {
    const fs::path target = folder_ / name;
    const fs::path holder = folderOf(target);
    if (const fs::file_type type = typeOf(holder); type != fs::file_type::not_found && type != fs::file_type::directory)
        throw InputError(fmt::format("{}: expected a folder, or a name for a new one", holder.string()));
    withoutInterrupt([&] { fs::create_directories(folderOf(hidden_ / name)); });  // or it would come back after an interrupt has removed it
    // Renaming over a device such as /dev/null would replace it for everybody.
    if (const fs::file_type type = typeOf(target); type != fs::file_type::not_found && type != fs::file_type::regular)
        throw InputError(fmt::format("{}: expected the name of a file, but something else has that name", target.string()));
    if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
    return (hidden_ / name).string();
}

void StagedOutput::commit() {
    withoutInterrupt([&] {
        for (const std::string& name : names_) {
            fs::create_directories(folderOf(folder_ / name));
            fs::rename(hidden_ / name, folder_ / name);
        }
    });
    names_.clear();
}

StagedFile::StagedFile(const fs::path& file) : StagedFile(file, behindLinks(file)) {}

StagedFile::StagedFile(const fs::path& file, const fs::path& target) : output_(folderOf(target)) {
    if (!file.has_filename()) throw InputError(fmt::format("{}: expected the name of a file", file.string()));
    path_ = output_.path(target.filename().string());
}

}  // namespace clv
