// What the lights of a tile add to a sample. All threads of a group walk the same records, so lists and masks are uniform; only
// whether a light gets through to the pixel is not.
#ifndef PASSES_LIGHTING_TILED_TILE_LIGHTS_GLSL
#define PASSES_LIGHTING_TILED_TILE_LIGHTS_GLSL

struct Shaded {
    uint samples;
    uint evaluations;
    uint blocker_tests;
};

// What this tile's pixels may need. Uniform branches on the tile's own features, in a shader that has all, tell what the modes
// gain by having less code from what they gain by skipping it (chapter 3.7).
uint features_of(uint tile) {
    return branches == branches_uniform ? mode_features & records[tile].spectrum : mode_features;
}

float shadow_of(LightRecord l, MaterialPoint m, ivec3 at, uint features) {
    if ((features & feature_shadows) == 0u || has_shadows == 0u || l.visibility_layer == no_index) return 1.0;
    if (shadow_source == shadows_inline)
        return filtered_shadow(l, m.position, facing_normal(m.lighting_model, m.normal, m.position), features);
    return texelFetch(visibility, ivec3(at.xy, int(l.visibility_layer) + at.z), 0).r;
}

// `masks` are the light's blockers and portals to ask. `precise`, so that no mode rounds otherwise than the next.
vec3 light_term(uint index, uvec2 masks, MaterialPoint m, ivec3 at, uint features, inout Shaded shaded) {
    const LightRecord l = lights[index];
    ++shaded.evaluations;
    if ((features & feature_blockers) != 0u) shaded.blocker_tests += uint(bitCount(masks.x));
    if (!light_arrives(l, m, lifted(m), masks, features)) return vec3(0.0);
    const float visible = shadow_of(l, m, at, features);
    if (visible <= 0.0) return vec3(0.0);
    precise const vec3 term = visible * reflected(m, l, features);
    return term;
}

vec3 lights_of_tile(uint tile, MaterialPoint m, ivec3 at, inout Shaded shaded) {
    const uint features = features_of(tile);
    precise vec3 sum = vec3(0.0);
    uint record = tile;
    for (; (record & next_is_light) == 0u; record = records[record].next) {
        const uint count = records[record].counts & 255u;
        for (uint i = 0u; i < count; ++i) {
            const uint index = records[record].lights[i / 2u] >> (16u * (i & 1u)) & 0xffffu;
            sum += light_term(index, uvec2(records[record].blockers[i], records[record].portals[i]), m, at, features, shaded);
        }
    }
    if (record == no_next) return sum;
    for (uint i = record & ~next_is_light; i < view.light_count; ++i) {
        const uvec2 masks = asks_blockers != 0u ? all_asked(lights[i]) : uvec2(0u);
        sum += light_term(i, masks, m, at, features, shaded);
    }
    return sum;
}

#endif
