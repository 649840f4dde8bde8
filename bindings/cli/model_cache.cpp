#include "bindings/cli/model_cache.h"

#include <cstdlib>
#include <fstream>

#include "benchmarks/report/provenance.h"
#include "bindings/cli/staged_output.h"
#include "bindings/cli/write_text.h"

namespace clv {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostModels = 16;

nlohmann::json readModels(const fs::path& file) {
    std::ifstream input(file, std::ios::binary);
    const nlohmann::json kept = nlohmann::json::parse(input, nullptr, false);
    return kept.is_array() ? kept : nlohmann::json::array();
}

bool hasKey(const nlohmann::json& one, const nlohmann::json& key) { return one.is_object() && one.contains("key") && one.at("key") == key; }

}  // namespace

fs::path userCacheFolder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && *cache) return fs::path(cache) / "clv";
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".cache" / "clv" : fs::path();
}

nlohmann::json modelKey(int threads, double readers) {
    const nlohmann::json machine = provenance();
    return {{"program", programChecksum()},
            {"processor", machine.at("processor")},
            {"hardware_threads", machine.at("hardware_threads")},
            {"threads", threads},
            {"readers", readers}};
}

std::optional<CostModel> ModelCache::find(const nlohmann::json& key) const {
    for (const nlohmann::json& one : readModels(file_)) {
        try {
            if (hasKey(one, key)) return CostModel::fromJson(one.at("model"));
        } catch (const nlohmann::json::exception&) {
            return {};
        }
    }
    return {};
}

void ModelCache::keep(const nlohmann::json& key, const CostModel& model) const {
    if (file_.empty()) return;
    nlohmann::json kept = nlohmann::json::array();
    for (const nlohmann::json& one : readModels(file_)) {
        if (!hasKey(one, key)) kept.push_back(one);
    }
    kept.push_back({{"key", key}, {"model", model.toJson()}});
    if (kept.size() > kMostModels) kept.erase(kept.begin());
    fs::create_directories(file_.parent_path());
    StagedFile output(file_);
    writeText(output.path(), kept.dump(2) + "\n");
    output.commit();
}

}  // namespace clv
