// Output files that appear under their names complete, or not at all.
#pragma once
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace clv {

// Makes the folder where it is missing. Throws InputError.
std::filesystem::path outputFolder(const std::string& name);

// Throws InputError where `out` is one of the files that are read, which may be empty names or those of built-in scenes.
void keepInputs(const std::string& out, std::initializer_list<std::string> inputs);

// Files are written into a hidden folder inside the one where they belong, and renamed at the end. The hidden folder goes with
// the object, and on an interrupt.
class StagedOutput {
public:
    // Makes the hidden folder, so that a place that cannot be written shows before the work. Throws InputError.
    explicit StagedOutput(const std::filesystem::path& folder);
    ~StagedOutput();
    StagedOutput(const StagedOutput&) = delete;
    StagedOutput& operator=(const StagedOutput&) = delete;

    // Where to write the file that will be called `name`, which may begin with a folder of its own; a name may be asked for twice. Throws InputError where something other than a file has that name.
    std::string path(const std::string& name);
    // Gives all files their names, in the order in which they were asked for.
    void commit();

private:
    std::filesystem::path folder_, hidden_;
    std::vector<std::string> names_;
};

// A message in which staged files have the names that they were to get.
std::string withFinalNames(const std::string& message);

// The same for a single file. A symbolic link stays one.
class StagedFile {
public:
    explicit StagedFile(const std::filesystem::path& file);

    const std::string& path() const { return path_; }
    void commit() { output_.commit(); }

private:
    StagedFile(const std::filesystem::path& file, const std::filesystem::path& target);

    StagedOutput output_;
    std::string path_;
};

}  // namespace clv
