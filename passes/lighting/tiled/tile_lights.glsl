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
// gain by having less code from what they gain by skipping it (docs/algorithms/lighting.md 3.7).
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

// Where a walk over a tile's lights is: a place in a record, or among the lights without one.
struct LightWalk {
    uint record;
    uint place;
    uint light;
    uvec2 masks;
};

// Goes to the next light; false where there is none.
bool next_light(inout LightWalk walk) {
    while ((walk.record & next_is_light) == 0u && walk.place >= (records[walk.record].counts & 255u)) {
        walk.record = records[walk.record].next;
        walk.place = 0u;
    }
    if (walk.record == no_next) return false;
    if ((walk.record & next_is_light) == 0u) {
        walk.light = records[walk.record].lights[walk.place / 2u] >> (16u * (walk.place & 1u)) & 0xffffu;
        walk.masks = uvec2(records[walk.record].blockers[walk.place], records[walk.record].portals[walk.place]);
        ++walk.place;
        return true;
    }
    walk.light = walk.record & ~next_is_light;
    if (walk.light >= view.light_count) return false;
    walk.masks = asks_blockers != 0u ? all_asked(lights[walk.light]) : uvec2(0u);
    ++walk.record;
    return true;
}

// One loop, so that a light's code, which is most of the shader, is there once.
vec3 lights_of_tile(uint tile, MaterialPoint m, ivec3 at, inout Shaded shaded) {
    const uint features = features_of(tile);
    precise vec3 sum = vec3(0.0);
    LightWalk walk = LightWalk(tile, 0u, 0u, uvec2(0u));
    while (next_light(walk)) sum += light_term(walk.light, walk.masks, m, at, features, shaded);
    return sum;
}

#endif
