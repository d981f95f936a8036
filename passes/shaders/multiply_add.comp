// Fused multiply-adds in eight chains that do not wait for each other: x = 1 x + 1 counts itself, and every thread stores its count.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shaders/multiply_add.shared.h"

layout(local_size_x = multiply_add_threads) in;
layout(push_constant, scalar) uniform Push { MultiplyAdd loop; };
layout(set = 0, binding = 0, scalar) writeonly buffer Done { uint done[]; };

void main() {
    vec4 a = vec4(0), b = vec4(0);
    for (uint turn = 0u; turn < loop.iterations; ++turn) {
        a = fma(a, vec4(loop.factor), vec4(loop.summand));
        b = fma(b, vec4(loop.factor), vec4(loop.summand));
        a = fma(a, vec4(loop.factor), vec4(loop.summand));
        b = fma(b, vec4(loop.factor), vec4(loop.summand));
    }
    const vec4 sum = a + b;
    done[gl_GlobalInvocationID.x] = uint(sum.x + sum.y + sum.z + sum.w);
}
