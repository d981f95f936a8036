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
layout(set = 0, binding = 3, scalar) buffer Starting { uint starting[]; };

const uvec2 none = uvec2(0u);
const KeptState nothing = KeptState(none, none, none, none, none, uvec3(0u), 0u, 0u, 0u);

// What a grid has to do in this frame.
struct Task {
    bool starts, ends, finds_links;
    uint from, to;  // steps of propagation
};

Task task_of(KeptState before) {
    const bool shows_this_place = before.shown != none && before.place == push.place;
    if (shows_this_place && before.shown == push.light) return Task(false, false, false, 0u, 0u);
    // Where there is nothing to show meanwhile, all at once. Light that was begun is ended first: with lights that change in every frame no
    // light would ever be shown.
    const bool is_sliced = shows_this_place && push.slice > 0u;
    const bool starts = !is_sliced || before.coming == none;
    const uint from = starts ? 0u : before.steps;
    const uint to = is_sliced ? min(from + push.slice, push.iterations) : push.iterations;
    return Task(starts, to == push.iterations, starts && before.linked != push.linked && push.linked != none, from, to);
}

bool is_idle(Task w) { return !w.starts && !w.ends && w.from == w.to; }

KeptState state_after(KeptState before, Task w) {
    KeptState after = before;
    if (w.starts) {
        after.coming = push.light;
        after.place = push.place;
    }
    if (w.finds_links) {
        after.linked = push.linked;
        after.lattice = push.lattice;
        after.first = push.first;
        after.blockers = push.blockers;
        after.portals = push.portals;
    }
    after.steps = w.to;
    if (w.ends) after.shown = after.coming;
    if (w.ends || is_idle(w)) after.coming = none;
    return after;
}

uvec3 groups_if(bool open, uvec3 threads, uvec3 size) { return open ? (threads + size - 1u) / size : uvec3(0u); }

void write_gates(Task w) {
    const uvec3 cube = uvec3(4u);
    gates[gate_cells] = groups_if(w.starts, push.cells, cube);
    gates[gate_faces] = groups_if(w.finds_links, push.cells * uvec3(1u, 1u, 3u), cube);
    gates[gate_barriers] = groups_if(w.finds_links, uvec3(push.blockers + push.portals, 1u, 1u), uvec3(64u, 1u, 1u));
    gates[gate_show] = groups_if(w.ends, push.cells, cube);
    for (uint step = 0u; step < push.iterations; ++step)
        gates[gate_first_step + step] = groups_if(step >= w.from && step < w.to, push.cells, cube);
}

void main() {
    const KeptState before = state;
    const Task w = task_of(before);
    work.before = before;
    work.after = state_after(before, w);
    if (!is_idle(w)) state = nothing;
    if (w.starts) {
        atomicOr(starting[0], starting_bit(push.grid));
        atomicOr(starting[starting_word(push.grid)], 1u << push.grid % 32u);
    }
    write_gates(w);
}
