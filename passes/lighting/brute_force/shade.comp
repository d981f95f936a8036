// Every light on every sample that needs shading of its own. A plain pixel (edges 0) is shaded once for all its samples, whose
// G-buffer words are equal (deferred 3.1).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/gbuffer/surface.glsl"
#include "passes/gbuffer/decoders.glsl"
#include "passes/lighting/brute_force/brute_force.shared.h"
#include "passes/shaders/blockers.glsl"
#include "passes/shaders/lights.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint gbuffer_layout = 0u;
layout(constant_id = 1) const uint has_visibility = 0u;
layout(constant_id = 2) const uint has_edges = 0u;
layout(constant_id = 22) const uint light_features = every_light_feature;

layout(set = 0, binding = 0) uniform sampler2DArray gbuffer0;
layout(set = 0, binding = 1) uniform sampler2DArray gbuffer1;
layout(set = 0, binding = 2) uniform sampler2DArray gbuffer2;
layout(set = 0, binding = 3) uniform sampler2DArray visibility;
layout(set = 0, binding = 4) uniform usampler2DArray edges;
layout(set = 0, binding = 5, rgba16f) writeonly uniform image2DArray light;
layout(set = 0, binding = 6, scalar) buffer Counters { BruteForceCounters counters; };

// Beyond this a half float is infinite, and infinity times nothing is not a number.
const float largest_half = 65504.0;

bool is_plain(ivec2 pixel) { return has_edges != 0u && texelFetch(edges, ivec3(pixel, 0), 0).r == 0u; }

float visibility_of(LightRecord l, ivec3 at) {
    if (has_visibility == 0u || l.visibility_layer == no_index) return 1.0;
    return texelFetch(visibility, ivec3(at.xy, int(l.visibility_layer) + at.z), 0).r;
}

vec3 every_light(MaterialPoint m, ivec3 at) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < view.light_count; ++i)
        if (light_reaches(lights[i], m.position, m.normal))
            sum += visibility_of(lights[i], at) * reflected(m, lights[i], light_features);
    return clamp(sum, -largest_half, largest_half);
}

void count_shaded(bool shaded) {
    const uint here = subgroupAdd(shaded ? 1u : 0u);
    if (!subgroupElect()) return;
    atomicAdd(counters.samples_shaded, here);
    atomicAdd(counters.evaluations, here * view.light_count);
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(light)))) return;
    const bool plain = is_plain(at.xy);
    if (plain && at.z > 0) return;
    const Surface s = decode_gbuffer(gbuffer_layout, texelFetch(gbuffer0, at, 0), texelFetch(gbuffer1, at, 0),
                                     texelFetch(gbuffer2, at, 0), vec2(at.xy) + 0.5);
    const bool shaded = s.exists && s.lighting_model != model_unlit;
    const vec4 radiance = vec4(shaded ? every_light(lit_point(s, uvec2(at.xy)), at) : vec3(0.0), 1.0);
    imageStore(light, at, radiance);
    for (int sample_index = 1; plain && sample_index < imageSize(light).z; ++sample_index)
        imageStore(light, ivec3(at.xy, sample_index), radiance);
    count_shaded(shaded);
}
