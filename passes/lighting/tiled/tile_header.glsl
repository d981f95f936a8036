// The head of a tile's record, its mode, and what is counted. The group's first thread writes; all know the numbers.
#ifndef PASSES_LIGHTING_TILED_TILE_HEADER_GLSL
#define PASSES_LIGHTING_TILED_TILE_HEADER_GLSL

#include "passes/lighting/tiled/modes.glsl"

struct TileSum {
    TileStatistics statistics;
    uint in_first_record;
};

TileSum no_lights_yet() { return TileSum(TileStatistics(candidate_count(), 0u, 0u, 0u, 0u, 0u, 0u, 1u), 0u); }

// Links a record to the last one; where none is left, its lights and what follows are shaded without a list.
uint next_record(uint last) {
    if (gl_LocalInvocationIndex == 0u) {
        const uint spare = atomicAdd(used_records, 1u);
        lists.overflow |= overflow_lights;
        lists.record = spare < push.spare_records ? gl_NumWorkGroups.x * gl_NumWorkGroups.y + spare : no_next;
        records[last].next = lists.record != no_next ? lists.record : next_is_light | lists.initial[0];
        if (lists.record != no_next) records[lists.record].next = no_next;
        else lists.spectrum = every_light_feature;
    }
    barrier();
    return lists.record;
}

void add_batch(inout TileSum sum, uint batch) {
    if (batch == 0u) sum.in_first_record = lists.kept;
    sum.statistics.touching += lists.touching;
    sum.statistics.kept += lists.kept;
    sum.statistics.blocker_pairs = max(sum.statistics.blocker_pairs, lists.blocker_pairs);
    sum.statistics.portal_pairs = max(sum.statistics.portal_pairs, lists.portal_pairs);
    sum.statistics.records = batch + 1u;
    if (gl_LocalInvocationIndex == 0u) atomicAdd(counters.lights_killed, lists.lights - lists.kept);
}

// The first mode in the order of their cost that has every feature. A tile that none serves shows that the host's bound of the
// frame's spectra is wrong; it is counted.
uint mode_for(uint spectrum) {
    uint place = 0u;
    while (place + 1u < push.order.count && !serves(push.order.modes[place], spectrum)) ++place;
    if (!serves(push.order.modes[place], spectrum)) atomicAdd(counters.tiles_unserved, 1u);
    return push.order.modes[place] >> 16;
}

void write_empty_tile() {
    if (gl_LocalInvocationIndex != 0u) return;
    records[tile_index()].next = no_next;
    records[tile_index()].counts = empty_tile_mode << 16;
    statistics[tile_index()] = TileStatistics(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    atomicAdd(counters.tiles, 1u);
    atomicAdd(counters.empty_tiles, 1u);
}

void count_tile(TileStatistics tile, bool is_unlisted) {
    atomicAdd(counters.tiles, 1u);
    atomicAdd(counters.lights_touching, tile.touching);
    atomicAdd(counters.lights_kept, tile.kept);
    atomicAdd(counters.portals_none, lists.classes[class_none]);
    atomicAdd(counters.portals_partial, lists.classes[class_partial]);
    atomicAdd(counters.portals_full, lists.classes[class_full]);
    atomicAdd(counters.blockers_none, lists.classes[3u + class_none]);
    atomicAdd(counters.blockers_partial, lists.classes[3u + class_partial]);
    atomicAdd(counters.blockers_full, lists.classes[3u + class_full]);
    if ((tile.overflow & overflow_lights) != 0u) atomicAdd(counters.tiles_over_lights, 1u);
    if ((tile.overflow & overflow_blocker_pairs) != 0u) atomicAdd(counters.tiles_over_blocker_pairs, 1u);
    if ((tile.overflow & overflow_portal_pairs) != 0u) atomicAdd(counters.tiles_over_portal_pairs, 1u);
    if (tile.pixel_blockers != 0u) atomicAdd(counters.tiles_testing_pixels, 1u);
    if (is_unlisted) atomicAdd(counters.unlisted_tiles, 1u);
    atomicMax(counters.most_lights, tile.touching);
    atomicMax(counters.most_blocker_pairs, tile.blocker_pairs);
    atomicMax(counters.most_portal_pairs, tile.portal_pairs);
}

// `last` is the record that the lights beyond most_listed follow.
void write_tile(uint last, TileSum sum) {
    if (gl_LocalInvocationIndex != 0u) return;
    const bool is_unlisted = last == no_next;
    const bool has_more = !is_unlisted && overflow_policy == overflow_batch && view.light_count > most_listed;
    if (has_more) records[last].next = next_is_light | most_listed;
    const uint spectrum = has_more ? every_light_feature : lists.spectrum;
    const uint mode = mode_for(spectrum | push.order.force);
    const uint tile = tile_index();
    records[tile].counts = sum.in_first_record | lists.overflow << 8 | mode << 16;
    records[tile].spectrum = spectrum;
    records[tile].depths = packHalf2x16(vec2(uintBitsToFloat(lists.nearest), uintBitsToFloat(lists.farthest)));
    sum.statistics.pixel_blockers = lists.pixel_blockers;
    sum.statistics.overflow = lists.overflow;
    statistics[tile] = sum.statistics;
    count_tile(sum.statistics, is_unlisted || has_more);
}

#endif
