// P6: the lights that are left, in the order of their slots, with the masks of what their pixels test and the features they need.
#ifndef PASSES_LIGHTING_TILED_KEEP_LIGHTS_GLSL
#define PASSES_LIGHTING_TILED_KEEP_LIGHTS_GLSL

bool has_live_portal(LightRecord light, uint blocker_mask, uint portal_mask) {
    for (; blocker_mask != 0u; blocker_mask &= blocker_mask - 1u)
        if ((light_blockers[light.first_blocker + uint(findLSB(blocker_mask))].portals & portal_mask) != 0u) return true;
    return false;
}

// What is left of a light's features in this tile. Shadows are those that shading asks for, blockers and portals those that its
// pixels test; a clip plane counts where it cuts the cell.
uint features_here(LightRecord light, uint blocker_mask, uint portal_mask, TileCells cells) {
    uint here = light.features & ~(feature_blockers | feature_portals | feature_shadows | feature_soft_shadows);
    if (light.visibility_layer != no_index) here |= (light.features | feature_shadows) & shadow_features;
    if (blocker_mask != 0u) here |= feature_blockers;
    if (has_live_portal(light, blocker_mask, portal_mask)) here |= feature_portals;
    bool is_cut = false;
    for (uint i = 0u; i < cell_count(cells) && !is_cut; ++i) is_cut = is_straddled(light, cell_of(cells, i));
    return is_cut ? here : here & ~feature_clip_planes;
}

void keep_light(uint slot, uint place, uint record, TileCells cells) {
    const uint index = lists.initial[slot];
    const bool per_pixel = blocker_use == blockers_per_pixel;
    const uint blocker_mask = per_pixel ? lists.blockers_part[slot] : 0u;
    const uint portal_mask = per_pixel ? lists.portals_part[slot] : 0u;
    lists.final[place] = index;
    records[record].blockers[place] = blocker_mask;
    records[record].portals[place] = portal_mask;
    atomicOr(lists.spectrum, features_here(lights[index], blocker_mask, portal_mask, cells));
    if (blocker_mask != 0u) atomicAdd(lists.pixel_blockers, uint(bitCount(blocker_mask)));
}

void keep_lights(uint record, TileCells cells) {
    const uint thread = gl_LocalInvocationIndex;
    const bool is_killed = thread < most_tile_lights && (lists.killed[thread / 32u] & 1u << (thread & 31u)) != 0u;
    const bool survives = thread < lists.lights && !is_killed;
    const uvec2 place = place_in_group(survives);
    if (survives) keep_light(thread, place.x, record, cells);
    barrier();
    if (thread < most_tile_lights / 2u) {
        const uint low = 2u * thread < place.y ? lists.final[2u * thread] : 0u;
        const uint high = 2u * thread + 1u < place.y ? lists.final[2u * thread + 1u] : 0u;
        records[record].lights[thread] = low | high << 16;
    }
    if (thread == 0u) {
        lists.kept = place.y;
        records[record].counts = place.y;
    }
    barrier();
}

#endif
