// Which blockers are near which macro-cell: a thread per macro-cell and 32 blockers. A rectangle and a box are apart where they are so
// along the rectangle's normal, a side of the box, or across a side of either.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/apply/reading.glsl"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/indirect/macro_cells.glsl"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 7, scalar) writeonly buffer MacroCells { uint macro_cells[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

// View space: middle +- axes[i] half_extent[i].
struct Box {
    vec3 middle, half_extent;
    mat3 axes;
};

// A place q before a surface selects its macro-cell. Cells around q are less than a cell from it. Ways to them begin `reading` cells from it,
// but for 0.02 m (passes/indirect/near_blockers.glsl), and ways to another pixel's surface end half a cell farther; a sixteenth is for rounding.
// At the grid's border q may be `reading` cells beyond it.
Box box_of(uvec3 macro, uvec3 extent) {
    const float reach = max(1.0, reading + 0.5);
    const vec3 low = vec3(macro_side * macro) - reach * vec3(equal(macro, uvec3(0u)));
    const vec3 high = vec3(min(macro_side * (macro + 1u), grid.cells)) + reach * vec3(equal(macro + 1u, extent));
    const mat3 axes = mat3(in_view(vec3(1.0, 0.0, 0.0)), in_view(vec3(0.0, 1.0, 0.0)), in_view(vec3(0.0, 0.0, 1.0)));
    return Box(in_view(grid.origin + 0.5 * (low + high) * grid.cell), (0.5 * (high - low) + reach + 1.0 / 16.0) * grid.cell + way_offset, axes);
}

bool are_apart(BlockerRecord blocker, Box box, vec3 axis) {
    const vec3 v = cross(blocker.normal, blocker.u);
    const float reach = dot(box.half_extent, abs(axis * box.axes)) + blocker.half_u * abs(dot(axis, blocker.u)) +
                        blocker.half_v * abs(dot(axis, v));
    return abs(dot(axis, box.middle - blocker.center)) > reach;
}

bool meet(BlockerRecord blocker, Box box) {
    if (are_apart(blocker, box, blocker.normal)) return false;
    const vec3 v = cross(blocker.normal, blocker.u);
    for (uint i = 0u; i < 3u; ++i) {
        const vec3 side = box.axes[i];
        if (are_apart(blocker, box, side) || are_apart(blocker, box, cross(side, blocker.u)) || are_apart(blocker, box, cross(side, v)))
            return false;
    }
    return true;
}

void main() {
    const uvec3 extent = macro_extent(grid);
    const uvec3 macro = uvec3(gl_GlobalInvocationID.xy, gl_GlobalInvocationID.z / blocker_words);
    if (any(greaterThanEqual(macro, extent))) return;
    const uint word = gl_GlobalInvocationID.z % blocker_words;
    const Box box = box_of(macro, extent);
    uint near = 0u;
    for (uint i = 32u * word; i < min(32u * (word + 1u), blocker_count); ++i)
        if (meet(blockers[i], box)) near |= 1u << (i & 31u);
    macro_cells[macro_index(grid, macro) * blocker_words + word] = near;
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
