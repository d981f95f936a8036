// The links of a grid that keeps them. A face is tested against the blockers where a blocker or portal that changed is near it, at its old
// or its new place, and where it was not in the grid the last time. The cells of a cascade lie on a lattice in the world: kept links have
// its cells modulo the size of the grid for an address, so that they stay where they are when the grid moves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/kept/barriers.glsl"
#include "passes/indirect/lpv/occlusion/face.glsl"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { FacesPush push; };
layout(set = 0, binding = 0, scalar) writeonly buffer Links { float links[]; };  // as links.comp has them
layout(set = 0, binding = 2, scalar) readonly buffer Work { KeptWork work; };
layout(set = 0, binding = 3, scalar) readonly buffer Barriers { KeptBarrier barriers[]; };
layout(set = 0, binding = 4, scalar) buffer KeptLinks { float kept_links[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

// The middle of a face in meters from the corner of the grid's first cell, before as well as now.
bool is_near_barrier(KeptBarrier held, vec3 middle) {
    const float reach = 0.867 * push.grid.cell;  // of face.glsl's is_near(), and what the eye's place rounds away
    const vec3 offset = middle - held.center;
    const float radius = held.radius + reach;
    return abs(dot(held.normal, offset)) <= reach && dot(offset, offset) <= radius * radius;
}

vec3 face_middle(ivec3 cell, uint axis) {
    vec3 middle = vec3(cell) + 0.5;
    middle[axis] += 0.5;
    return middle * push.grid.cell;
}

bool is_kept(ivec3 cell, uint axis) {
    const KeptState before = work.before;
    if (before.linked == uvec2(0u) || before.lattice != push.lattice) return false;
    if (before.blockers != blocker_count || before.portals != portal_count) return false;
    const ivec3 was = cell + ivec3(push.first - before.first);
    ivec3 next = was;
    ++next[axis];
    if (!in_grid(push.grid, was) || !in_grid(push.grid, next)) return false;
    for (uint i = 0u; i < blocker_count + portal_count; ++i) {
        const KeptBarrier old = barriers[i];
        if (old.identity == identities[i]) continue;
        if (is_near_barrier(old, face_middle(was, axis)) || is_near_barrier(barrier_of(push.grid, i), face_middle(cell, axis))) return false;
    }
    return true;
}

float link_of(ivec3 cell, uint axis) {
    const ivec3 place = ivec3((uvec3(cell) + push.turn) % push.grid.cells);
    const uint address = 3u * cell_index(push.grid, place) + axis;
    if (!is_kept(cell, axis)) {
        kept_links[address] = link(push.grid, cell, axis);
        atomicAdd(counters.faces_rebuilt, 1u);
    }
    return kept_links[address];
}

void main() {
    const uint axis = gl_GlobalInvocationID.z % 3u;
    const ivec3 at = ivec3(gl_GlobalInvocationID.xy, gl_GlobalInvocationID.z / 3u);
    if (!in_grid(push.grid, at)) return;
    const bool has_neighbor = at[axis] + 1 < int(push.grid.cells[axis]);
    links[3u * cell_index(push.grid, at) + axis] = has_neighbor ? link_of(at, axis) : 0.0;
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
