// Evaluate: irradiance at a surface point, read from the cells around it.
//
// E = sum of lambda_s * (deposits of slot s, read for the normal). The weights lambda_s follow from geometry alone:
// interpolation weights w_s over open volumes V_s, divided after interpolating, sum(w A) / sum(w V).
#ifndef CLV_STAGES_EVALUATE_H
#define CLV_STAGES_EVALUATE_H
#include "../data/cell.h"
#include "../data/light_volume.h"
#include "../math/finite.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvLookupNearest = 0u;    // the cell in front of the surface
CLV_CONST uint kClvLookupTrilinear = 1u;  // 8 cells
CLV_CONST uint kClvLookupLinearFit = 2u;  // 27 cells, a local linear model evaluated on the surface

// Half a cell in front of the surface: where interpolation is centred, in cells.
CLV_CONST float kClvLookupOffset = 0.5f;
// Where a surface point's own cell is looked for, in cells in front of it: a wall on a cell face belongs to the cell it faces.
CLV_CONST float kClvHomeOffset = 0.01f;
// Where the side of a split cell is decided, in cells in front of the surface.
CLV_CONST float kClvSideOffset = 0.25f;
// Ridge of the local linear model, cells^2: keeps its slope finite where the cells in sight lie in a plane.
CLV_CONST float kClvFitRidge = 0.03f;

struct ClvReceiver {
    vec3 position;  // m, relative to the anchor
    float pad0;
    vec3 normal;    // unit length
    float pad1;
};

// Hat function, support (-1, 1); x in cells.
CLV_FN float clvHatWeight(float x) { return max(0.0f, 1.0f - abs(x)); }

// Quadratic B-spline, support (-1.5, 1.5); x in cells.
CLV_FN float clvQuadraticWeight(float x) {
    float d = abs(x);
    float outer = max(0.0f, 1.5f - d);
    return d < 0.5f ? 0.75f - d * d : 0.5f * outer * outer;
}

// Product of the three axes' weights for a cell centre at `offset` cells from the point where interpolation is centred.
CLV_FN float clvLookupWeight(uint lookup, vec3 offset) {
    if (lookup == kClvLookupLinearFit) {
        return clvQuadraticWeight(offset.x) * clvQuadraticWeight(offset.y) * clvQuadraticWeight(offset.z);
    }
    return clvHatWeight(offset.x) * clvHatWeight(offset.y) * clvHatWeight(offset.z);
}

// Plane culling: a region whose centroid lies behind the receiver's plane cannot light it.
CLV_FN int clvInFront(ClvReceiver receiver, vec3 openCentroid) {
    return dot(openCentroid - receiver.position, receiver.normal) > 0.0f ? 1 : 0;
}

// Bit of a neighbour in ClvSlot::visible; each coordinate of `step` in [-1, 1].
CLV_FN uint clvNeighbourBit(ivec3 step) { return 1u << uint((step.x + 1) + 3 * (step.y + 1) + 9 * (step.z + 1)); }

// Weighted moments of the slots that a lookup uses; x is the centroid relative to the receiver, in cells.
struct ClvFit {
    float weight;   // sum w V
    vec3 mean;      // sum w V x
    vec3 diagonal;  // sum w V (xx, yy, zz)
    vec3 mixed;     // sum w V (yz, xz, xy)
};

CLV_FN ClvFit clvFitBegin() {
    ClvFit fit;
    fit.weight = 0.0f;
    fit.mean = vec3(0.0f, 0.0f, 0.0f);
    fit.diagonal = vec3(0.0f, 0.0f, 0.0f);
    fit.mixed = vec3(0.0f, 0.0f, 0.0f);
    return fit;
}

CLV_FN void clvFitAdd(CLV_INOUT(ClvFit) fit, float weight, vec3 x) {
    fit.weight += weight;
    fit.mean += x * weight;
    fit.diagonal += x * x * weight;
    fit.mixed += vec3(x.y * x.z, x.x * x.z, x.x * x.y) * weight;
}

// Turns the sums into moments, so that clvFitShare may be called. fit.weight must be > 0.
// Returns g = (C + ridge)^-1 mean, C the covariance of x: the fitted value at x = 0 weighs a slot by 1 - dot(x - mean, g).
CLV_FN vec3 clvFitSolve(CLV_INOUT(ClvFit) fit, float ridge) {
    float scale = 1.0f / fit.weight;
    fit.mean = fit.mean * scale;
    vec3 m = fit.mean;
    vec3 d = max(fit.diagonal * scale - m * m, vec3(0.0f, 0.0f, 0.0f)) + vec3(ridge, ridge, ridge);
    vec3 o = fit.mixed * scale - vec3(m.y * m.z, m.x * m.z, m.x * m.y);
    // Adjugate of the symmetric matrix [d.x o.z o.y; o.z d.y o.x; o.y o.x d.z].
    float axx = d.y * d.z - o.x * o.x;
    float ayy = d.x * d.z - o.y * o.y;
    float azz = d.x * d.y - o.z * o.z;
    float axy = o.y * o.x - o.z * d.z;
    float axz = o.z * o.x - o.y * d.y;
    float ayz = o.z * o.y - o.x * d.x;
    // At least ridge^3 in exact arithmetic; the floor guards against rounding.
    float determinant = max(d.x * axx + o.z * axy + o.y * axz, ridge * ridge * ridge);
    return vec3(axx * m.x + axy * m.y + axz * m.z, axy * m.x + ayy * m.y + ayz * m.z, axz * m.x + ayz * m.y + azz * m.z) *
           (1.0f / determinant);
}

// lambda of a slot: multiplies its raw deposits. `weight` is w, without the open volume.
CLV_FN float clvFitShare(ClvFit fit, vec3 g, float weight, vec3 x) { return weight / fit.weight * (1.0f - dot(x - fit.mean, g)); }

// The most irradiance that is read, W/m^2; the sum of two is a float.
CLV_CONST float kClvMostIrradiance = 1.0e38f;

// Irradiance from what was read, W/m^2: in [0, kClvMostIrradiance]. Numbers beyond the floats may cancel to NaN, which counts as the most.
CLV_FN float clvIrradianceFromSum(float sum) { return clvIsNan(sum) ? kClvMostIrradiance : min(max(sum, 0.0f), kClvMostIrradiance); }
CLV_FN vec3 clvIrradianceFromSum(vec3 sum) { return vec3(clvIrradianceFromSum(sum.x), clvIrradianceFromSum(sum.y), clvIrradianceFromSum(sum.z)); }

// Static ambient term, W/m^2: fills what has less light than `threshold` (W/m^2, > 0), and fades out towards it.
// It is added for pictures only; measured irradiance never contains it.
CLV_FN vec3 clvAmbient(vec3 irradiance, vec3 ambient, float threshold) {
    float brightest = max(max(irradiance.x, irradiance.y), irradiance.z);
    return ambient * clamp(1.0f - brightest / threshold, 0.0f, 1.0f);
}

CLV_NAMESPACE_END
#endif
