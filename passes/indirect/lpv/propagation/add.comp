// Light of a further bounce added to what cells held of those before it. As half floats both have units of their own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/propagation/add_to_total.glsl"
#include "passes/shaders/largest_half.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) readonly buffer More { uint more[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

int exponent_of(uint unit) { return int(unit >> 23u); }

// In the sum's unit.
vec4 more_channel(uint cell, uint channel) {
    const uint at = total_word(cell, channel);
    if (!has_halves()) return uintBitsToFloat(uvec4(more[at], more[at + 1u], more[at + 2u], more[at + 3u]));
    const int exponent = clamp(exponent_of(more[0]) - exponent_of(total[0]), -126, 127);
    return power_of_two(exponent) * of_halves(uvec2(more[at], more[at + 1u]));
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, at)) return;
    const uint cell = cell_index(grid, at);
    for (uint channel = 0u; channel < channels; ++channel) {
        const vec4 sum = add_to_channel(cell, channel, more_channel(cell, channel));
        if (has_halves() && any(greaterThan(abs(sum), vec4(largest_half)))) atomicAdd(counters.overflowed, 1u);
    }
}
