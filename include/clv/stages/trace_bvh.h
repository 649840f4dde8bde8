// A walk through a tree of boxes (data/bvh.h) to the nearest triangle on a ray's way: the trace stage where no engine brings its own.
//
// A shader defines, before it includes this: vec4 clvReadBvhBoxes(uint row), uvec4 clvReadBvhChildren(uint node) and
// vec4 clvReadTriangle(uint row).
#ifndef CLV_STAGES_TRACE_BVH_H
#define CLV_STAGES_TRACE_BVH_H
#include "meet_triangle.h"
CLV_NAMESPACE_BEGIN

struct ClvBoxSpans {
    vec4 enter;      // m along the ray, >= 0, a component a child
    vec4 leave;      // below `enter` where the ray misses the box
};

// No ray slips between a box's faces by rounding (Ize 2013, "Robust BVH ray traversal"): entry and exit err by half a unit in the
// last place each in a difference and a product, and by 2.5 in a division, as much as Vulkan allows.
CLV_CONST float kClvBoxSlack = 1.0f + 8.0f / 8388608.0f;

// 1 / d, large and finite where d is next to 0, so that a ray in the plane of a box's face meets the box.
CLV_FN float clvInverseOfComponent(float d) { return 1.0f / (abs(d) < 1.0f / kClvFar ? 1.0f / kClvFar : d); }

// Where the ray is inside the boxes of a node's children. inverse: 1 / direction; backward: 1 where that is negative, else 0.
CLV_READER_FN ClvBoxSpans clvSpansInBoxes(CLV_READER uint node, vec3 origin, vec3 inverse, uvec3 backward) {
    uint row = node * kClvBvhBoxRows;
    vec4 enterX = (CLV_READ clvReadBvhBoxes(row + backward.x) - origin.x) * inverse.x;
    vec4 leaveX = (CLV_READ clvReadBvhBoxes(row + 1u - backward.x) - origin.x) * inverse.x;
    vec4 enterY = (CLV_READ clvReadBvhBoxes(row + 2u + backward.y) - origin.y) * inverse.y;
    vec4 leaveY = (CLV_READ clvReadBvhBoxes(row + 3u - backward.y) - origin.y) * inverse.y;
    vec4 enterZ = (CLV_READ clvReadBvhBoxes(row + 4u + backward.z) - origin.z) * inverse.z;
    vec4 leaveZ = (CLV_READ clvReadBvhBoxes(row + 5u - backward.z) - origin.z) * inverse.z;
    ClvBoxSpans spans;
    spans.enter = max(max(enterX, enterY), max(enterZ, vec4(0.0f, 0.0f, 0.0f, 0.0f)));
    spans.leave = min(min(leaveX, leaveY), leaveZ) * kClvBoxSlack;
    return spans;
}

// The nearest triangle that the ray meets at a distance above 0 and below maxDistance (m), on either of its sides. Two triangles at
// the same distance: either. A ray that is not finite meets nothing.
//
// A step opens one node and tests one triangle, and stores to the stack whether or not a child waits there: where neighbouring rays
// run in lockstep, steps of different kinds would wait for each other, and stores under a condition are several times as slow.
CLV_READER_FN ClvBvhHit clvTraceBvh(CLV_READER vec3 origin, vec3 direction, float maxDistance) {
    vec3 inverse = vec3(clvInverseOfComponent(direction.x), clvInverseOfComponent(direction.y), clvInverseOfComponent(direction.z));
    uvec3 backward = uvec3(inverse.x < 0.0f ? 1u : 0u, inverse.y < 0.0f ? 1u : 0u, inverse.z < 0.0f ? 1u : 0u);
    ClvBvhHit best = clvNoTriangle(maxDistance);
    uint stack[kClvBvhStack];
    uint waiting = 0u;
    uint next = 0u;
    for (;;) {
        bool isLeaf = (next & kClvBvhLeafBit) != 0u;
        uint node = isLeaf ? 0u : next;
        ClvBoxSpans spans = clvSpansInBoxes(CLV_PASS_READER node, origin, inverse, backward);
        uvec4 children = CLV_READ clvReadBvhChildren(node);
        // The nearest child is next, the others wait.
        bool met = !isLeaf && spans.enter.x <= spans.leave.x && spans.enter.x < best.distance;
        float nearest = met ? spans.enter.x : kClvFar;
        uint nearestChild = met ? children.x : kClvNoChild;
        for (int k = 1; k < 4; ++k) {
            met = !isLeaf && spans.enter[k] <= spans.leave[k] && spans.enter[k] < best.distance;
            bool nearer = met && spans.enter[k] < nearest;
            uint farther = nearer ? nearestChild : children[k];
            nearest = nearer ? spans.enter[k] : nearest;
            nearestChild = nearer ? children[k] : nearestChild;
            stack[waiting] = farther;
            waiting += met && farther != kClvNoChild ? 1u : 0u;
        }
        next = isLeaf ? next : nearestChild;
        if ((next & kClvBvhLeafBit) != 0u && next != kClvNoChild) {
            best = clvMeetTriangle(CLV_PASS_READER clvBvhLeafFirst(next), origin, direction, best);
            next = clvBvhLeafRest(next);
        }
        bool done = next == kClvNoChild;
        if (done && waiting == 0u) break;
        waiting -= done ? 1u : 0u;
        next = done ? stack[waiting] : next;
    }
    return best;
}

CLV_NAMESPACE_END
#endif
