#include "bindings/volume_file/vti_file.h"

#include <filesystem>

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include "bindings/scene/scene.h"

namespace clv {
namespace {

void keepMessage(vtkObject*, unsigned long, void* kept, void* message) {
    std::string& text = *static_cast<std::string*>(kept);
    if (text.empty()) text = static_cast<const char*>(message);
}

std::string attribute(vtkXMLDataElement& element, const char* name) {
    const char* value = element.GetAttribute(name);
    return value ? value : "";
}

template <class Value>
constexpr const char* kTypeName = std::is_same_v<Value, float> ? "Float32" : "UInt32";

}  // namespace

vtkSmartPointer<vtkXMLDataParser> parseVtkXml(const std::string& file, const std::string& type) {
    auto parser = vtkSmartPointer<vtkXMLDataParser>::New();
    // With somebody to hear them, errors are not printed.
    std::string problem;
    vtkNew<vtkCallbackCommand> hear;
    hear->SetCallback(keepMessage);
    hear->SetClientData(&problem);
    parser->AddObserver(vtkCommand::ErrorEvent, hear);
    parser->SetFileName(file.c_str());
    const bool parsed = parser->Parse() && parser->GetRootElement();
    parser->RemoveObserver(hear);
    if (!parsed || !problem.empty()) throw InputError(fmt::format("{}: expected the XML of a VTK file", file));
    vtkXMLDataElement& root = *parser->GetRootElement();
    if (attribute(root, "type") != type) throw InputError(fmt::format("{}: expected a VTK file of type {}", file, type));
    return parser;
}

VtiFile::VtiFile(const std::string& file) : file_(file), parser_(parseVtkXml(file, "ImageData")), data_(file, std::ios::binary) {
    vtkXMLDataElement& root = *parser_->GetRootElement();
    if (attribute(root, "byte_order") != "LittleEndian" || attribute(root, "header_type") != "UInt64" || root.GetAttribute("compressor"))
        fail("expected little-endian data without compression, with headers of type UInt64");
    vtkXMLDataElement* appended = root.FindNestedElementWithName("AppendedData");
    if (!appended || attribute(*appended, "encoding") != "raw") fail("expected raw appended data");
    dataBegin_ = std::uint64_t(parser_->GetAppendedDataPosition());
    fileBytes_ = std::filesystem::file_size(file);
}

void VtiFile::fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", file_, what));
}

vtkXMLDataElement* VtiFile::find(const char* section, const std::string& name) const {
    vtkXMLDataElement* image = parser_->GetRootElement()->FindNestedElementWithName("ImageData");
    vtkXMLDataElement* holder = image && section == std::string("CellData") ? image->FindNestedElementWithName("Piece") : image;
    vtkXMLDataElement* arrays = holder ? holder->FindNestedElementWithName(section) : nullptr;
    for (int i = 0; arrays && i < arrays->GetNumberOfNestedElements(); ++i) {
        if (attribute(*arrays->GetNestedElement(i), "Name") == name) return arrays->GetNestedElement(i);
    }
    return nullptr;
}

std::size_t VtiFile::tuples(const std::string& name) const {
    vtkXMLDataElement* array = find("FieldData", name);
    vtkTypeInt64 count = -1;
    if (!array) fail(fmt::format("expected an array '{}'", name));
    if (!array->GetScalarAttribute("NumberOfTuples", count) || count < 0) fail(fmt::format("array '{}': expected a number of tuples", name));
    return std::size_t(count);
}

// Goes to the numbers of an array and returns how many bytes there are.
std::uint64_t VtiFile::seek(const std::string& name, vtkXMLDataElement& array) {
    vtkTypeInt64 offset = -1;
    std::uint64_t bytes = 0;
    const bool appended = attribute(array, "format") == "appended" && array.GetScalarAttribute("offset", offset) && offset >= 0;
    const std::uint64_t left = fileBytes_ - dataBegin_;
    if (!appended || std::uint64_t(offset) >= left) fail(fmt::format("array '{}': expected its place in the appended data", name));
    data_.clear();
    data_.seekg(std::streamoff(dataBegin_ + std::uint64_t(offset)));
    data_.read(reinterpret_cast<char*>(&bytes), sizeof bytes);
    if (!data_ || bytes > left - std::uint64_t(offset)) fail(fmt::format("array '{}': expected more bytes than the file has", name));
    return bytes;
}

std::string VtiFile::text(const std::string& name) {
    vtkXMLDataElement* array = find("FieldData", name);
    if (!array || attribute(*array, "type") != "String") fail(fmt::format("expected a string '{}'", name));
    std::string text(seek(name, *array), '\0');
    if (!data_.read(text.data(), std::streamsize(text.size()))) fail(fmt::format("string '{}': expected all of it", name));
    return text.c_str();
}

template <class Value>
std::vector<Value> VtiFile::read(const char* section, const std::string& name, int components, std::size_t tuples) {
    vtkXMLDataElement* array = find(section, name);
    if (!array) fail(fmt::format("expected an array '{}'", name));
    vtkTypeInt64 given = 1;
    array->GetScalarAttribute("NumberOfComponents", given);
    const bool asExpected = attribute(*array, "type") == kTypeName<Value> && given == components;
    if (!asExpected) fail(fmt::format("array '{}': expected {} of {} components", name, kTypeName<Value>, components));
    const std::uint64_t bytes = seek(name, *array), tuple = std::uint64_t(components) * sizeof(Value);
    if (bytes % tuple != 0 || bytes / tuple != tuples) fail(fmt::format("array '{}': expected {} tuples", name, tuples));
    std::vector<Value> values(bytes / sizeof(Value));
    if (!data_.read(reinterpret_cast<char*>(values.data()), std::streamsize(bytes))) fail(fmt::format("array '{}': expected all of it", name));
    return values;
}

template std::vector<float> VtiFile::read(const char*, const std::string&, int, std::size_t);
template std::vector<std::uint32_t> VtiFile::read(const char*, const std::string&, int, std::size_t);

}  // namespace clv
