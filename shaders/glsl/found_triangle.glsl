// The triangle that the graphics API has found on a ray's way.
struct FoundTriangle {
    float distance;  // m
    uint index;      // in the order of CLV_BIND_TRIANGLES; kClvNoPrimitive where there is none
    vec2 corners;    // barycentric coordinates of the second and the third corner
};
