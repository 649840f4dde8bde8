// Inject as Brattén and Lindén (2013) did it: rays are cut at the slices of the grid, and each piece is drawn as a line into its slice.
//
// A line runs backwards, from the middle of the cell in which the piece ends to that in which it begins, so that the rasteriser, which
// leaves out the texel of a line's last point, spares the cell in which the ray starts and keeps the one in which it ends. The pieces
// behind the first one are drawn a little farther, since the cells in which they begin count too. In between the rasteriser draws one
// cell for each step along the longer axis (the diamond-exit rule), where the walk of stages/inject.h also counts the cells that a ray
// merely clips.
#ifndef CLV_STAGES_SLICES_H
#define CLV_STAGES_SLICES_H
#include "../math/finite.h"
#include "inject.h"
#include "record.h"
CLV_NAMESPACE_BEGIN

// How far before the middle of a cell lines begin and end, and how far behind it they end to draw that cell too; in cells along the
// longer axis. They keep within the cell's diamond or leave it without leaving another one; rasterisers that draw lines as
// rectangles draw the same ends.
CLV_CONST float kClvLineBefore = 0.25f;
CLV_CONST float kClvLineBehind = 0.65f;

// Texels around a slice that keep its lines from being clipped.
CLV_CONST uint kClvSliceRim = 1u;

struct ClvSlices {    // those that a ray crosses
    int first;
    int step;         // 1 or -1
    int count;        // 0: none
};

struct ClvSlicePiece {
    ivec2 begin;      // cells of the slice in which the ray enters and leaves it
    ivec2 end;
    int isFirst;      // 1: the ray starts in cell `begin`
};

CLV_FN ClvSlices clvSlicesOfRay(ClvVolume volume, ClvRay ray) {
    ClvWalk walk = clvWalkBegin(volume, ray);
    ClvSlices slices;
    slices.first = walk.cell.z;
    slices.step = ray.direction.z > 0.0f ? 1 : -1;
    slices.count = 0;
    if (walk.running == 0) return slices;
    int last = clamp(int(floor(walk.origin.z + ray.direction.z * walk.tEnd)), 0, volume.resolution.z - 1);
    slices.count = max((last - slices.first) * slices.step, 0) + 1;
    return slices;
}

// The cell of the slice at `t` cells along the ray, inside the grid.
CLV_FN ivec2 clvSliceCell(ClvVolume volume, ClvWalk walk, vec3 direction, float t) {
    float x = floor(walk.origin.x + direction.x * t);
    float y = floor(walk.origin.y + direction.y * t);
    return ivec2(clamp(int(x), 0, volume.resolution.x - 1), clamp(int(y), 0, volume.resolution.y - 1));
}

// The ray's piece in a slice that it crosses.
CLV_FN ClvSlicePiece clvSlicePiece(ClvVolume volume, ClvRay ray, int slice) {
    ClvWalk walk = clvWalkBegin(volume, ray);
    bool rising = ray.direction.z > 0.0f;
    float tIn = slice == walk.cell.z ? walk.t : (float(rising ? slice : slice + 1) - walk.origin.z) * walk.inverse.z;
    float tOut = abs(ray.direction.z) > kClvParallel ? (float(rising ? slice + 1 : slice) - walk.origin.z) * walk.inverse.z : walk.tEnd;
    ClvSlicePiece piece;
    piece.begin = clvSliceCell(volume, walk, ray.direction, clamp(tIn, walk.t, walk.tEnd));
    piece.end = clvSliceCell(volume, walk, ray.direction, clamp(tOut, walk.t, walk.tEnd));
    piece.isFirst = walk.first > 0.0f && slice == walk.cell.z ? 1 : 0;
    return piece;
}

// Whether there is a line to draw: a ray's first cell alone is none.
CLV_FN bool clvPieceIsDrawn(ClvSlicePiece piece) { return piece.isFirst == 0 || piece.begin.x != piece.end.x || piece.begin.y != piece.end.y; }

// Where the line of a piece begins (vertex 0) and ends (vertex 1), in cells of the slice.
CLV_FN vec2 clvLineVertex(ClvSlicePiece piece, uint vertex) {
    vec2 back = vec2(float(piece.begin.x - piece.end.x), float(piece.begin.y - piece.end.y));
    float steps = max(abs(back.x), abs(back.y));
    back = steps > 0.0f ? back * (1.0f / steps) : vec2(1.0f, 0.0f);
    ivec2 cell = vertex == 0u ? piece.end : piece.begin;
    float along = vertex == 1u && piece.isFirst == 0 ? kClvLineBehind : -kClvLineBefore;
    return vec2(float(cell.x) + 0.5f, float(cell.y) + 0.5f) + back * along;
}

// A place in a slice, in clip space: y up, row 0 at the top.
CLV_FN vec4 clvSlicePosition(ClvVolume volume, vec2 place) {
    float width = float(volume.resolution.x) + 2.0f * float(kClvSliceRim);
    float height = float(volume.resolution.y) + 2.0f * float(kClvSliceRim);
    return vec4(2.0f * (place.x + float(kClvSliceRim)) / width - 1.0f, 1.0f - 2.0f * (place.y + float(kClvSliceRim)) / height, 0.5f, 1.0f);
}

// What a line adds to a side of the ambient cube: flux by channel, and its dynamicity where it lights the side at all.
CLV_FN vec4 clvLineOnSide(ClvCoefficients sides, uint side, vec3 flux, float dynamicity) {
    float cosine = clvCoefficient(sides, side);
    return vec4(flux.x * cosine, flux.y * cosine, flux.z * cosine, cosine > 0.0f ? dynamicity : 0.0f);
}

// Images of 16 bits hold sums up to this; of larger ones, infinite there, it is what is left. In 32 bits no sum is infinite: rays are
// limited by kClvMostDeposit.
CLV_CONST float kClvMostInHalf = 65504.0f;

CLV_FN float clvSliceSum(float sum) {
    if (clvIsFinite(sum)) return sum;
    return clvIsNan(sum) ? 0.0f : sum > 0.0f ? kClvMostInHalf : -kClvMostInHalf;
}

CLV_FN ClvCoefficients clvChannelOfSides(float s0, float s1, float s2, float s3, float s4, float s5) {
    ClvCoefficients x;
    x.a = vec4(clvSliceSum(s0), clvSliceSum(s1), clvSliceSum(s2), clvSliceSum(s3));
    x.b = vec4(clvSliceSum(s4), clvSliceSum(s5), 0.0f, 0.0f);
    x.c = 0.0f;
    return x;
}

// The record of a cell whose six sides hold these sums.
CLV_FN ClvRecord clvRecordOfSides(vec4 s0, vec4 s1, vec4 s2, vec4 s3, vec4 s4, vec4 s5) {
    ClvRecord record;
    record.r = clvChannelOfSides(s0.x, s1.x, s2.x, s3.x, s4.x, s5.x);
    record.g = clvChannelOfSides(s0.y, s1.y, s2.y, s3.y, s4.y, s5.y);
    record.b = clvChannelOfSides(s0.z, s1.z, s2.z, s3.z, s4.z, s5.z);
    return record;
}

CLV_NAMESPACE_END
#endif
