// This frame's sums as integers.
layout(std430, binding = CLV_BIND_DEPOSITS) buffer Deposits { ivec4 deposits[]; };

// Of four numbers; clears them.
vec4 takeMean(uint i, float scale, float fixedScale) {
    vec4 mean = vec4(deposits[i]) * (scale / fixedScale);
    deposits[i] = ivec4(0);
    return mean;
}
