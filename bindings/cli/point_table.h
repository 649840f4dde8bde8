// Points at which irradiance is asked for, as CSV: px,py,pz,nx,ny,nz, and the values that a command adds to the right.
#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "bindings/embree/path_tracer.h"

namespace clv {

struct PointTable {
    std::vector<std::string> rows;       // the six columns as they were written, without the line's end
    std::vector<ReferencePoint> points;  // the same: positions relative to the scene's anchor, normals of unit length
};

// Reads a file with the header px,py,pz,nx,ny,nz (m, world space; normals within 1e-3 of unit length). Throws InputError.
PointTable readPointTable(const std::string& file, const glm::dvec3& anchor);

struct PointColumns {
    std::string header;                  // three column names, say E_r,E_g,E_b
    std::span<const glm::vec3> values;   // a row each
};

// Writes the rows of `table`, each followed by its values in the shortest text that reads back to the same float.
// Throws std::runtime_error.
void writePointTable(const std::string& file, const PointTable& table, std::initializer_list<PointColumns> columns);

}  // namespace clv
