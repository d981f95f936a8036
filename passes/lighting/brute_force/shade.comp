// Every light on every sample that needs shading of its own. A plain pixel (edges 0) is shaded once for all its samples, whose
// G-buffer words are equal (docs/algorithms/deferred.md 3.1).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/edges/routing/routed.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/lighting/brute_force/light_buffer.glsl"
#include "passes/lighting/light_term.glsl"
#include "passes/lighting/stored_light.glsl"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 6, scalar) buffer Counters { BruteForceCounters counters; };

vec3 term_of(uint i, MaterialPoint m, vec3 above, ivec3 at) {
    if (material_source == materials_recorded && specular == specular_colored) return light_term(i, m, above, at);
    const LightRecord light = lights[i];
    const float visible = share_that_arrives(light, m, above, at);
    return visible > 0.0 ? visible * accumulated(m, light, features) : vec3(0.0);
}

vec3 every_light(MaterialPoint m, ivec3 at) {
    const vec3 above = lifted(m);
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < view.light_count; ++i) sum += term_of(i, m, above, at);
    return sum;
}

void count_shaded(bool shaded) {
    const uint here = subgroupAdd(shaded ? 1u : 0u);
    const bool is_elected = subgroupElect();  // of those that added: after a branch they may be several groups
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
    if (!is_elected) return;
    atomicAdd(counters.samples_shaded, here);
    atomicAdd(counters.evaluations, here * view.light_count);
}

void main() {
    const ivec3 at = place_of_thread(imageSize(light));
    if (any(greaterThanEqual(at, imageSize(light)))) return;
    const Surface s = surface_at(at);
    const bool shaded = takes_light(s);
    store_light(at, shaded ? every_light(lit_point(s, uvec2(at.xy)), at) : vec3(0.0));
    count_shaded(shaded);
}
