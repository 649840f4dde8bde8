// The part of VTK's XML image files that holds a cascade: named arrays, raw and uncompressed, behind the XML.
#pragma once
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <vtkSmartPointer.h>

class vtkXMLDataElement;
class vtkXMLDataParser;

namespace clv {

// The XML of a file of this type ("ImageData", ...), checked. The root element lives as long as the parser. Throws InputError.
vtkSmartPointer<vtkXMLDataParser> parseVtkXml(const std::string& file, const std::string& type);

// Reads arrays by name. Every member throws InputError where the file does not hold what is asked for; nothing is allocated that
// the file is too short for.
class VtiFile {
public:
    explicit VtiFile(const std::string& file);

    // A string of the field data.
    std::string text(const std::string& name);
    bool has(const std::string& name) const { return find("FieldData", name) != nullptr; }
    // Tuples of an array of the field data.
    std::size_t tuples(const std::string& name) const;
    // Field data; of tuples(name) times `components` values.
    std::vector<float> floats(const std::string& name, int components) { return read<float>("FieldData", name, components, tuples(name)); }
    std::vector<std::uint32_t> uints(const std::string& name, int components) { return read<std::uint32_t>("FieldData", name, components, tuples(name)); }
    // Cell data, one value a cell.
    std::vector<std::uint32_t> cellUints(const std::string& name, std::size_t cells) { return read<std::uint32_t>("CellData", name, 1, cells); }
    [[noreturn]] void fail(const std::string& what) const;

private:
    vtkXMLDataElement* find(const char* section, const std::string& name) const;
    template <class Value>
    std::vector<Value> read(const char* section, const std::string& name, int components, std::size_t tuples);
    std::uint64_t seek(const std::string& name, vtkXMLDataElement& array);

    std::string file_;
    vtkSmartPointer<vtkXMLDataParser> parser_;
    std::ifstream data_;
    std::uint64_t dataBegin_ = 0, fileBytes_ = 0;
};

}  // namespace clv
