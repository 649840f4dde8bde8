// Binding numbers of descriptor set 0, the same in every pass, in GLSL, HLSL and C++: a resource has one number throughout.
// Macros, because neither shading language takes constants in its binding attributes.
#ifndef CLV_DATA_GPU_BINDINGS_H
#define CLV_DATA_GPU_BINDINGS_H

// Threads of a work group, unless a pass says otherwise.
#define CLV_GROUP_SIZE 64
// Work groups in a row of a dispatch; see clvItem.
#define CLV_GROUP_ROW 32768

// Constants: uniform buffers.
#define CLV_BIND_FRAME 0           // ClvFrame
#define CLV_BIND_LEVEL 1           // ClvLevelFrame

// The scene.
#define CLV_BIND_LIGHTS 2          // ClvLight[]
#define CLV_BIND_BVH_BOXES 3       // texel buffer, RGBA32F: see data/bvh.h
#define CLV_BIND_BVH_CHILDREN 4    // texel buffer, RGBA32UI
#define CLV_BIND_TRIANGLES 5       // texel buffer, RGBA32F
#define CLV_BIND_SURFACES 6        // texel buffer, RGBA32F: a triangle's normal and albedo

// What flows.
#define CLV_BIND_TEXELS 7          // ClvRsmTexel[texelRows * rsmSide]
#define CLV_BIND_TEXEL_SUMS 8      // float: rows of rsmSide + 1 running sums from 0 to 1, then one over all rows
#define CLV_BIND_RAYS 9            // ClvRay[rayCount]
#define CLV_BIND_HITS 10           // ClvHit[rayCount]

// A level.
#define CLV_BIND_TABLE 11          // uint[cells]
#define CLV_BIND_SPLITS 12         // ClvSplit[]
#define CLV_BIND_SLOTS 13          // ClvSlot[slotCount]
#define CLV_BIND_DEPOSITS 14       // float or int[halves * slotCount * stride]: this frame's sums
#define CLV_BIND_HISTORY 15        // float[halves * slotCount * stride]: mean deposits, W m

// Lists of the rays that cross each brick.
#define CLV_BIND_BRICK_CURSORS 16  // uint[bricks * halves + 1]: rays of a brick, then where its next ray goes; last, where the next list goes
#define CLV_BIND_BRICK_BEGINS 17   // uint[bricks * halves]: where a brick's list begins
#define CLV_BIND_BRICK_RAYS 18     // uint[]: ray indices
#define CLV_BIND_BRICK_SLOTS 19    // uint[groups * 8]: the slots of one brick that eight lanes fill, then kClvNoSlot

// Receivers.
#define CLV_BIND_RECEIVERS 20      // ClvReceiver[receiverCount]
#define CLV_BIND_LOOKUP_ENDS 21    // uint[receiverCount]: where a receiver's slots end
#define CLV_BIND_LOOKUP_SLOTS 22   // uint[]
#define CLV_BIND_LOOKUP_WEIGHTS 23 // float[], 1/m^3
#define CLV_BIND_IRRADIANCE 24     // vec4[halves * receiverCount], W/m^2

// Textures of scenes that have any.
#define CLV_BIND_TEXTURE_ROWS 25   // texel buffer, RGBA32UI: see data/surface.h
#define CLV_BIND_TEXTURE_TEXELS 26 // texel buffer, RGBA32F

// What guides the rays, where anything does.
#define CLV_BIND_GUIDE 27          // ClvVolume: the guide's grid
#define CLV_BIND_GUIDE_CELLS 28    // uint[]: the row of each of its cells
#define CLV_BIND_GUIDE_WEIGHTS 29  // float[]: see stages/ray_guide.h

// Which bricks have lists.
#define CLV_BIND_BRICK_MASK 30     // uint[]: a bit a brick, the lowest first: whether anything in it has a slot

// Reflective shadow maps that are drawn.
#define CLV_BIND_MAP_FACES 32      // ClvMapFace[faceCount]
#define CLV_BIND_FACE_TRIANGLES 33 // array, R32UI, a layer a face: 1 + index of the nearest triangle in the order of the leaves, or 0
#define CLV_BIND_FACE_DEPTHS 34    // depths of the face that is drawn

// Lines drawn into slices; a layer is a slice of a half.
#define CLV_BIND_SLICE_DRAWS 35    // uvec4[layers]: vertices, instances, first vertex, first instance
#define CLV_BIND_SLICE_RAYS 36     // uint[layers * rays of a half]: ray indices
#define CLV_BIND_SIDE_0 37         // 3D image of floats, a texel a cell: light and dynamicity of the side +x
#define CLV_BIND_SIDE_1 38         // -x
#define CLV_BIND_SIDE_2 39         // +y
#define CLV_BIND_SIDE_3 40         // -y
#define CLV_BIND_SIDE_4 41         // +z
#define CLV_BIND_SIDE_5 42         // -z

// What frames of moving lights have besides.
#define CLV_BIND_MERGE 43          // ClvMergeSettings
#define CLV_BIND_DYNAMICITY 44     // uint[halves * slotCount * 6]: this frame's largest dynamicity of each side, the bits of a float
#define CLV_BIND_KEPT_DYNAMICITY 45  // float[halves * slotCount * 6]: that of the history
#define CLV_BIND_SLOT_FRAMES 46    // float[halves * slotCount]: frames, weighed alike, that a slot's history stands for

// Pictures; what the camera sees is drawn as a face of a map is.
#define CLV_BIND_PICTURE 47        // ClvPicture
#define CLV_BIND_RADIANCE 48       // vec4[width * height], row by row from the top: W/(m^2 sr), and 1 where a surface is seen

// What ray queries walk.
#define CLV_BIND_ACCELERATION 49   // acceleration structure: the triangles in the order of CLV_BIND_TRIANGLES
#define CLV_BIND_CORNERS 50        // float[triangles * 9]: it is built from these; no shader has them

// Tests of a device.
#define CLV_BIND_WALK_CHECKS 51    // ClvWalkCheck[rayCount]

// Specialisation constants: what is fixed for a scene, so that compilers remove what it does not need.
#define CLV_SPEC_STORAGE 0         // kClvStorage...
#define CLV_SPEC_CHANNELS 1        // 3, or 1 in a scene without colour
#define CLV_SPEC_RULE 2            // kClvInject...
#define CLV_SPEC_STRIDE 3          // floats a record
#define CLV_SPEC_DEPTH 4           // splits between a cell and its slots, at most
#define CLV_SPEC_TURNED 5          // 1: cells keep directions along the axes of the frame, not those of the grid

#endif
