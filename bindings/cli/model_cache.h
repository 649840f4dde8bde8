// Cost models of machines, kept between runs.
#pragma once
#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "benchmarks/report/cost_model.h"

namespace clv {

// As the XDG base directory specification has it; empty where there is no home.
std::filesystem::path userCacheFolder();

// All that measurements of a model depend on: this program, this machine, the threads, and the readers whose lookups are in the times.
nlohmann::json modelKey(int threads, double readers);

// Models in cost_model.json of a folder, the latest few, a key each. Without a folder nothing is found, and nothing kept.
class ModelCache {
public:
    explicit ModelCache(const std::filesystem::path& folder) : file_(folder.empty() ? folder : folder / "cost_model.json") {}

    // Nothing where the file is missing or damaged: the model is then made anew.
    std::optional<CostModel> find(const nlohmann::json& key) const;
    // Throws std::runtime_error where it cannot be written.
    void keep(const nlohmann::json& key, const CostModel& model) const;

private:
    std::filesystem::path file_;
};

}  // namespace clv
