// Scenes whose indirect light is known in closed form.
//
// In a closed room every surface has the albedo rho and the lamp sends out the flux Phi (W). All of it lands on the surface, of
// area A (m^2); rho Phi is reflected and lands again, and so on. Hence, exactly and whatever the shape, the area-weighted means are
//   one bounce   mean E = rho Phi / A
//   all bounces  mean E = rho / (1 - rho) Phi / A
// In a sphere the irradiance of a patch by any other is the same everywhere (its form factors are constant: both cosines equal
// distance / 2r), so that these means, with A = 4 pi r^2, are the irradiance at every point, wherever the lamp is.
#include "bindings/scene/builtin_scenes.h"
#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"

namespace clv {

// rho = 0.5, Phi = 4 pi W; A is the sum over all triangles, furniture included.
Scene makeFurnaceBox() {
    SceneBuilder builder("furnace_box");
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});

    BlockGrid room;
    room.outsideIsSolid = true;
    room.xs = {-0.53, 0.17, 0.51};
    room.ys = {-0.48, -0.11, 0.49};
    room.zs = {-0.52, -0.16, 0.54};
    room.isSolid = [](const glm::ivec3& block) { return block == glm::ivec3(1, 0, 0); };  // a cupboard in a corner
    builder.beginNode("room");
    addBlocks(builder, room, [&](const glm::ivec3&, const glm::ivec3&) { return grey; });

    // A plank in mid-air, so that something casts shadows on all sides.
    const glm::dvec3 x = glm::normalize(glm::dvec3(0.9, 0.3, 0.2)), y = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), x));
    builder.beginNode("plank");
    addBox(builder, {-0.21, -0.18, 0.13}, 0.16 * x, 0.05 * y, 0.11 * glm::cross(x, y), grey);

    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {0.07, 0.21, 0.05});
    const glm::dvec3 corner(-0.45, 0.38, 0.46);
    builder.addCamera(cameraLookingAt("corner", corner, {0.2, -0.25, -0.2}, 1.3f), corner);
    return std::move(builder).finish("furnace_box");
}

// rho = 0.8, Phi = 4 pi W, r = 1 m: one bounce E = 0.8 W/m^2, all bounces E = 4 W/m^2, in every channel. The tessellation keeps
// the area of the sphere, so that the mean is exact. With the lamp in the centre the radiance is the same in all directions too.
Scene makeWhiteSphere() {
    SceneBuilder builder("white_sphere");
    const std::uint32_t white = builder.addMaterial({"white", glm::vec3(0.8f), -1});
    builder.beginNode("sphere");
    addSphereInside(builder, 1.0, 5, white);
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {0.0, 0.0, 0.0});
    const glm::dvec3 side(-0.7, 0.1, 0.4);
    builder.addCamera(cameraLookingAt("side", side, {0.4, 0.0, -0.2}, 1.3f), side);
    return std::move(builder).finish("white_sphere");
}

}  // namespace clv
