// The blockers near a macro-cell: those that may be in the way between a surface and the cells that it reads
// (docs/algorithms/lighting.md 5.8). The shader that includes this says where the macro-cells' lists lie, listed_blockers().
#ifndef PASSES_INDIRECT_NEAR_BLOCKERS_GLSL
#define PASSES_INDIRECT_NEAR_BLOCKERS_GLSL
#include "passes/indirect/macro_cells.glsl"

// Stands for a list of all blockers of the frame.
const uint all_listed = 0xffffffffu;

// 32 blockers of a list: a bit each.
uint listed_blockers(uint list, uint word);

uint near_blockers(uint list, uint word) {
    return list == all_listed ? low_bits(blocker_count - 32u * word) : listed_blockers(list, word);
}

uint count_near(uint list) {
    uint count = 0u;
    for (uint word = 0u; word < blocker_words; ++word) count += uint(bitCount(near_blockers(list, word)));
    return count;
}

bool is_stopped_near(uint list, vec3 from, vec3 to, inout uint tests) {
    for (uint word = 0u; word < blocker_words; ++word)
        for (uint near = near_blockers(list, word); near != 0u; near &= near - 1u) {
            ++tests;
            if (stops(32u * word + uint(findLSB(near)), from, to)) return true;
        }
    return false;
}

// The eight cells around a corner of cells, and the place that ways to their middles begin at, view space.
struct WaysToCells {
    ivec3 first;  // the cell below the corner
    vec3 corner, from;
};

ivec3 cell_around(ivec3 first, uint i) { return first + ivec3(i & 1u, i >> 1u & 1u, i >> 2u); }

// Whether the blocker's plane may part the ways' begin from one of the eight middles, which are half a cell from the corner along each
// axis. A 64th of a cell is for rounding: no way that stops() would find is left out.
bool may_part(BlockerRecord blocker, GridPlace grid, WaysToCells ways) {
    const vec3 n = abs(view.to_world * blocker.normal);
    const float reach = 0.5 * grid.cell * (n.x + n.y + n.z), slack = on_plane + grid.cell / 64.0;
    const float begin = dot(blocker.normal, ways.from - blocker.center), middle = dot(blocker.normal, ways.corner - blocker.center);
    return min(begin, middle - reach) < slack && max(begin, middle + reach) > -slack;
}

// A bit for each of the eight cells that a blocker hides. Where all blockers are listed, all are asked about each way, without a shorter way to
// tell: what other lists must agree with.
uint hidden_cells(GridPlace grid, WaysToCells ways, uint list, inout uint tests) {
    uint hidden = 0u;
    for (uint word = 0u; word < blocker_words; ++word)
        for (uint near = near_blockers(list, word); near != 0u; near &= near - 1u) {
            const uint blocker = 32u * word + uint(findLSB(near));
            if (list != all_listed && !may_part(blockers[blocker], grid, ways)) continue;
            for (uint left = ~hidden & 0xffu; left != 0u; left &= left - 1u) {
                const uint i = uint(findLSB(left));
                ++tests;
                if (stops(blocker, ways.from, in_view(middle_of(grid, cell_around(ways.first, i))))) hidden |= 1u << i;
            }
        }
    return hidden;
}

#endif
