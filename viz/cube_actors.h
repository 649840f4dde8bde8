// Ambient cubes as VTK draws them: many small cubes with six colours each.
#pragma once
#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace clv {

struct LitCube {
    glm::vec3 center;                 // m
    float edge;                       // m, of the cube that is drawn
    float cell;                       // m, edge of the cell that it stands for
    std::array<glm::u8vec3, 6> side;  // sRGB on +x -x +y -y +z -z
};

// One cube for the cubes of each block of 2 x 2 x 2 cells of a size, with their mean colours.
std::vector<LitCube> mergedCubes(std::span<const LitCube> cubes);

// The actors are in batches, by direction and by octant of space: VTK leaves out batches that lie out of view, and those that
// turn their backs are hidden.
class CubeActors {
public:
    // While the view turns, no more cubes than this are drawn: they are merged until they are few enough.
    static constexpr std::size_t kMostWhileTurning = 8000;

    void show(std::span<const LitCube> cubes, vtkRenderer& renderer);
    void clear(vtkRenderer& renderer);
    // Before each frame: hides what faces away from `eye`, m; `turning` picks the merged cubes.
    void prepare(const glm::vec3& eye, bool turning);

private:
    struct Batch {
        vtkSmartPointer<vtkActor> actor;
        int direction = 0;    // 0 to 5: +x -x +y -y +z -z
        float nearest = 0.0f; // m: the eye must be beyond this plane to see any of it
        bool merged = false;
    };
    void add(std::span<const LitCube> cubes, bool merged, vtkRenderer& renderer);

    std::vector<Batch> batches_;
    bool hasMerged_ = false;
};

}  // namespace clv
