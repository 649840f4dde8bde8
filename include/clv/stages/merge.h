// The merge stage: this frame's volume goes into the history, faster where the light moves.
//
// The history is the mean of the frames that it has seen, until the rate that dynamicity asks for is higher:
// weight = max(alpha(dynamicity), 1 / frames).
#ifndef CLV_STAGES_MERGE_H
#define CLV_STAGES_MERGE_H
#include "../data/light.h"
#include "../math/finite.h"
#include "../math/hash.h"
CLV_NAMESPACE_BEGIN

struct ClvMergeSettings {  // 16 bytes
    float timestep;        // s, > 0, since the last merge
    float stillTime;       // s, > 0: the history of light with dynamicity 0 decays to 1/e in this time; kClvFar: never
    float movingTime;      // s, (0, stillTime]: the same for dynamicity 1
    float dynamicityTime;  // s, > 0: a cell's dynamicity decays to 1/e in this time once its light stands still
};

// Movement that makes a light fully dynamic within one frame.
struct ClvMovementScales {  // 16 bytes
    float distance;  // m, > 0, e.g. the cell size
    float angle;     // rad, > 0, of the light's axis or its cones
    float change;    // > 0, of the intensity, relative to its larger value
    float pad0;
};

// Share of a value that wears off within `timestep` (s) at `rate` (1/s), [0, 1]. Two half steps wear off as much as one. A step
// below 0 or that is NaN wears off nothing.
CLV_FN float clvDecayed(float timestep, float rate) {
    float x = timestep * rate;
    if (clvIsNan(x) || x < 0.0f) return 0.0f;
    // 1 - exp(-x) by its series where the difference would lose digits.
    if (x < 0.1f) return x * (1.0f - x * 0.5f * (1.0f - x * (1.0f / 3.0f) * (1.0f - x * 0.25f * (1.0f - x * 0.2f))));
    return 1.0f - exp(-x);
}

// Rate of a decay to 1/e within `time` (s), 1/s; kClvFar: none. Finite for any time, so that differences of rates are numbers.
CLV_FN float clvDecayRate(float time) { return time < kClvFar ? 1.0f / max(1.0e-30f, time) : 0.0f; }

// Share of the history that a frame replaces, [0, 1]: the decay rate is linear in dynamicity.
CLV_FN float clvMergeAlpha(CLV_IN(ClvMergeSettings) settings, float dynamicity) {
    float still = clvDecayRate(settings.stillTime);
    float moving = clvDecayRate(settings.movingTime);
    return clvDecayed(settings.timestep, still + (moving - still) * clamp(dynamicity, 0.0f, 1.0f));
}

// Weight of the current frame, [0, 1]. frames: how many frames the history will stand for with this one, >= 1.
CLV_FN float clvMergeWeight(CLV_IN(ClvMergeSettings) settings, float dynamicity, float frames) {
    return max(clvMergeAlpha(settings, dynamicity), 1.0f / max(frames, 1.0f));
}

// How many frames, weighed alike, the history stands for after a merge with this weight: the frame count of light that was
// forgotten falls with it, so that a cell converges anew once its light stands still.
CLV_FN float clvFramesFromWeight(float weight) { return 1.0f / max(weight, 1.0e-9f); }

// The new history; what the library's own merges do with each number. Magnitudes must stay below half the largest float.
// From the nearer end: a weight of 1 leaves no trace of a large history, and equal values stay equal to the bit.
CLV_FN float clvMergeStep(float history, float current, float weight) {
    float change = current - history;
    return weight < 0.5f ? history + weight * change : current - (1.0f - weight) * change;
}
CLV_FN vec4 clvMergeStep(vec4 history, vec4 current, float weight) {
    vec4 change = current - history;
    return weight < 0.5f ? history + change * weight : current - change * (1.0f - weight);
}

// The same for values of another source: one that is not finite loses to the other one.
CLV_FN float clvMergeValue(float history, float current, float weight) {
    if (!clvIsFinite(history)) return current;
    if (!clvIsFinite(current) || !clvIsFinite(weight)) return history;
    return clvMergeStep(history, current, weight);
}

// The same, rounded up or down by chance, so that steps below the last place of the history count in the mean over frames: a plain
// merge stalls where weight * (current - history) is less than half of that place. `random`: 32 random bits, new ones each frame.
CLV_FN float clvMergeDithered(float history, float current, float weight, uint random) {
    if (!clvIsFinite(history) || !clvIsFinite(current) || !clvIsFinite(weight)) return clvMergeValue(history, current, weight);
    // One last place of the larger of the two, which the other is a multiple of or above.
    uint exponent = clvBitsFromFloat(max(abs(history), abs(current))) >> 23;
    float place = clvFloatFromBits((max(exponent, 24u) - 23u) << 23);
    float merged = history + floor(weight * (current - history) * (1.0f / place) + clvUnitFloat(random)) * place;
    return clamp(merged, min(history, current), max(history, current));
}

// Dynamicity of a cell: the largest wins at once, and wears off slowly.
CLV_FN float clvMergeDynamicity(CLV_IN(ClvMergeSettings) settings, float history, float current) {
    float kept = history * (1.0f - clvDecayed(settings.timestep, clvDecayRate(settings.dynamicityTime)));
    return max(clvIsFinite(kept) ? kept : 0.0f, clvIsFinite(current) ? current : 0.0f);
}

// Angle between two directions of unit length, rad, [0, pi]. The arc cosine would lose small angles.
CLV_FN float clvAngleBetween(vec3 a, vec3 b) { return clvAtan2(length(cross(a, b)), dot(a, b)); }

// Dynamicity of a light, [0, 1], from what it did between two frames: the sum of its movement, its turn and the change of its
// intensity, each over the scale at which history is worth nothing. A light that stands still has 0; another type, or
// values that are not finite, give 1.
CLV_FN float clvLightDynamicity(CLV_IN(ClvLight) previous, CLV_IN(ClvLight) current, ClvMovementScales scales) {
    if (previous.type != current.type || !clvIsFinite(previous.intensity) || !clvIsFinite(current.intensity)) return 1.0f;
    float moved = length(current.position - previous.position);
    float turned = clvAngleBetween(previous.direction, current.direction);
    float widened = abs(current.innerConeAngle - previous.innerConeAngle) + abs(current.outerConeAngle - previous.outerConeAngle);
    vec3 change = abs(current.intensity - previous.intensity);
    vec3 larger = max(current.intensity, previous.intensity);
    float peak = max(larger.x, max(larger.y, larger.z));
    float dimmed = peak > 0.0f ? max(change.x, max(change.y, change.z)) / peak : 0.0f;
    float sum = dimmed / scales.change;
    if (current.type != kClvLightDirectional) sum += moved / scales.distance;
    if (current.type != kClvLightPoint) sum += turned / scales.angle;
    if (current.type == kClvLightSpot) sum += widened / scales.angle;
    return clvIsFinite(sum) ? min(sum, 1.0f) : 1.0f;
}

CLV_NAMESPACE_END
#endif
