// P2 to P5: portals first, then blockers, one thread per (light, portal) or (light, blocker). A portal that contains the cell
// cancels its blockers for the whole tile, and a blocker may only kill a light if none of its portals reaches the tile.
//
// What pixels do is in masks per light, not in the pairs: a pair that finds no place among the 256 leaves its bit as it is, and
// the pixels make the test. So an overflow costs time and never changes the picture.
#ifndef PASSES_LIGHTING_TILED_CLASSIFY_PAIRS_GLSL
#define PASSES_LIGHTING_TILED_CLASSIFY_PAIRS_GLSL

// Every test for every pixel: what classification takes away from.
void take_masks() {
    const uint slot = gl_LocalInvocationIndex;
    if (slot < most_tile_lights) {
        const bool asks = slot < lists.lights && blocker_use != blockers_off;
        const LightRecord light = lights[lists.initial[asks ? slot : 0u]];
        lists.portals_full[slot] = 0u;
        lists.portals_part[slot] = asks ? low_bits(light.portals) : 0u;
        lists.blockers_part[slot] = asks ? low_bits(light.blockers) : 0u;
    }
    barrier();
}

// Pairs of a slot with the bits of a mask, light after light, as far as they fit; returns how many there are.
uint pair_up(uint mask) {
    const uint slot = gl_LocalInvocationIndex;
    if (slot < most_tile_lights) lists.final[slot] = uint(bitCount(mask));
    if (slot < most_tile_pairs / 2u) lists.pairs[slot] = 0u;
    barrier();
    uint first = 0u, all = 0u;
    for (uint i = 0u; i < most_tile_lights; ++i) {
        first += i < slot ? lists.final[i] : 0u;
        all += lists.final[i];
    }
    for (; slot < most_tile_lights && mask != 0u && first < most_tile_pairs; mask &= mask - 1u, ++first)
        atomicOr(lists.pairs[first / 2u], (slot << 5 | uint(findLSB(mask))) << (16u * (first & 1u)));
    barrier();
    return all;
}

// x: slot; y: the light's own number of the portal or blocker.
uvec2 pair_of_thread() {
    const uint pair = lists.pairs[gl_LocalInvocationIndex / 2u] >> (16u * (gl_LocalInvocationIndex & 1u));
    return uvec2(pair >> 5 & 63u, pair & 31u);
}

// In all cells of the tile: what holds in each holds in the tile.
uint class_in_tile(BlockerRecord rectangle, LightRecord light, TileCells cells) {
    uint reach = class_partial;
    for (uint i = 0u; i < cell_count(cells); ++i) {
        const uint here = classify_rectangle(rectangle, light_point(light), cell_of(cells, i));
        reach = i == 0u || here == reach ? here : class_partial;
    }
    return reach;
}

void classify_portals(TileCells cells) {
    const uvec2 pair = pair_of_thread();
    const LightRecord light = lights[lists.initial[pair.x]];
    const uint reach = class_in_tile(rectangle_of_portal(light, pair.y), light, cells);
    if (reach == class_full) atomicOr(lists.portals_full[pair.x], 1u << pair.y);
    if (reach != class_partial) atomicAnd(lists.portals_part[pair.x], ~(1u << pair.y));
    atomicAdd(lists.classes[reach], 1u);
}

void classify_blockers(TileCells cells) {
    const uvec2 pair = pair_of_thread();
    const LightRecord light = lights[lists.initial[pair.x]];
    const uint portals = light_blockers[light.first_blocker + pair.y].portals;
    const uint reach = class_in_tile(rectangle_of_blocker(light, pair.y), light, cells);
    if (reach == class_none) atomicAnd(lists.blockers_part[pair.x], ~(1u << pair.y));
    if (reach == class_full && (portals & lists.portals_part[pair.x]) == 0u)
        atomicOr(lists.killed[pair.x / 32u], 1u << (pair.x & 31u));
    atomicAdd(lists.classes[3u + reach], 1u);
}

// Without those that an open portal takes out of the tile.
uint blockers_left(uint slot) {
    if (slot >= lists.lights) return 0u;
    const LightRecord light = lights[lists.initial[slot]];
    uint left = lists.blockers_part[slot];
    for (uint i = 0u; i < light.blockers; ++i)
        if ((light_blockers[light.first_blocker + i].portals & lists.portals_full[slot]) != 0u) left &= ~(1u << i);
    return left;
}

void classify_pairs(TileCells cells) {
    const uint thread = gl_LocalInvocationIndex, slot = min(thread, most_tile_lights - 1u);
    const bool has_slot = thread < most_tile_lights;
    const uint portal_pairs = pair_up(has_slot ? lists.portals_part[slot] : 0u);
    if (thread < min(portal_pairs, most_tile_pairs)) classify_portals(cells);
    barrier();
    const uint left = has_slot ? blockers_left(slot) : 0u;
    if (has_slot) lists.blockers_part[slot] = left;
    const uint blocker_pairs = pair_up(left);
    if (thread < min(blocker_pairs, most_tile_pairs)) classify_blockers(cells);
    if (thread == 0u) {
        lists.portal_pairs = portal_pairs;
        lists.blocker_pairs = blocker_pairs;
        if (portal_pairs > most_tile_pairs) lists.overflow |= overflow_portal_pairs;
        if (blocker_pairs > most_tile_pairs) lists.overflow |= overflow_blocker_pairs;
    }
    barrier();
}

#endif
