// Whether a grid is lit anew in this frame, goes on with light that an earlier frame began, or has nothing to do: then all its steps have
// no groups. Until leave.comp writes the new state the old one is forgotten, so that a run that ends between the two leaves nothing half
// done.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/indirect/lpv/kept/kept.shared.h"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform Push { DecidePush push; };
layout(set = 0, binding = 0, scalar) buffer State { KeptState state; };
layout(set = 0, binding = 1, scalar) writeonly buffer Work { KeptWork work; };
layout(set = 0, binding = 2, scalar) writeonly buffer Gates { uvec3 gates[]; };
layout(set = 0, binding = 3, scalar) buffer Starting { uint starting; };

const uvec2 none = uvec2(0u);
const KeptState nothing = KeptState(none, none, none, none, none, uvec3(0u), 0u, 0u, 0u);

uvec3 groups_if(bool open, uvec3 threads, uint size) { return open ? (threads + size - 1u) / size : uvec3(0u); }

void main() {
    const KeptState before = state;
    const bool shows_this_place = before.shown != none && before.place == push.place;
    const bool is_done = shows_this_place && before.shown == push.light;
    // Light that was begun is ended first: with lights that change in every frame no light would ever be shown.
    const bool goes_on = !is_done && shows_this_place && push.slice > 0u && before.coming != none;
    const bool starts = !is_done && !goes_on;
    const uint from = goes_on ? before.steps : 0u;
    // Where there is nothing to show meanwhile, all at once.
    const bool is_sliced = shows_this_place && push.slice > 0u;
    const uint to = is_done ? 0u : is_sliced ? min(from + push.slice, push.iterations) : push.iterations;
    const bool ends = !is_done && to == push.iterations;
    const bool links = starts && before.linked != push.linked && push.linked != none;

    KeptState after = before;
    if (starts) {
        after.coming = push.light;
        after.place = push.place;
    }
    if (links) {
        after.linked = push.linked;
        after.lattice = push.lattice;
        after.first = push.first;
        after.blockers = push.blockers;
        after.portals = push.portals;
    }
    if (!is_done) after.steps = to;
    if (ends) after.shown = after.coming;
    if (ends || is_done) after.coming = none;
    work.before = before;
    work.after = after;
    if (!is_done) state = nothing;
    if (starts) atomicOr(starting, push.starting_bit);

    const uvec3 maps = uvec3(push.map_size, push.map_size, 1u);
    gates[gate_cells] = groups_if(starts, push.cells, 4u);
    gates[gate_one_map] = groups_if(starts, maps, 8u);
    gates[gate_one_map].z = starts ? 1u : 0u;
    gates[gate_six_maps] = groups_if(starts, maps, 8u);
    gates[gate_six_maps].z = starts ? 6u : 0u;
    gates[gate_faces] = groups_if(links, push.cells * uvec3(1u, 1u, 3u), 4u);
    gates[gate_barriers] = links ? uvec3((push.blockers + push.portals + 63u) / 64u, 1u, 1u) : uvec3(0u);
    gates[gate_show] = groups_if(ends, push.cells, 4u);
    for (uint step = 0u; step < push.iterations; ++step) gates[gate_first_step + step] = groups_if(step >= from && step < to, push.cells, 4u);
}
