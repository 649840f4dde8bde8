#include "benchmarks/report/provenance.h"

#include <ctime>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "benchmarks/report/checksum.h"
#include "commit.h"

namespace clv {
namespace {

// As Linux calls it; empty elsewhere.
std::string processorName() {
    std::ifstream input("/proc/cpuinfo");
    for (std::string line; std::getline(input, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "";
}

}  // namespace

std::string programChecksum() {
    std::ifstream input("/proc/self/exe", std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(input), {}};
    Checksum sum;
    sum.add(bytes);
    return fmt::format("{:016x}", sum.value());
}

nlohmann::ordered_json provenance() {
    return {{"commit", kCommit},
            {"compiler", __VERSION__},
            {"processor", processorName()},
            {"hardware_threads", std::thread::hardware_concurrency()},
            {"date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace clv
