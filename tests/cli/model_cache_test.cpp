// Cost models are taken from the cache for the same program, machine, threads and readers alone.
#include "bindings/cli/model_cache.h"

#include <csignal>

#include <sys/resource.h>

#include "support/temporary_folder.h"

namespace {

using namespace clv;

CostModel modelOf(double growth) {
    return CostModel::fromJson({{"time_growth", growth}, {"noise_fall", -0.5}, {"seconds_factor", 1.5}, {"error_factor", 1.25}});
}

// As modelKey() has it, which reads this whole program each time.
nlohmann::json keyOf(int threads, double readers) {
    static const nlohmann::json any = modelKey(2, 3000);
    nlohmann::json key = any;
    key["threads"] = threads, key["readers"] = readers;
    return key;
}

class ModelCacheFile : public TemporaryFolder {
protected:
    // In a folder that is not there yet.
    ModelCache cache() const { return ModelCache(folder_ / "new" / "clv"); }
};

TEST_F(ModelCacheFile, keysSayAllThatTimesDependOn) {
    EXPECT_EQ(modelKey(2, 3000), modelKey(2, 3000));
    EXPECT_NE(modelKey(2, 3000), modelKey(1, 3000));
    EXPECT_NE(modelKey(2, 3000), modelKey(2, 100));
}

TEST_F(ModelCacheFile, keepsOneModelForEachKey) {
    EXPECT_FALSE(cache().find(keyOf(2, 3000)));
    cache().keep(keyOf(2, 3000), modelOf(0.1));
    cache().keep(keyOf(1, 3000), modelOf(0.2));
    cache().keep(keyOf(2, 100), modelOf(0.3));
    cache().keep(keyOf(1, 3000), modelOf(0.4));
    EXPECT_EQ(cache().find(keyOf(2, 3000))->toJson(), modelOf(0.1).toJson());
    EXPECT_EQ(cache().find(keyOf(1, 3000))->toJson(), modelOf(0.4).toJson()) << "the later one";
    EXPECT_EQ(cache().find(keyOf(2, 100))->toJson(), modelOf(0.3).toJson());
    for (const char* part : {"program", "processor", "hardware_threads"}) {
        nlohmann::json other = keyOf(2, 3000);
        other[part] = "another";
        EXPECT_FALSE(cache().find(other)) << part;
    }
}

TEST_F(ModelCacheFile, theOldestGoWhereThereAreMany) {
    for (int threads = 1; threads <= 100; ++threads) cache().keep(keyOf(threads, 3000), modelOf(0.0));
    EXPECT_FALSE(cache().find(keyOf(1, 3000)));
    EXPECT_TRUE(cache().find(keyOf(100, 3000)));
    EXPECT_TRUE(cache().find(keyOf(90, 3000)));
}

TEST_F(ModelCacheFile, whatIsDamagedIsNotThere) {
    for (const std::string text : {"", "{", "[1, {\"key\": 2}]", "{\"key\": 3}"}) {
        const ModelCache cache(folder_);
        write("cost_model.json", text);
        EXPECT_FALSE(cache.find(keyOf(2, 3000))) << text;
        cache.keep(keyOf(2, 3000), modelOf(0.1));
        EXPECT_TRUE(cache.find(keyOf(2, 3000))) << text;
    }
    nlohmann::json key = keyOf(2, 3000);
    write("cost_model.json", nlohmann::json::array({{{"key", key}, {"model", {{"time_growth", "x"}}}}}).dump());
    EXPECT_FALSE(ModelCache(folder_).find(key));
}

TEST_F(ModelCacheFile, aFullDiskIsSaidAndLeavesWhatWasThere) {
    const ModelCache cache(folder_);
    cache.keep(keyOf(2, 3000), modelOf(0.1));
    const auto onTooLarge = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{10, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_THROW(cache.keep(keyOf(1, 3000), modelOf(0.2)), std::runtime_error);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, onTooLarge);
    EXPECT_EQ(listing(), std::vector<std::string>{"cost_model.json"});
    EXPECT_TRUE(cache.find(keyOf(2, 3000)));
}

TEST(ModelCache, withoutAFolderNothingIsKept) {
    const ModelCache cache("");
    cache.keep(keyOf(2, 3000), modelOf(0.1));
    EXPECT_FALSE(cache.find(keyOf(2, 3000)));
}

}  // namespace
