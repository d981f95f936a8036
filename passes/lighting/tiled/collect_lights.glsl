// P1: up to 64 lights that reach the tile, in index order, one thread per candidate.
#ifndef PASSES_LIGHTING_TILED_COLLECT_LIGHTS_GLSL
#define PASSES_LIGHTING_TILED_COLLECT_LIGHTS_GLSL

uint listed_lights() { return min(view.light_count, most_listed); }

uint candidate_list() {
    const uvec2 macro_tile = gl_WorkGroupID.xy / (macro_size / tile_size);
    const uint across = (gl_NumWorkGroups.x * tile_size + macro_size - 1u) / macro_size;
    return (macro_tile.y * across + macro_tile.x) * (listed_lights() + 1u);
}

uint candidate_count() { return is_prefiltered != 0u ? candidates[candidate_list()] : listed_lights(); }

uint candidate_light(uint place) { return is_prefiltered != 0u ? candidates[candidate_list() + 1u + place] : place; }

bool touches_tile(LightRecord light, TileCells cells) {
    for (uint i = 0u; i < cell_count(cells); ++i)
        if (light_touches(light, cell_of(cells, i))) return true;
    return false;
}

void begin_tile() {
    const uint thread = gl_LocalInvocationIndex;
    if (thread < 6u) lists.classes[thread] = 0u;
    if (thread == 0u) {
        lists.cursor = lists.overflow = lists.pixel_blockers = 0u;
        lists.spectrum = lists.models;
        records[tile_index()].next = no_next;
    }
    barrier();
}

void begin_batch() {
    barrier();
    if (gl_LocalInvocationIndex == 0u) lists.portal_pairs = lists.blocker_pairs = lists.killed[0] = lists.killed[1] = 0u;
}

// The light that finds no slot any more begins the next batch; where the rest is dropped, it is counted all the same.
void collect_lights(TileCells cells) {
    const uint count = candidate_count();
    const bool drops = overflow_policy == overflow_drop;
    uint found = 0u, first = lists.cursor;
    barrier();
    for (; first < count && (drops || found < most_tile_lights); first += tile_threads) {
        const uint place = first + gl_LocalInvocationIndex;
        const uint index = place < count ? candidate_light(place) : 0u;
        const bool touches = place < count && touches_tile(lights[index], cells);
        const uvec2 slot = found + place_in_group(touches);
        if (touches && slot.x < most_tile_lights) lists.initial[slot.x] = index;
        if (touches && slot.x == most_tile_lights && !drops) lists.cursor = place;
        found = slot.y;
    }
    if (gl_LocalInvocationIndex == 0u) {
        if (drops || found <= most_tile_lights) lists.cursor = min(first, count);
        lists.lights = min(found, most_tile_lights);
        lists.touching = drops ? found : lists.lights;
        if (found > most_tile_lights) lists.overflow |= overflow_lights;
    }
    barrier();
}

#endif
