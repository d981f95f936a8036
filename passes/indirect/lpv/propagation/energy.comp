// A row of the table of energy: what the cells hold before a step, and what was lost up to it, at blockers and over the border. Each is a
// sum of its own, so that they prove each other. Sums are of two floats, so that their rounding does not hide that of propagation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/occlusion/links.glsl"
#include "passes/indirect/lpv/propagation/read_step.glsl"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 256) in;

layout(push_constant, scalar) uniform Push { EnergyPush push; };
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2D numbers;
layout(set = 0, binding = 3, scalar) buffer Lost { EnergySum lost; };
layout(set = 0, binding = 4, scalar) readonly buffer Total { uint total[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

shared EnergySum sums[256];

// Knuth, The Art of Computer Programming 2, 4.2.2: the rest is exactly what the sum was rounded by.
EnergySum plus(EnergySum a, EnergySum b) {
    precise const vec3 sum = a.sum + b.sum;
    precise const vec3 added = sum - a.sum;
    precise const vec3 rest = (a.rest + b.rest) + ((a.sum - (sum - added)) + (b.sum - added));
    return EnergySum(sum, rest);
}

// W of a channel that a cell sends along an axis, but for the unit of halves.
float sent_along(uint cell, uint channel, uint axis, float direction) {
    return sent(before_channel(cell, channel), share_before(cell, channel), axis, direction).x / watt0;
}

float sent_all(uint cell, uint axis, float direction) {
    return sent_along(cell, 0u, axis, direction) + sent_along(cell, 1u, axis, direction) + sent_along(cell, 2u, axis, direction);
}

float held(uint cell) { return (before_channel(cell, 0u).x + before_channel(cell, 1u).x + before_channel(cell, 2u).x) / watt0; }

// Held, absorbed by the step to come, escaping in it.
vec3 energy(ivec3 at) {
    const uint cell = cell_index(push.grid, at);
    vec3 sum = vec3(held(cell), 0.0, 0.0);
    float all = 0.0;
    for (uint i = 0u; i < 6u; ++i) {
        const uint axis = i / 2u;
        const int direction = i % 2u == 0u ? 1 : -1;
        ivec3 next = at;
        next[axis] += direction;
        const float flux = sent_all(cell, axis, float(direction));
        all += flux;
        if (in_grid(push.grid, next)) sum.y += (1.0 - transmitted(push.grid, direction > 0 ? at : next, axis)) * flux;
        else sum.z += flux;
    }
    if (!has_halves()) return sum;
    // What halves hold sends all that the cell does: their l0 is not that of the cell.
    if (propagation == propagation_energy_true) sum.x = all;
    return sum * (uintBitsToFloat(total[0]) * step_unit());
}

void main() {
    const uint thread = gl_LocalInvocationIndex;
    const uvec3 cells = push.grid.cells;
    EnergySum sum = EnergySum(vec3(0.0), vec3(0.0));
    for (uint i = thread; i < cells.x * cells.y * cells.z; i += 256u)
        sum = plus(sum, EnergySum(energy(ivec3(i % cells.x, i / cells.x % cells.y, i / (cells.x * cells.y))), vec3(0.0)));
    sums[thread] = sum;
    for (uint reach = 128u; reach > 0u; reach /= 2u) {
        barrier();
        if (thread < reach) sums[thread] = plus(sums[thread], sums[thread + reach]);
    }
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
    if (thread > 0u) return;
    const vec3 before_step = vec3(sums[0].sum.x + sums[0].rest.x, lost.sum.yz + lost.rest.yz);
    imageStore(numbers, ivec2(0, push.step), vec4(float(push.step), before_step));
    lost = plus(lost, sums[0]);
}
