// What was injected, as numbers: the light of step 0, and what is accumulated so far.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/propagation/write_step.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { ResolvePush push; };
layout(set = 0, binding = 0, scalar) readonly buffer Sums { ivec4 sums[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Total { uint total[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Scale { float fixed_one; };
layout(constant_id = 3) const uint has_scale = 0u;  // 1: the fixed point is known on the device alone
layout(constant_id = 4) const uint shows_injected = 1u;  // 0: surfaces read only what was propagated (self_uninjected)
layout(set = 0, binding = 5, scalar) readonly buffer Brightest { uint brightest; };  // l0 of all sums; of storage_half alone
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

// W of 1 in the fixed point.
float fixed_unit() {
    if (has_scale != 0u) return 1.0 / fixed_one;
    return 1.0 / push.fixed_one;
}

// Of the brightest sum's highest bit.
int brightest_exponent() { return findMSB(max(brightest, 1u)); }

void store(uint cell, uint channel, vec4 in_step, vec4 in_total) {
    store_step(cell, channel, in_step);
    const uvec4 words = words_of(shows_injected != 0u ? in_total : vec4(0.0));
    const uint at = total_word(cell, channel);
    for (uint i = 0u; i < stored_words(); ++i) total[at + i] = words[i];
}

void store_halves(uint cell, uint channel, vec4 sum) {
    const vec4 in_total = sum * power_of_two(total_exponent - brightest_exponent());
    store(cell, channel, in_total * power_of_two(step_exponent - total_exponent), in_total);
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(push.grid, at)) return;
    const uint cell = cell_index(push.grid, at);
    const float unit = fixed_unit();
    for (uint channel = 0u; channel < channels; ++channel) {
        const vec4 sum = vec4(sums[channels * cell + channel]);
        if (has_halves()) store_halves(cell, channel, sum);
        else store(cell, channel, sum * unit, sum * unit);
    }
    if (has_halves() && cell == 0u) total[0] = floatBitsToUint(unit * power_of_two(brightest_exponent() - total_exponent));
    atomicAdd(counters.cells_relit, 1u);
}
