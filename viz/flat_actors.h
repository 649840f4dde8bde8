// Faces, lines and points that show the colours they are given: VTK neither lights nor blends them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <vtkActor.h>
#include <vtkSmartPointer.h>

namespace clv {

// Four points a face, counter-clockwise where it shows; a colour (sRGB) a face. Backs are hidden where `oneSided`.
struct FlatQuads {
    std::vector<glm::vec3> points;      // m
    std::vector<glm::u8vec3> colors;
    bool oneSided = true;
};
vtkSmartPointer<vtkActor> actorOf(const FlatQuads& quads);

// A colour a point. Backs are hidden.
struct FlatTriangles {
    std::vector<glm::vec3> points;      // m
    std::vector<glm::u8vec3> colors;
    std::vector<glm::uvec3> corners;
};
vtkSmartPointer<vtkActor> actorOf(const FlatTriangles& triangles);

// Two points and a colour a line.
struct FlatLines {
    std::vector<glm::vec3> points;      // m
    std::vector<glm::u8vec3> colors;
    float width = 1.0f;                 // pixels
    bool inFront = false;               // seen through what lies before them

    void add(const glm::vec3& from, const glm::vec3& to, const glm::u8vec3& color) {
        points.insert(points.end(), {from, to});
        colors.push_back(color);
    }
};
vtkSmartPointer<vtkActor> actorOf(const FlatLines& lines);

// A colour a point.
struct FlatPoints {
    std::vector<glm::vec3> points;      // m
    std::vector<glm::u8vec3> colors;
    float size = 3.0f;                  // pixels
};
vtkSmartPointer<vtkActor> actorOf(const FlatPoints& points);

}  // namespace clv
