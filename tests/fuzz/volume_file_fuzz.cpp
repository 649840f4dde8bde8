// A volume file is read, or refused in one line that names it; what is read can be lit with. The first byte says which of its files the others
// are, without their checksum, which is put right so that what lies behind it is tried.
#include "bindings/volume_file/sealed_file.h"
#include "bindings/volume_file/volume_file.h"
#include "clv/math/finite.h"
#include "fuzz/bytes.h"
#include "support/small_volume.h"

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace clv;
using namespace clv::test;

namespace {

// A folder that holds a sound volume, and its files as they were.
class VolumeFolder {
public:
    VolumeFolder() : folder_(std::filesystem::temp_directory_path() / ("clv-fuzz-volume-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_ / "V");
        writeVolume("V.vtm", smallVolume(), [this](const std::string& name) { return path(name); });
        std::filesystem::copy_file(path("V.vtm"), path("sound.vtm"), std::filesystem::copy_options::overwrite_existing);
        std::filesystem::copy_file(path("V/cascade_0.vti"), path("sound.vti"), std::filesystem::copy_options::overwrite_existing);
    }
    ~VolumeFolder() { std::filesystem::remove_all(folder_); }
    VolumeFolder(const VolumeFolder&) = delete;
    VolumeFolder& operator=(const VolumeFolder&) = delete;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void seal(const std::string& name, std::span<const std::uint8_t> bytes) const {
        std::ofstream(path(name), std::ios::binary | std::ios::trunc).write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        sealFile(path(name));
    }
    void restore(const std::string& name, const std::string& sound) const {
        std::filesystem::copy_file(path(sound), path(name), std::filesystem::copy_options::overwrite_existing);
    }

private:
    std::filesystem::path folder_;
};

void readIt(const BakedVolume& volume) {
    for (int k = 0; k < 8; ++k) {
        const ClvVolume& grid = volume.cascades[0].level.volume;
        const vec3 position = grid.origin + grid.cellSize * vec3(grid.resolution) * vec3(float(k & 1), float(k >> 1 & 1), float(k >> 2));
        const vec3 e = irradianceAt(volume, {position, 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
        require(clvIsFinite(e) && e.x >= 0.0f && e.y >= 0.0f && e.z >= 0.0f, "irradiance is finite and not negative");
    }
    for (const BakedCascade& cascade : volume.cascades) {
        for (std::size_t cell = 0; cell < std::min<std::size_t>(cascade.level.cellCount(), 64); ++cell) {
            const CellLight light = cellLight(volume, cascade, cell);
            for (std::size_t side = 0; side < kSides; ++side) require(clvIsFinite(light.irradiance[side]) && clvIsFinite(light.variance[side]), "a cell's light is finite");
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const VolumeFolder folder;
    if (size == 0) return 0;
    const std::span<const std::uint8_t> bytes(data + 1, size - 1);
    try {
        if (data[0] % 3 == 2) {
            folder.seal("S.pvd", bytes);
            for (const SeriesStep& step : readSeries(folder.path("S.pvd"))) require(clvIsFinite(float(step.time)) || step.time != 0.0, "a step has a time");
        } else {
            if (data[0] % 3 == 0) folder.restore("V.vtm", "sound.vtm"), folder.seal("V/cascade_0.vti", bytes);
            else folder.restore("V/cascade_0.vti", "sound.vti"), folder.seal("V.vtm", bytes);
            readIt(readVolume(folder.path("V.vtm")));
        }
    } catch (const InputError& error) {
        require(std::string(error.what()).find(folder.path("").c_str()) == 0, "an error names the file");
        require(std::string(error.what()).find('\n') == std::string::npos, "in one line");
    }
    return 0;
}
