// Guided rays: how texels and directions are preferred by what earlier rays met. cpu/ray_guide.h learns that, and says why.
//
// A shader defines, before it includes this: uint clvReadGuideCell(uint cell), the guide's row for a cell of its grid, and
// float clvReadGuideWeight(uint index). A row has kClvGuideRow weights: a direction's in each bin, then that of the texels there.
#ifndef CLV_STAGES_RAY_GUIDE_H
#define CLV_STAGES_RAY_GUIDE_H
#include "../data/light_volume.h"
#include "../math/hash.h"
#include "../math/sampling.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvGuideBins = 24u;
CLV_CONST uint kClvGuideRow = 25u;
CLV_CONST uint kClvGuideCandidates = 4u;

// The axis along which the direction is longest, and the signs of all three components. Without branches, for vectors.
CLV_FN uint clvGuideBin(float x, float y, float z) {
    uint notX = abs(x) < max(abs(y), abs(z)) ? 1u : 0u;
    uint zWins = abs(y) < abs(z) ? 1u : 0u;
    return 8u * notX * (1u + zWins) + (x > 0.0f ? 1u : 0u) + (y > 0.0f ? 2u : 0u) + (z > 0.0f ? 4u : 0u);
}

// The point of the square from which candidate c is made: copies of u shifted by the steps of the R2 sequence (Roberts 2018), so that
// every candidate is as well spread as u. Candidate 0 is u itself.
CLV_FN vec2 clvGuideCandidate(vec2 u, uint c) { return vec2(fract(u.x + float(c) * 0.7548776662f), fract(u.y + float(c) * 0.5698402910f)); }

// A number in [0, 1) that chooses among the candidates of ray `index`.
CLV_FN float clvGuideChoice(uint index, uint seed) { return clvUnitFloat(clvHashCombine(clvHashCombine(seed, 0x6c1du), index)); }

// The first weight of the row for a position, which may lie outside the grid.
CLV_READER_FN uint clvGuideRowAt(CLV_READER ClvVolume grid, vec3 position) {
    return CLV_READ clvReadGuideCell(clvCellIndex(grid, clvClampCell(grid, clvCellFromPosition(grid, position)))) * kClvGuideRow;
}

// By which texels at a position of this row are preferred.
CLV_READER_FN float clvGuideTexelWeight(CLV_READER uint row) { return CLV_READ clvReadGuideWeight(row + kClvGuideBins); }

struct ClvGuidedDirection {
    vec3 direction;
    float probability;  // of the choice, times the number of candidates: 1 where none is preferred
};

// Resamples a cosine-distributed direction among candidates, in proportion to the row's weights (Talbot, Cline, Egbert 2005).
// u: in [0, 1)^2; choice: see clvGuideChoice.
CLV_READER_FN ClvGuidedDirection clvGuideDirection(CLV_READER uint row, vec3 normal, vec2 u, float choice) {
    vec3 direction[kClvGuideCandidates];
    float weight[kClvGuideCandidates];
    float sum = 0.0f;
    for (uint c = 0u; c < kClvGuideCandidates; ++c) {
        direction[c] = clvCosineFromSquare(clvGuideCandidate(u, c), normal);
        weight[c] = CLV_READ clvReadGuideWeight(row + clvGuideBin(direction[c].x, direction[c].y, direction[c].z));
        sum += weight[c];
    }
    // The first candidate at which the running sum passes what was drawn; the first of all where rounding lets none.
    ClvGuidedDirection guided;
    guided.direction = direction[0];
    float chosen = weight[0];
    float before = 0.0f;
    for (uint k = 0u; k < kClvGuideCandidates; ++k) {
        bool takes = choice * sum >= before && choice * sum < before + weight[k];
        guided.direction = takes ? direction[k] : guided.direction;
        chosen = takes ? weight[k] : chosen;
        before += weight[k];
    }
    guided.probability = chosen * float(kClvGuideCandidates) / sum;
    return guided;
}

CLV_NAMESPACE_END
#endif
