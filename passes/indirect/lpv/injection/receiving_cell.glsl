// The cell that takes what a piece of a surface sends out, and the fixed point in which it does (docs/algorithms/lighting.md 5.3).
#ifndef PASSES_INDIRECT_LPV_RECEIVING_CELL_GLSL
#define PASSES_INDIRECT_LPV_RECEIVING_CELL_GLSL
#include "passes/indirect/lit_place.glsl"
#include "passes/indirect/lpv/channels.glsl"
#include "passes/indirect/ways.glsl"

layout(constant_id = 11) const uint guards = 0u;  // 1: not into cells that a blocker hides from the surface

layout(set = 0, binding = 3, scalar) buffer Sums { int sums[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

// Meters by which light is moved on along its normal. Walls like to lie so that their light falls onto a border of cells: the rounding of each
// texel would decide between the cells on both sides.
const float across_border = 1e-4;

ivec3 taking_cell(GridPlace grid, vec3 place, vec3 n) { return cell_of(grid, place + across_border * n); }

// +x, -x, +y, -y, +z, -z of it.
ivec3 neighbor(ivec3 cell, uint i) {
    cell[i / 2u] += i % 2u == 0u ? 1 : -1;
    return cell;
}

// The cell before the surface; where a blocker hides it, the one a whole cell before, then neighbors by their distance. None: x < 0.
ivec3 guarded_cell(GridPlace grid, vec3 surface, vec3 n, ivec3 first, vec3 biased) {
    const vec3 from = way_start(LitPlace(surface, n));
    if (!is_stopped(from, in_view(middle_of(grid, first)))) return first;
    const ivec3 farther = taking_cell(grid, surface + n * grid.cell, n);
    if (in_grid(grid, farther) && !is_stopped(from, in_view(middle_of(grid, farther)))) return farther;
    uint tried = 0u;
    for (uint turn = 0u; turn < 6u; ++turn) {
        uint next = 0u;
        float nearest = 1e30;
        for (uint i = 0u; i < 6u; ++i) {
            const float away = distance(middle_of(grid, neighbor(first, i)), biased);
            if ((tried & (1u << i)) == 0u && away < nearest) next = i, nearest = away;
        }
        tried |= 1u << next;
        const ivec3 cell = neighbor(first, next);
        if (in_grid(grid, cell) && !is_stopped(from, in_view(middle_of(grid, cell)))) return cell;
    }
    return ivec3(-1);
}

// Whether the cell before the surface is one of the grid's. Places are relative to the eye, along the world's axes; bias in cells.
bool has_cell_before_it(GridPlace grid, vec3 surface, vec3 n, float bias) {
    return in_grid(grid, taking_cell(grid, surface + n * (bias * grid.cell), n));
}

// None: x < 0.
ivec3 receiving_cell(GridPlace grid, vec3 surface, vec3 n, float bias) {
    const vec3 biased = surface + n * (bias * grid.cell);
    const ivec3 first = taking_cell(grid, biased, n);
    if (!in_grid(grid, first)) {
        atomicAdd(counters.outside, 1u);
        return ivec3(-1);
    }
    const ivec3 cell = guards == 0u ? first : guarded_cell(grid, surface, n, first, biased);
    if (cell.x < 0) atomicAdd(counters.dropped, 1u);
    else if (cell != first) atomicAdd(counters.guarded, 1u);
    return cell;
}

// Adds the coefficients of one channel. Sums of l0 are never negative.
void add_to_sum(uint cell, uint channel, vec4 lobe) {
    for (uint i = 0u; i < 4u; ++i) {
        const int part = int(roundEven(lobe[i])), before = atomicAdd(sums[4u * (cell * channels + channel) + i], part);
        if (i == 0u && before < most_of_a_sum && before + part >= most_of_a_sum) atomicAdd(counters.overflowed, 1u);
    }
}

// W per channel, of a surface that reflects as Lambert's does.
void add_lobe(uint cell, vec3 flux, vec3 n, float fixed_one) {
    const vec4 lobe = vec4(watt0, watt1 * n);
    for (uint channel = 0u; channel < color_channels; ++channel) add_to_sum(cell, channel, lobe * (flux[channel] * fixed_one));
    if (!knows_facing()) return;
    const vec3 facing = (flux.r + flux.g + flux.b) / 3.0 * (0.5 + 0.5 * n);
    for (uint axis = 0u; axis < 3u; ++axis) add_to_sum(cell, color_channels + axis, lobe * (facing[axis] * fixed_one));
}

#endif
