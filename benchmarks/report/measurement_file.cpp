#include "benchmarks/report/measurement_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "bindings/scene/scene.h"

namespace clv {

MeasurementFile::MeasurementFile(const std::filesystem::path& file) : file_(file) {
    if (!std::ofstream(file_, std::ios::app)) throw InputError(fmt::format("{}: expected a file that can be written", file_.string()));
    std::ifstream input(file_, std::ios::binary);
    std::string line;
    std::uintmax_t whole = 0;
    for (int number = 1; std::getline(input, line) && !input.eof(); ++number) {
        whole += line.size() + 1;
        try {
            all_.push_back(measurementFrom(nlohmann::ordered_json::parse(line)));
        } catch (const nlohmann::json::exception&) {
            throw InputError(fmt::format("{}:{}: expected a measurement of a report; remove the file to begin anew", file_.string(), number));
        }
    }
    std::filesystem::resize_file(file_, whole);
}

const Measurement* MeasurementFile::find(const std::string& key) const {
    const auto found = std::ranges::find(all_, key, &Measurement::key);
    return found == all_.end() ? nullptr : &*found;
}

void MeasurementFile::add(const Measurement& m) {
    std::ofstream output(file_, std::ios::app | std::ios::binary);
    output << toJson(m).dump() + "\n" << std::flush;
    if (!output) throw std::runtime_error(fmt::format("{}: cannot be written", file_.string()));
    all_.push_back(m);
}

}  // namespace clv
