// Sorts every list of the band in place: z ascending, then later submission first. One thread per cell.
// A shell sort with gaps shrinking by 5/11 (Gonnet and Baeza-Yates 1991); short lists are insertion sorted by its last round.
// Not a bubble sort: lavapipe 22.3 miscompiles that, silently, from 8 elements on with run-time bounds.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/sorted_lists/lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1, scalar) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 4, scalar) buffer Keys { ListKey keys[]; };

bool nearer(ListKey a, ListKey b) {
    if (a.z != b.z) return a.z < b.z;
    if (a.draw != b.draw) return a.draw > b.draw;
    return a.primitive > b.primitive;
}

// Insertion sort of every gap-th key.
void sort_gapped(uint first, uint count, uint gap) {
    for (uint i = gap; i < count; ++i) {
        const ListKey key = keys[first + i];
        uint at = i;
        while (at >= gap) {
            const ListKey other = keys[first + at - gap];
            if (!nearer(key, other)) break;
            keys[first + at] = other;
            at -= gap;
        }
        keys[first + at] = key;
    }
}

void sort_list(uint first, uint count) {
    // Up to 12 keys plain insertion moves less than a first gapped round would save.
    uint gap = count > 12u ? count * 5u / 11u : 1u;
    while (gap > 1u) {
        sort_gapped(first, count, gap);
        gap = gap * 5u / 11u;
    }
    sort_gapped(first, count, 1u);
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const uint cell = cell_of(uvec2(at.x, at.y + band.first_row), at.z);
    const uint start = list_start(cell);
    sort_list(start, stored(start, counts[cell]));
}
