// Combine (docs/algorithms/deferred.md 8.2, 8.3): emission, reflected light and light from all around, seen through the fog, and
// the sunlight that the air before it scatters; linear, per sample. In a plain pixel the first sample stands for all
// (docs/algorithms/deferred.md 3.1).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/combine/hi_lo/hi_lo.shared.h"
#include "passes/edges/plain_pixels.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/lighting/material_table.glsl"
#include "passes/shaders/lights.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 1) const uint has_surfaces = 0u;
layout(constant_id = 2) const uint has_light = 0u;
layout(constant_id = 3) const uint has_occlusion = 0u;
layout(constant_id = 4) const uint has_indirect = 0u;
layout(constant_id = 5) const uint has_shafts = 0u;
layout(constant_id = 104) const uint has_fog = 0u;
layout(constant_id = 105) const uint fog = fog_exponential;
layout(constant_id = 106) const uint fog_distance = fog_as_recorded;
layout(constant_id = 107) const uint fog_sky = fog_sky_apart;
layout(constant_id = 108) const uint hemisphere = hemisphere_recorded;

layout(set = 0, binding = 3) uniform sampler2DArray emission;
layout(set = 0, binding = 4) uniform sampler2DArray light;
layout(set = 0, binding = 5) uniform sampler2DArray occlusion;
layout(set = 0, binding = 6) uniform sampler2DArray indirect;
layout(set = 0, binding = 7) uniform sampler2DArray shafts;
layout(set = 0, binding = 8, rgba32f) writeonly uniform image2DArray color;
layout(push_constant, scalar) uniform Push { LinearFog linear_fog; };

vec3 light_at(ivec3 at) { return has_light != 0u ? texelFetch(light, at, 0).rgb : vec3(0.0); }

// Sky and ground in a direction of the world.
vec3 hemisphere_towards(vec3 direction) { return mix(view.ground, view.sky, 0.5 + 0.5 * normalize(direction).y); }

// The talk's: the table is asked with the material's occlusion for the cosine of the light, and with 1 - (n.v)^2 for that of the halfway
// vector. The highlight mirrors the hemisphere, with the mirrored direction's height y taken as 2 y - 1: only what points up sees sky.
vec3 hemisphere_by_table(MaterialPoint m) {
    const vec3 normal = facing_normal(m.lighting_model, m.normal, m.position), to_point = normalize(m.position);
    const vec3 mirrored = view.to_world * reflect(to_point, normal);
    const float cosine = dot(normal, to_point);
    const uint slice = slice_of(m);
    const vec2 shares = table_at(m.occlusion, 1.0 - cosine * cosine, slice);
    const vec3 highlight = gloss_of(m, slice) * shares.y * hemisphere_towards(vec3(mirrored.x, 2.0 * mirrored.y - 1.0, mirrored.z));
    return m.base_color * shares.x * hemisphere_towards(view.to_world * normal) + highlight;
}

vec3 hemisphere_at(MaterialPoint m) {
    if (hemisphere == hemisphere_table) return hemisphere_by_table(m);
    return hemisphere_light(m);
}

// The material's occlusion and the screen's both multiply (docs/algorithms/deferred.md 8.3).
vec3 ambient(MaterialPoint m, ivec3 at) {
    if (m.lighting_model == model_unlit) return vec3(0.0);
    vec3 sum = hemisphere_at(m);
    if (has_indirect != 0u) sum += m.base_color * ((1.0 - m.metallic) * m.occlusion) * texelFetch(indirect, at, 0).rgb;
    return has_occlusion != 0u ? sum * texelFetch(occlusion, at, 0).r : sum;
}

// Fog over a surface that is so many meters away (docs/algorithms/deferred.md 8.2).
vec3 fogged(vec3 radiance, float meters) {
    if (fog == fog_exponential && fog_sky == fog_sky_apart) return apply_fog(radiance, meters);
    float share = 1.0 - fog_remains(meters);
    if (fog == fog_linear) share = clamp(linear_fog.factor * meters + linear_fog.offset, 0.0, 1.0);
    const vec3 sum = mix(radiance, view.fog_color, share);
    if (fog_sky == fog_sky_apart) return sum;
    return mix(sum, view.background, share * share);
}

vec3 composed(ivec3 at) {
    if (has_surfaces == 0u) return view.background;
    const vec4 own = texelFetch(emission, at, 0);
    if (own.a == 0.0) return view.background;
    const Surface s = surface_at(at);
    const MaterialPoint m = lit_point(s, uvec2(at.xy));
    const vec3 radiance = own.rgb + light_at(at) + ambient(m, at);
    if (has_fog == 0u) return radiance;
    return fogged(radiance, fog_way(m.position, fog_distance == fog_as_recorded ? view.fog_path : fog_distance));
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color))) || at.z > 0 && is_plain(at.xy)) return;
    vec4 sum = vec4(composed(at), 1.0);
    if (has_shafts != 0u) sum.rgb += texelFetch(shafts, at, 0).rgb;
    imageStore(color, at, sum);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(color).z; ++i) imageStore(color, ivec3(at.xy, i), sum);
}
