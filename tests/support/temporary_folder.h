// A folder of its own for each test, removed at its end.
#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace clv {

class TemporaryFolder : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string("clv_") + info->test_suite_name() + "_" + info->name();
        std::ranges::replace(name, '/', '_');
        folder_ = std::filesystem::path(::testing::TempDir()) / name;
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(file(name), std::ios::binary) << text;
        return file(name);
    }
    static std::string read(const std::string& path) {
        std::ifstream input(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(input), {}};
    }
    // Names of what lies in the folder, hidden files included, sorted.
    std::vector<std::string> listing(const std::string& name = ".") const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_ / name)) names.push_back(entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }

    std::filesystem::path folder_;
};

}  // namespace clv
