// What is looked at, and how: everything that options, keys and the mouse change.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bindings/image/tone_map.h"
#include "viz/cells.h"

namespace clv {

enum class Subject { cubes, irradiance, dynamicity, samples, variance, open, noise, error, mesh, rays, texels };
inline constexpr int kSubjects = 11;
// Name on the command line; the subjects between cubes and error are the quantities, in their order.
std::string nameOf(Subject subject);
Subject subjectOf(const std::string& name);
std::optional<Quantity> quantityOf(Subject subject);

// What carries the colours of a quantity; surfaces: of the error alone.
enum class Carrier { cells, slices, volume, surfaces };

// A plane across an axis.
struct SlicePlane {
    int axis = 0;        // 0 to 2: across x, y or z
    double place = 0.0;  // m, world space
};

enum class RayColor { flux, dynamicity };

// W/m^2: the threshold of cells that receive any light.
inline constexpr float kAnyLight = std::numeric_limits<float>::min();

struct View {
    Subject subject = Subject::cubes;
    std::optional<Carrier> carrier;        // none: follows from the rest
    std::vector<SlicePlane> slices;
    ShownCascade cascade;
    float threshold = kAnyLight;           // W/m^2: cubes none of whose sides receives as much are left out; 0: none is
    std::optional<glm::dvec2> range;       // of the colours; none: follows from the values
    bool mesh = false, wireframe = false;  // of the scene, beside the subject
    bool indirect = true, direct = false;  // light that the mesh shows
    bool backs = false;                    // of the surfaces, too
    bool boxes = true;                     // around the cascades
    bool frustum = false, lights = false, texels = false;
    std::size_t rays = 0;
    RayColor rayColor = RayColor::flux;
    std::optional<std::pair<glm::dvec3, glm::dvec3>> probe;  // ends of a line along which the quantity is plotted, m, world space
    bool histogram = false;                // of the quantity
    LookupOptions lookup{};                // how the mesh reads the volume
    double exposure = 0.0;                 // powers of two beside what fits the view
    std::optional<Exposure> fixedExposure; // in place of both
    bool truth = false;                    // irradiance by path tracing in place of the volume's
    std::uint64_t errorSamples = 256;      // paths a point of the reference
};

// Slices where there are any, surfaces for the error, else cells, unless the view says what.
Carrier carrierOf(const View& view);
// Whether cells are drawn as cubes.
bool showsCubes(const View& view);
// Whether what is drawn takes up all of the cascades, cubes or a cloud, so that a camera among it sees little.
bool fillsSpace(const View& view);

}  // namespace clv
