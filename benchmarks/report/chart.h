// Plots with logarithmic axes, by VTK, as SVG text: no display is needed to draw them, and no font to show them.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace clv {

struct ChartSeries {
    std::vector<glm::dvec2> points;      // x, y > 0; others are left out
    glm::u8vec3 color{0};                // sRGB
    bool line = true, markers = true;
    float width = 2.0f;                  // of the line, pixels
    std::size_t marker = 0;              // index of chartMarker
    float markerSize = 8.0f;             // pixels
};

struct Chart {
    std::string title, xTitle, yTitle;
    std::vector<ChartSeries> series;     // later ones lie on top
};

// An <svg> element. A factor of ten is as long on either axis, so that slopes can be read off.
std::string svgOf(const Chart& chart, int width, int height);

// Colour number `index` of a palette whose neighbours are told apart, and the sign of marker number `index`, UTF-8. Both recur, together
// only after dozens.
glm::u8vec3 chartColor(std::size_t index);
const char* chartMarker(std::size_t index);

}  // namespace clv
