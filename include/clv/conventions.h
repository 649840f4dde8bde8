// Conventions of the whole library, written once. Comments only.
#ifndef CLV_CONVENTIONS_H
#define CLV_CONVENTIONS_H

// Axes. Right-handed, Y up, a camera looks along -Z, as in glTF. data/engine_space.h converts from other engines' axes and
// depth buffers.
//
// Units. Metres, seconds, radians. Linear RGB, no gamma. Radiometric:
//   flux        W            what a ray and an RSM texel carry
//   irradiance  W/m^2        what a surface receives, what `evaluate` returns
//   radiance    W/(m^2 sr)   what a camera sees: albedo * irradiance / pi for a Lambertian surface
//   intensity   W/sr         of point and spot lights; W/m^2 for directional lights, on a plane that faces them
// A quantity is called by its name, never light or colour.
//
// Directions. Of unit length unless said otherwise. A ray's direction is the way the light travels; a normal points away
// from the surface, to the side in question. Every face is opaque and reflects on both sides.
//
// Spaces. World: doubles, kept by the host. The core's positions are floats relative to an *anchor*, a world position near
// the camera that the host keeps in double; moving it means to translate whatever is kept in core space. Lattice: 64-bit
// integers that number the cells of the world, cell c covers [c, c + 1) * cellSize. Cell: integers relative to the
// volume's lowest cell. Storage: integers in [0, resolution), cell plus scroll, wrapped around.
// Functions are named result-from-source: clvCellFromPosition(volume, position).
//
// Random numbers. A function of (index, dimension, seed); there is no state. Frames go on counting the index where the last
// one stopped.
//
// Bad numbers. Functions of math/, data/ and stages/ are total: finite input gives finite output, and where a non-finite input
// has a meaning, the function's comment says it. Host descriptors have validate(), which says in words what is wrong.
//
// Threads. Nothing in the library has globals or hidden state. Functions of math/, data/, stages/ and plan/ are pure: call
// them from any thread. Functions of cpu/ that take a ParallelFor call it from the thread that called them; two of them may run
// at once as long as they write different objects. Objects may be read from many threads while nobody writes them.
//
// Languages. math/, data/ and stages/ are one text in C++20 (with GLM), GLSL 4.50 and HLSL 5; lang.h alone knows which. What
// they share is called ClvXxx, clvXxx and kClvXxx, and in C++ lies in namespace clv. plan/ and cpu/ are C++ alone.

#endif
