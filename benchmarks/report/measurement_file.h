// Measurements on disk, a line each, written as they come: an interrupted report goes on where it stopped.
#pragma once
#include <filesystem>
#include <vector>

#include "benchmarks/report/measurement.h"

namespace clv {

class MeasurementFile {
public:
    // Reads what is there, and makes the file where it is missing. A last line without its end, which an interruption leaves, is cut
    // off. Throws InputError where the file cannot be written, or where another line is no measurement.
    explicit MeasurementFile(const std::filesystem::path& file);

    // The one with this key, or nullptr; valid until the next add().
    const Measurement* find(const std::string& key) const;
    // Is on disk when this returns. Throws std::runtime_error.
    void add(const Measurement& m);

private:
    std::filesystem::path file_;
    std::vector<Measurement> all_;
};

}  // namespace clv
