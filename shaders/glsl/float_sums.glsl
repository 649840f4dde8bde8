// This frame's sums as floats.
layout(std430, binding = CLV_BIND_DEPOSITS) buffer Deposits { vec4 deposits[]; };

// Of four numbers; clears them.
vec4 takeMean(uint i, float scale, float fixedScale) {
    vec4 mean = deposits[i] * scale;
    deposits[i] = vec4(0.0);
    return mean;
}
