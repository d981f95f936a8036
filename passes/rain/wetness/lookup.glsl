// Whether rain arrives: taps of the rain maps around a place, turned by a noise that sticks to the world (docs/algorithms/deferred.md 7.3;
// Lobanchikov and Gruen, S.T.A.L.K.E.R.: Clear Sky, 2009).
#ifndef PASSES_RAIN_WETNESS_LOOKUP_GLSL
#define PASSES_RAIN_WETNESS_LOOKUP_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/rain/wetness/wetness.shared.h"
#include "passes/shaders/hash.shared.h"
#include "passes/shaders/scene.glsl"

layout(constant_id = 1) const int map_size = 1024;
layout(constant_id = 2) const uint jitter = jitter_world;
layout(constant_id = 3) const float radius = 4.0;  // texels
layout(constant_id = 114) const uint directions = 1u;

layout(push_constant, scalar) uniform Push { WetnessPush push; };

layout(set = 0, binding = 0) uniform sampler2DArray rain_map;  // a layer per direction
layout(set = 0, binding = 5) uniform sampler2D records;        // of record.comp: a row per direction, where there are several

const float quarter_turn = 1.57079632679;

// Meters from the cube of 4 m that the eye is in: floats are fine there, wherever in the world it lies.
vec3 world_place(vec3 position) { return push.place + view.to_world * position; }

// The cell around a place, of `cells` per meter; the same as of the whole world position in double.
uvec3 world_cell(vec3 scaled, float cells) { return push.cubes * uint(4.0 * cells) + uvec3(ivec3(floor(scaled))); }

uint noise_at(vec3 place) { return hashed(tap_key, world_cell(place * noise_cells + noise_shift, noise_cells)); }

// Radius in texels around a surface that leans by the sine of its angle to the rain.
float disc_radius(float lean) { return jitter == jitter_none ? 0.70710678 : radius * (1.0 - disc_loss * lean); }

// In texels. The four lie in a quarter of the disc each, evenly over its area.
vec2 tap_offset(uint noise, uint tap, float disc) {
    if (jitter == jitter_none) return vec2(tap & 1u, tap >> 1) - 0.5;
    const uint word = hashed(noise + tap);
    const float around = quarter_turn * (float(tap) + float(word & 0xffffu) / 65536.0);
    return disc * sqrt((float(word >> 16) + 0.5) / 65536.0) * vec2(cos(around), sin(around));
}

RainRecord record_of(uint direction) {
    if (directions == 1u) return push.map;
    const int row = int(direction);
    const vec4 last = texelFetch(records, ivec2(3, row), 0);
    return RainRecord(texelFetch(records, ivec2(0, row), 0), texelFetch(records, ivec2(1, row), 0),
                      texelFetch(records, ivec2(2, row), 0), last.xyz, last.w);
}

// Outside of the map nothing is known to be above.
bool is_reached(vec2 at, float depth, uint direction) {
    const ivec2 texel = ivec2(floor(at));
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(map_size)))) return true;
    return depth >= texelFetch(rain_map, ivec3(texel, direction), 0).r;
}

// The share of a direction's rain that falls on the front of a surface: all or nothing, but for directions that graze it, so that no
// wall flickers. Of one direction the slope's weight decides.
float share_in_front(uint direction, vec3 normal) {
    if (directions == 1u) return 1.0;
    return clamp(0.5 + dot(normal, record_of(direction).towards_rain) / grazing_width, 0.0, 1.0);
}

// How many of four taps the rain of a direction reaches. The place moves out along its normal, by as much as lifts a tap at the rim of
// the disc over the surface's own plane, so that no plane shelters itself, however steep.
uint taps_reached(uint direction, vec3 position, vec3 normal, uint noise) {
    const RainRecord map = record_of(direction);
    const float lean = min(length(cross(normal, map.towards_rain)), 1.0), disc = disc_radius(lean);
    const vec4 moved = vec4(position + normal * ((disc + 1.0) * map.texel * lean), 1.0);
    const vec2 at = vec2(dot(map.u, moved), dot(map.v, moved));
    const float depth = max(dot(map.depth, moved), 0.0);
    uint reached = 0u;
    for (uint tap = 0u; tap < 4u; ++tap) reached += is_reached(at + tap_offset(noise, tap, disc), depth, direction) ? 1u : 0u;
    return reached;
}

// 0 sheltered, 1 open: the mean of all directions, each with taps of its own.
float rain_visibility(vec3 position, vec3 normal) {
    const uint noise = noise_at(world_place(position));
    float reached = 0.0;
    for (uint i = 0u; i < directions; ++i)
        reached += float(taps_reached(i, position, normal, noise + 4u * i)) * share_in_front(i, normal);
    return reached / float(4u * directions);
}

#endif
