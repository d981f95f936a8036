// Water on surfaces: rings where drops fall, streams on walls, puddles. Heights in meters; positions as world_place() has them, so
// that patterns stick to the world.
#ifndef PASSES_RAIN_WETNESS_WATER_GLSL
#define PASSES_RAIN_WETNESS_WATER_GLSL
#include "passes/rain/wetness/lookup.glsl"

layout(constant_id = 4) const float ripple_height = 0.002;  // meters
layout(constant_id = 5) const float flow_height = 0.003;    // meters
layout(constant_id = 6) const float puddles = 0.5;

float unit_of(uint word) { return float(word >> 8) / 16777216.0; }

// --- rings ------------------------------------------------------------------------------------------------------------------

// Slope of a ring of height 1 and width 1 at x from its crest: of (1 - x^2)^2 cos(2 pi x).
float ring_slope(float x) {
    const float rest = 1.0 - x * x, turn = 4.0 * quarter_turn;
    if (rest <= 0.0) return 0.0;
    return -4.0 * x * rest * cos(turn * x) - turn * rest * rest * sin(turn * x);
}

// The gradient that one cell's drop makes at a point, in cells from the cell's corner.
vec2 drop_gradient(uvec2 cell, vec2 at) {
    const float turned = push.ring_phase + unit_of(hashed(turn_key, uvec3(cell, 0u)));
    const bool is_next = turned >= 1.0;
    const float phase = is_next ? turned - 1.0 : turned;
    const uint drop = hashed(drop_key, uvec3(cell, push.ring_turns + (is_next ? 1u : 0u)));
    if (unit_of(hashed(drop)) >= push.intensity) return vec2(0.0);
    const vec2 place = vec2(drop & 0xffffu, drop >> 16) / 65536.0;
    const vec2 away = (at - place) / ring_cells;
    const float distance = length(away);
    if (distance < 1e-6) return vec2(0.0);
    const float height = 6.75 * phase * (1.0 - phase) * (1.0 - phase) * ripple_height;
    return height / ring_width * ring_slope((distance - ring_radius * phase) / ring_width) / distance * away;
}

// Of the water's height, along x and z of the world.
vec2 ring_gradient(vec3 place) {
    const vec2 scaled = place.xz * ring_cells - 0.5, corner = floor(scaled);
    const uvec2 first = push.cubes.xz * uint(4.0 * ring_cells) + uvec2(ivec2(corner));
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < 4u; ++i) {
        const uvec2 step = uvec2(i & 1u, i >> 1);
        sum += drop_gradient(first + step, scaled + 0.5 - corner - vec2(step));
    }
    return sum;
}

// --- value noise ------------------------------------------------------------------------------------------------------------

float lattice(uint key, uvec2 cell) { return unit_of(hashed(key, uvec3(cell, 0u))); }

// Noise 0..1 between lattice points, and its change along x per cell.
vec2 noise_with_slope(uint key, uvec2 cell, vec2 part) {
    const vec2 f = part * part * part * (part * (part * 6.0 - 15.0) + 10.0);
    const float along = 30.0 * part.x * part.x * (part.x * (part.x - 2.0) + 1.0);
    const float a = lattice(key, cell), b = lattice(key, cell + uvec2(1u, 0u));
    const float c = lattice(key, cell + uvec2(0u, 1u)), d = lattice(key, cell + uvec2(1u, 1u));
    return vec2(mix(mix(a, b, f.x), mix(c, d, f.x), f.y), mix(b - a, d - c, f.y) * along);
}

// --- streams ----------------------------------------------------------------------------------------------------------------

// Steps of speed: 10 on vertical faces. Rounded, or the time would pull neighbors apart (docs/algorithms/deferred.md 7.5).
uint flow_steps(float up) { return uint(clamp(ceil(10.0 * (1.0 - up)), 0.0, 10.0)); }

// Change of the water's height across streams that run down a face, along `across`, x or z of the world.
float stream_slope(uint key, float across, uint across_cubes, float height, uint steps) {
    const float down = height * flow_lengths + float(steps) * push.flow_phase;
    const float side = across * flow_cells;
    const uvec2 base = uvec2(across_cubes * uint(4.0 * flow_cells),
                             push.cubes.y * uint(4.0 * flow_lengths) + steps * push.flow_turns);
    const vec2 at = vec2(side, down), corner = floor(at);
    return flow_height * flow_cells * noise_with_slope(key, base + uvec2(ivec2(corner)), at - corner).y;
}

// --- puddles ----------------------------------------------------------------------------------------------------------------

float puddle_noise(uint key, vec3 place, float cells) {
    const vec2 at = place.xz * cells, corner = floor(at);
    return noise_with_slope(key, push.cubes.xz * uint(4.0 * cells) + uvec2(ivec2(corner)), at - corner).x;
}

// 1 in a puddle, 0 outside.
float puddle_at(vec3 place) {
    const float level = puddle_share * puddles * push.wetness;
    if (level <= 0.0) return 0.0;
    const float ground = (2.0 * puddle_noise(puddle_key, place, puddle_cells) +
                          puddle_noise(fine_puddle_key, place, fine_puddle_cells)) / 3.0;
    return clamp((level - ground) / puddle_rim, 0.0, 1.0);
}

#endif
