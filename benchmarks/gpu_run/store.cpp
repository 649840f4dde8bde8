// clv_gpu_store DIR: writes what clv_gpu_run reads there: scenes to time, and cases with the CPU's results.
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>

#include "benchmarks/gpu_run/stored.h"
#include "benchmarks/gpu_run/stored_cases.h"

namespace {

void store(const std::filesystem::path& folder) {
    for (const char* part : {"scenes", "cases"}) std::filesystem::create_directories(folder / part);
    for (const char* name : {"cornell", "two_rooms", "atrium"}) clv::writeStored(folder / "scenes" / (std::string(name) + ".scene"), clv::storedScene(name));
    for (const clv::StoredCase& stored : clv::storedCases()) clv::writeStored(folder / "cases" / (stored.name + ".case"), stored);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2 || std::strncmp(arguments[1], "--", 2) == 0) {
        std::fprintf(stderr, "Usage: clv_gpu_store DIR\n");
        return 2;
    }
    try {
        store(arguments[1]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "clv_gpu_store: %s\n", error.what());
        return 1;
    }
}
