// The bytes that a fuzzer tries, as a file that readers can open.
#ifndef CLV_TESTS_FUZZ_FUZZ_FILE_H
#define CLV_TESTS_FUZZ_FUZZ_FILE_H
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include <unistd.h>

namespace clv::test {

class FuzzFile {
public:
    // extension: with its dot.
    explicit FuzzFile(const std::string& extension) : folder_(std::filesystem::temp_directory_path() / ("clv-fuzz-" + std::to_string(getpid()))), file_(folder_ / ("input" + extension)) {
        std::filesystem::create_directories(folder_);
    }
    ~FuzzFile() { std::filesystem::remove_all(folder_); }
    FuzzFile(const FuzzFile&) = delete;
    FuzzFile& operator=(const FuzzFile&) = delete;

    // The file's name, after it holds these bytes.
    std::string with(std::span<const std::uint8_t> bytes) const {
        std::ofstream(file_, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        return file_.string();
    }

private:
    std::filesystem::path folder_, file_;
};

}  // namespace clv::test
#endif
