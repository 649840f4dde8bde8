// A table of points is read, or refused in one line that names it; points that are read are finite, with normals of unit length.
#include "bindings/cli/point_table.h"
#include "clv/math/finite.h"
#include "fuzz/bytes.h"
#include "fuzz/fuzz_file.h"

using namespace clv;
using namespace clv::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const FuzzFile file(".csv");
    const std::string name = file.with({data, size});
    try {
        const PointTable table = readPointTable(name, glm::dvec3(1.0, 2.0, 3.0));
        require(!table.points.empty() && table.points.size() == table.rows.size(), "a row a point");
        for (const ReferencePoint& point : table.points) {
            require(clvIsFinite(point.position), "a position is finite");
            require(std::abs(glm::length(point.normal) - 1.0f) < 1e-5f, "a normal is of unit length");
        }
    } catch (const InputError& error) {
        require(std::string(error.what()).starts_with(name), "an error names the file");
    }
    return 0;
}
