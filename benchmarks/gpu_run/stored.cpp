#include "benchmarks/gpu_run/stored.h"

#include <fstream>
#include <stdexcept>
#include <type_traits>

namespace clv {
namespace {

// What files begin with.
const std::string kSceneTag = "clv scene, version 1\n", kCaseTag = "clv case, version 1\n";

// Each writes or reads one value after another; what a file holds is said once for both, by visit().
class Writer {
public:
    explicit Writer(const std::filesystem::path& file) : file_(file), stream_(file, std::ios::binary) {}

    template <class T>
    void operator()(const T& value) requires std::is_trivially_copyable_v<T> { bytes(&value, sizeof value); }
    void operator()(const std::string& text) { all(text); }
    template <class T>
    void operator()(const std::vector<T>& items) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            all(items);
        } else {
            (*this)(std::uint64_t(items.size()));
            for (const T& item : items) visit(*this, item);
        }
    }
    void close() {
        stream_.close();
        if (!stream_) throw std::runtime_error("cannot write " + file_.string());
    }

private:
    template <class Items>
    void all(const Items& items) {
        (*this)(std::uint64_t(items.size()));
        bytes(items.data(), items.size() * sizeof(items[0]));
    }
    void bytes(const void* from, std::size_t count) { stream_.write(static_cast<const char*>(from), std::streamsize(count)); }

    std::filesystem::path file_;
    std::ofstream stream_;
};

class Reader {
public:
    explicit Reader(const std::filesystem::path& file) : file_(file), stream_(file, std::ios::binary) {
        std::error_code failed;
        const auto size = std::filesystem::file_size(file, failed);
        if (failed) throw std::runtime_error("cannot read " + file.string());
        left_ = size;
    }

    template <class T>
    void operator()(T& value) requires std::is_trivially_copyable_v<T> { bytes(&value, sizeof value); }
    void operator()(std::string& text) { all(text); }
    template <class T>
    void operator()(std::vector<T>& items) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            all(items);
        } else {
            items.resize(count(1));
            for (T& item : items) visit(*this, item);
        }
    }
    [[noreturn]] void fail() const { throw std::runtime_error(file_.string() + " was not written by this version of clv_gpu_store"); }

private:
    // Of items that take at least `size` bytes each.
    std::size_t count(std::size_t size) {
        std::uint64_t number = 0;
        (*this)(number);
        if (number > left_ / size) fail();
        return std::size_t(number);
    }
    template <class Items>
    void all(Items& items) {
        items.resize(count(sizeof(items[0])));
        bytes(items.data(), items.size() * sizeof(items[0]));
    }
    void bytes(void* to, std::size_t count) {
        if (count > left_ || !stream_.read(static_cast<char*>(to), std::streamsize(count))) fail();
        left_ -= count;
    }

    std::filesystem::path file_;
    std::ifstream stream_;
    std::uint64_t left_ = 0;
};

// `Value` is const where it is written.
template <class Archive, class Value>
    requires std::is_same_v<std::remove_const_t<Value>, std::string>
void visit(Archive& archive, Value& text) { archive(text); }

template <class Archive, class Value>
    requires std::is_same_v<std::remove_const_t<Value>, StoredScene>
void visit(Archive& archive, Value& s) {
    archive(s.name), archive(s.boxes), archive(s.children), archive(s.triangles), archive(s.surfaces), archive(s.lights);
    archive(s.boundsLo), archive(s.boundsHi), archive(s.originOffset), archive(s.camera);
}

template <class Archive, class Value>
    requires std::is_same_v<std::remove_const_t<Value>, LightFrameSettings>
void visit(Archive& archive, Value& s) {
    archive(s.lights), archive(s.rsmSide), archive(s.triangles), archive(s.bvhNodes), archive(s.textureTexels), archive(s.mapFaces), archive(s.faceSide);
    archive(s.rays), archive(s.receivers), archive(s.halves), archive(s.storage), archive(s.channels), archive(s.turned), archive(s.rule);
    archive(s.guideCells), archive(s.guideRows), archive(s.movingLights), archive(s.trace), archive(s.accelerationBytes), archive(s.keepHits), archive(s.picture), archive(s.inject), archive(s.sliceFormat), archive(s.levels);
}

template <class Archive, class Value>
    requires std::is_same_v<std::remove_const_t<Value>, StoredBuffer>
void visit(Archive& archive, Value& b) { archive(b.name), archive(b.bytes); }

template <class Archive, class Value>
    requires std::is_same_v<std::remove_const_t<Value>, StoredCheck>
void visit(Archive& archive, Value& c) { archive(c.buffer), archive(c.expected), archive(c.bounds), archive(c.exceptions), archive(c.largestRmse); }

template <class Archive, class Value>
    requires std::is_same_v<std::remove_const_t<Value>, StoredCase>
void visit(Archive& archive, Value& c) {
    archive(c.name), visit(archive, c.settings), archive(c.steps), archive(c.buffers), archive(c.checks);
}

template <class T>
void write(const std::filesystem::path& file, const std::string& tag, const T& value) {
    Writer writer(file);
    writer(tag);
    visit(writer, value);
    writer.close();
}

template <class T>
T read(const std::filesystem::path& file, const std::string& tag) {
    Reader reader(file);
    std::string found;
    reader(found);
    if (found != tag) reader.fail();
    T value;
    visit(reader, value);
    return value;
}

}  // namespace

void writeStored(const std::filesystem::path& file, const StoredScene& scene) { write(file, kSceneTag, scene); }
void writeStored(const std::filesystem::path& file, const StoredCase& stored) { write(file, kCaseTag, stored); }
StoredScene readStoredScene(const std::filesystem::path& file) { return read<StoredScene>(file, kSceneTag); }
StoredCase readStoredCase(const std::filesystem::path& file) { return read<StoredCase>(file, kCaseTag); }

}  // namespace clv
