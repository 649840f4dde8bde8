#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLImageDataWriter.h>

#include "bindings/volume_file/sealed_file.h"
#include "bindings/volume_file/volume_arrays.h"
#include "bindings/volume_file/volume_file.h"
#include "bindings/volume_file/volume_text.h"

namespace clv {
namespace {

// An array of so many tuples, whose numbers the caller sets.
template <class Array>
vtkSmartPointer<Array> addArray(vtkFieldData& to, const std::string& name, const char* unit, int components, std::size_t tuples) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(vtkIdType(tuples));
    if (*unit) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
    to.AddArray(array);
    return array;
}

vtkSmartPointer<vtkFloatArray> addFloats(vtkFieldData& to, const std::string& name, const char* unit, int components, std::size_t tuples) {
    return addArray<vtkFloatArray>(to, name, unit, components, tuples);
}
vtkSmartPointer<vtkUnsignedIntArray> addUints(vtkFieldData& to, const std::string& name, int components, std::size_t tuples) {
    return addArray<vtkUnsignedIntArray>(to, name, "", components, tuples);
}

void nameSides(vtkFloatArray& array) {
    for (std::size_t side = 0; side < kSides; ++side) array.SetComponentName(vtkIdType(side), kSideNames[side]);
}

void addText(vtkFieldData& to, const char* name, const std::string& text) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    to.AddArray(array);
}

// What people look at.
void addCells(vtkFieldData& to, const BakedVolume& volume, std::size_t index) {
    const BakedCascade& cascade = volume.cascades[index];
    const std::size_t cells = cascade.level.cellCount();
    std::array<vtkSmartPointer<vtkFloatArray>, kSides> irradiance;
    for (std::size_t side = 0; side < kSides; ++side) irradiance[side] = addFloats(to, arrays::kIrradiance + kSideNames[side], "W/m^2", 3, cells);
    const bool estimated = cascade.estimates.size() > 1, moving = !cascade.dynamicity.empty();
    const auto variance = estimated ? addFloats(to, arrays::kVariance, "(W/m^2)^2", kSides, cells) : nullptr;
    const auto dynamicity = moving ? addFloats(to, arrays::kDynamicity, "1", kSides, cells) : nullptr;
    if (variance) nameSides(*variance);
    if (dynamicity) nameSides(*dynamicity);
    const auto samples = addFloats(to, arrays::kSamples, "rays", 1, cells);
    const auto openVolume = addFloats(to, arrays::kOpenVolume, "m^3", 1, cells);
    const auto level = addUints(to, arrays::kLevel, 1, cells);
    const auto entry = addUints(to, arrays::kEntry, 1, cells);
    for (std::size_t i = 0; i < cells; ++i) {
        const CellLight light = cellLight(volume, cascade, i);
        for (std::size_t side = 0; side < kSides; ++side) irradiance[side]->SetTypedTuple(vtkIdType(i), &light.irradiance[side].x);
        if (variance) variance->SetTypedTuple(vtkIdType(i), light.variance.data());
        if (dynamicity) dynamicity->SetTypedTuple(vtkIdType(i), light.dynamicity.data());
        samples->SetValue(vtkIdType(i), light.samples);
        openVolume->SetValue(vtkIdType(i), light.openVolume);
        level->SetValue(vtkIdType(i), uint(index));
        entry->SetValue(vtkIdType(i), cascade.level.table[i]);
    }
}

// What the library reads.
void addSlots(vtkFieldData& to, const BakedVolume& volume, const BakedCascade& cascade) {
    const Level& level = cascade.level;
    const std::size_t slots = level.slots.size();
    const auto centroid = addFloats(to, arrays::kSlotCentroid, "m", 3, slots);
    const auto openVolume = addFloats(to, arrays::kSlotVolume, "m^3", 1, slots);
    const auto visible = addUints(to, arrays::kSlotVisible, 4, slots);
    const auto cell = addUints(to, arrays::kSlotCell, 1, slots);
    const auto samples = addFloats(to, arrays::kSlotSamples, "rays", 1, slots);
    for (std::size_t s = 0; s < slots; ++s) {
        centroid->SetTypedTuple(vtkIdType(s), &level.slots[s].openCentroid.x);
        openVolume->SetValue(vtkIdType(s), level.slots[s].openVolume);
        visible->SetTypedTuple(vtkIdType(s), &level.slots[s].visible.x);
        cell->SetValue(vtkIdType(s), level.slots[s].cell);
        samples->SetValue(vtkIdType(s), cascade.samples[s]);
    }
    if (!cascade.dynamicity.empty()) {
        const auto dynamicity = addFloats(to, arrays::kSlotDynamicity, "1", kSides, slots);
        nameSides(*dynamicity);
        for (std::size_t s = 0; s < slots; ++s) dynamicity->SetTypedTuple(vtkIdType(s), &cascade.dynamicity[s * kSides]);
    }
    const int values = volume.layout.values(), stride = volume.layout.stride();
    for (std::size_t i = 0; i < cascade.estimates.size(); ++i) {
        const auto deposits = addFloats(to, arrays::kSlotDeposits + std::to_string(i), "W m", values, slots);
        for (std::size_t s = 0; s < slots; ++s) deposits->SetTypedTuple(vtkIdType(s), &cascade.estimates[i][s * std::size_t(stride)]);
    }
    const auto plane = addFloats(to, arrays::kSplitPlane, "m", 4, level.splits.size());
    const auto links = addUints(to, arrays::kSplitLinks, 4, level.splits.size());
    for (std::size_t k = 0; k < level.splits.size(); ++k) {
        const ClvSplit& split = level.splits[k];
        plane->SetTypedTuple(vtkIdType(k), &split.plane.x);
        const uint linked[4] = {split.front, split.back, split.firstSlot, split.slotCount};
        links->SetTypedTuple(vtkIdType(k), linked);
    }
}

void writeCascade(const std::string& path, const BakedVolume& volume, std::size_t index, const std::string& about) {
    const ClvVolume& grid = volume.cascades[index].level.volume;
    vtkNew<vtkImageData> image;
    image->SetDimensions(grid.resolution.x + 1, grid.resolution.y + 1, grid.resolution.z + 1);
    const glm::dvec3 origin = volume.anchor + glm::dvec3(grid.origin);
    image->SetOrigin(origin.x, origin.y, origin.z);
    image->SetSpacing(grid.cellSize, grid.cellSize, grid.cellSize);
    addCells(*image->GetCellData(), volume, index);
    vtkFieldData& field = *image->GetFieldData();
    addText(field, arrays::kAbout, about);
    addText(field, arrays::kGrid, describeGrid(grid, index).dump());
    addSlots(field, volume, volume.cascades[index]);

    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(image);
    // Raw and uncompressed: it opens as fast as the disk gives it, and the XML says how large every array is.
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    writer->SetHeaderTypeToUInt64();
    // What goes wrong is said once, below.
    vtkNew<vtkCallbackCommand> silent;
    for (vtkObject* speaker : {static_cast<vtkObject*>(writer), static_cast<vtkObject*>(writer->GetExecutive())}) speaker->AddObserver(vtkCommand::ErrorEvent, silent);
    if (!writer->Write() || writer->GetErrorCode() != 0) throw std::runtime_error(fmt::format("{}: cannot be written; expected room for it", path));
    sealFile(path);
}

void writeText(const std::string& path, const std::string& text) {
    std::ofstream out(path, std::ios::binary);
    out << text << std::flush;
    if (!out) throw std::runtime_error(fmt::format("{}: cannot be written; expected room for it", path));
    out.close();
    sealFile(path);
}

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&') safe += "&amp;";
        else if (c == '<') safe += "&lt;";
        else if (c == '"') safe += "&quot;";
        else safe += c;
    }
    return safe;
}

}  // namespace

void writeVolume(const std::string& vtm, const BakedVolume& volume, const PathOfName& pathOf) {
    const nlohmann::ordered_json description = describeVolume(volume);
    const std::string about = description.dump();
    const std::filesystem::path name(vtm);
    std::string list;
    for (std::size_t i = 0; i < volume.cascades.size(); ++i) {
        const std::string piece = fmt::format("{}/cascade_{}.vti", name.stem().string(), i);
        writeCascade(pathOf((name.parent_path() / piece).string()), volume, i, about);
        list += fmt::format("    <DataSet index=\"{0}\" name=\"cascade {0}\" file=\"{1}\"/>\n", i, escaped(piece));
    }
    writeText(pathOf(vtm), fmt::format("<?xml version=\"1.0\"?>\n"
                                       "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
                                       "  <vtkMultiBlockDataSet content=\"{}\">\n{}  </vtkMultiBlockDataSet>\n</VTKFile>",
                                       description["content"].get<std::string>(), list));
}

void writeSeries(const std::string& pvd, std::span<const SeriesStep> steps, const PathOfName& pathOf) {
    std::string list;
    for (const SeriesStep& step : steps) list += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", step.time, escaped(step.vtm));
    writeText(pathOf(pvd), fmt::format("<?xml version=\"1.0\"?>\n"
                                       "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                                       "  <Collection>\n{}  </Collection>\n</VTKFile>",
                                       list));
}

}  // namespace clv
