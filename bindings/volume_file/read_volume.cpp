#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>

#include <fmt/format.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include "bindings/scene/json_reader.h"
#include "bindings/volume_file/level_check.h"
#include "bindings/volume_file/sealed_file.h"
#include "bindings/volume_file/volume_arrays.h"
#include "bindings/volume_file/volume_file.h"
#include "bindings/volume_file/volume_text.h"
#include "bindings/volume_file/vti_file.h"

namespace clv {
namespace fs = std::filesystem;
namespace {

// Of a file in the index's folder or below, in one line: what lies elsewhere is no part of what was written with it.
bool isBeside(const std::string& name) {
    const fs::path path(name);
    const bool isText = std::ranges::none_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    return isText && !path.empty() && path.is_relative() && std::ranges::find(path, "..") == path.end();
}

// The data sets that an index of this type lists.
std::vector<vtkXMLDataElement*> dataSets(vtkXMLDataParser& parser, const std::string& file, const char* type) {
    vtkXMLDataElement* holder = parser.GetRootElement()->FindNestedElementWithName(type);
    std::vector<vtkXMLDataElement*> sets;
    for (int i = 0; holder && i < holder->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* set = holder->GetNestedElement(i);
        if (set->GetName() != std::string("DataSet") || !set->GetAttribute("file")) throw InputError(fmt::format("{}: expected a list of data sets with their files", file));
        if (!isBeside(set->GetAttribute("file"))) throw InputError(fmt::format("{}: expected data sets whose files lie beside it, or in folders there", file));
        sets.push_back(set);
    }
    if (sets.empty()) throw InputError(fmt::format("{}: expected at least one data set", file));
    return sets;
}

void checkFinite(VtiFile& file, const std::string& name, std::span<const float> values, float atLeast, float atMost) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(values[i] >= atLeast && values[i] <= atMost)) file.fail(fmt::format("array '{}': value {}: expected a number in [{}, {}]", name, i, atLeast, atMost));
    }
}

Level readLevel(VtiFile& file, const ClvVolume& grid) {
    Level level;
    level.volume = grid;
    const std::size_t cells = std::size_t(grid.resolution.x) * std::size_t(grid.resolution.y) * std::size_t(grid.resolution.z);
    level.table = file.cellUints(arrays::kEntry, cells);
    const auto centroid = file.floats(arrays::kSlotCentroid, 3), openVolume = file.floats(arrays::kSlotVolume, 1);
    const auto visible = file.uints(arrays::kSlotVisible, 4), cell = file.uints(arrays::kSlotCell, 1);
    const std::size_t slots = openVolume.size();
    if (centroid.size() != 3 * slots || visible.size() != 4 * slots || cell.size() != slots) file.fail("expected as many tuples in all arrays of slots");
    level.slots.resize(slots);
    for (std::size_t s = 0; s < slots; ++s) {
        level.slots[s] = {{centroid[3 * s], centroid[3 * s + 1], centroid[3 * s + 2]}, openVolume[s], {visible[4 * s], visible[4 * s + 1], visible[4 * s + 2], visible[4 * s + 3]}, cell[s], 0, 0, 0};
    }
    const auto plane = file.floats(arrays::kSplitPlane, 4);
    const auto links = file.uints(arrays::kSplitLinks, 4);
    if (plane.size() != links.size()) file.fail("expected as many tuples in all arrays of splits");
    level.splits.resize(plane.size() / 4);
    for (std::size_t k = 0; k < level.splits.size(); ++k) {
        level.splits[k] = {{plane[4 * k], plane[4 * k + 1], plane[4 * k + 2], plane[4 * k + 3]}, links[4 * k], links[4 * k + 1], links[4 * k + 2], links[4 * k + 3]};
    }
    if (const std::string problem = problemOf(level); !problem.empty()) file.fail(problem);
    return level;
}

// Records as the library wants them, padded to whole vectors.
std::vector<float> readDeposits(VtiFile& file, const std::string& name, const DepositLayout& layout, std::size_t slots) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    const std::size_t values = std::size_t(layout.values()), stride = std::size_t(layout.stride());
    const std::vector<float> packed = file.floats(name, layout.values());
    if (packed.size() != values * slots) file.fail(fmt::format("array '{}': expected a tuple a slot", name));
    checkFinite(file, name, packed, -kLargest, kLargest);
    std::vector<float> records(stride * slots, 0.0f);
    for (std::size_t s = 0; s < slots; ++s) std::copy_n(packed.begin() + std::ptrdiff_t(s * values), values, records.begin() + std::ptrdiff_t(s * stride));
    return records;
}

nlohmann::json jsonOf(VtiFile& file, const std::string& name, const char* array) {
    const std::string text = file.text(array);
    return parseJson(name, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

BakedCascade readCascade(VtiFile& file, const std::string& name, const DepositLayout& layout, std::size_t index) {
    BakedCascade cascade;
    const nlohmann::json grid = jsonOf(file, name, arrays::kGrid);
    cascade.level = readLevel(file, gridFromDescription(name, grid, layout.storage));
    if (JsonReader(name, grid)["cascade"].index() != index) file.fail(fmt::format("expected cascade {} of its volume", index));
    const std::size_t slots = cascade.level.slots.size();
    cascade.samples = file.floats(arrays::kSlotSamples, 1);
    if (cascade.samples.size() != slots) file.fail(fmt::format("array '{}': expected a tuple a slot", arrays::kSlotSamples));
    checkFinite(file, arrays::kSlotSamples, cascade.samples, 0.0f, std::numeric_limits<float>::max());
    if (file.has(arrays::kSlotDynamicity)) {
        cascade.dynamicity = file.floats(arrays::kSlotDynamicity, kSides);
        if (cascade.dynamicity.size() != slots * kSides) file.fail(fmt::format("array '{}': expected a tuple a slot", arrays::kSlotDynamicity));
        checkFinite(file, arrays::kSlotDynamicity, cascade.dynamicity, 0.0f, 1.0f);
    }
    for (const char* estimate : {"0", "1"}) {
        const std::string deposits = arrays::kSlotDeposits + estimate;
        if (cascade.estimates.empty() || file.has(deposits)) cascade.estimates.push_back(readDeposits(file, deposits, layout, slots));
    }
    return cascade;
}

// One file of a volume, or why it could not be read.
struct Piece {
    nlohmann::json about;
    BakedCascade cascade;
    std::exception_ptr failure;
};

Piece readPiece(const std::string& name, std::size_t index) {
    checkSeal(name);
    VtiFile file(name);
    Piece piece;
    piece.about = jsonOf(file, name, arrays::kAbout);
    piece.cascade = readCascade(file, name, volumeFromDescription(name, piece.about).layout, index);
    return piece;
}

}  // namespace

BakedVolume readVolume(const std::string& vtm, const ParallelFor& parallelFor) {
    checkSeal(vtm);
    const auto index = parseVtkXml(vtm, "vtkMultiBlockDataSet");
    vtkXMLDataElement* blocks = index->GetRootElement()->FindNestedElementWithName("vtkMultiBlockDataSet");
    const char* content = blocks ? blocks->GetAttribute("content") : nullptr;
    std::vector<std::string> pieces;
    for (vtkXMLDataElement* set : dataSets(*index, vtm, "vtkMultiBlockDataSet")) pieces.push_back((fs::path(vtm).parent_path() / set->GetAttribute("file")).string());

    if (pieces.size() > kClvMaxCascades) throw InputError(fmt::format("{}: expected at most {} data sets, found {}", vtm, kClvMaxCascades, pieces.size()));

    std::vector<Piece> read(pieces.size());
    parallelFor(pieces.size(), [&](std::size_t i) {
        try {
            read[i] = readPiece(pieces[i], i);
        } catch (...) {
            read[i].failure = std::current_exception();
        }
    });
    BakedVolume volume;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (read[i].failure) std::rethrow_exception(read[i].failure);
        const auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", pieces[i], what)); };
        if (i == 0) {
            volume = volumeFromDescription(pieces[i], read[i].about);
            if (volume.cascades.size() != pieces.size()) throw InputError(fmt::format("{}: expected {} cascades, found {}", vtm, volume.cascades.size(), pieces.size()));
        }
        if (read[i].about != read[0].about) fail("expected a piece of the same volume as " + pieces[0]);
        volume.cascades[i] = std::move(read[i].cascade);
        const BakedCascade &first = volume.cascades[0], &next = volume.cascades[i];
        if (next.estimates.size() != first.estimates.size() || next.dynamicity.empty() != first.dynamicity.empty()) fail("expected the same arrays as in " + pieces[0]);
        if (!content) throw InputError(fmt::format("{}: expected the attribute content, which names its volume", vtm));
        if (JsonReader(pieces[i], read[0].about)["content"].text() != content) fail("expected a piece of the volume that " + vtm + " lists");
    }
    return volume;
}

std::vector<SeriesStep> readSeries(const std::string& pvd) {
    checkSeal(pvd);
    const auto index = parseVtkXml(pvd, "Collection");
    std::vector<SeriesStep> steps;
    for (vtkXMLDataElement* set : dataSets(*index, pvd, "Collection")) {
        SeriesStep step{0.0, set->GetAttribute("file")};
        if (!set->GetScalarAttribute("timestep", step.time) || !std::isfinite(step.time)) throw InputError(fmt::format("{}: {}: expected its time", pvd, step.vtm));
        steps.push_back(step);
    }
    return steps;
}

}  // namespace clv
