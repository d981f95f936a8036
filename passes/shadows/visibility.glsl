// The visibility image: every shadowed light at every sample of the G-buffer. Included by the compute shaders of techniques, which
// say before what their variant can do: `const uint shadow_features`. After it they say what a fixed kernel gives
// (passes/shaders/shadow_filter.glsl), and in count_kernels() what a thread has counted of that when it is done.
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/shaders/camera.glsl"
#include "passes/shaders/sample_places.glsl"
#include "passes/shadows/shadows.shared.h"
#include "passes/gbuffer/surface_at.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 3) const uint layer_kilotexels = 0u;  // of shadow_maps, all layers together
layout(constant_id = 16) const uint drawn_kilotexels = 0u;  // of the maps that are read

layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 1) uniform sampler2DArray depth_layers;
layout(set = 0, binding = 5, r16f) writeonly uniform image2DArray visibility;
layout(set = 0, binding = 6, scalar) buffer Counters { ShadowCounters counters; };
#include "passes/shaders/shadow_filter.glsl"

void count_kernels();

// Depth is a sample's own, so the ray is too: then position lies on the surface.
vec2 sample_position(uint i) { return 0.5 + sample_place(view.samples, i); }

void count(uint filtered_here, uint penumbra_here) {
    const uint filtered_sum = subgroupAdd(filtered_here);
    const uint penumbra_sum = subgroupAdd(penumbra_here);
    if (subgroupElect()) {
        if (filtered_sum > 0u) atomicAdd(counters.filtered, filtered_sum);
        if (penumbra_sum > 0u) atomicAdd(counters.penumbra, penumbra_sum);
    }
}

void count_texels() {
    atomicAdd(counters.kilotexels_drawn, drawn_kilotexels);
    atomicAdd(counters.kilotexels_allocated, layer_kilotexels);
}

// Where a thread looks its shadow up.
struct Spot {
    vec2 place;   // in the pixel
    float depth;  // 0: no surface
};

// Of a plain pixel, whose samples lie on one plane, the pixel's center: depth is affine on the screen, and the center is the mean
// of the samples' places. The first sample's own place would shift every shadow by .4 pixels.
Spot spot_of(ivec3 at) {
    if (view.samples == 1u || !is_plain(at.xy)) return Spot(sample_position(uint(at.z)), texelFetch(depth_layers, at, 0).r);
    float sum = 0.0, least = 1.0;
    for (int i = 0; i < int(view.samples); ++i) {
        const float depth = texelFetch(depth_layers, ivec3(at.xy, i), 0).r;
        sum += depth;
        least = min(least, depth);
    }
    return Spot(vec2(0.5), least > 0.0 ? sum / float(view.samples) : 0.0);
}

// In a plain pixel one shadow stands for all samples (docs/algorithms/deferred.md 3.1).
void store_share(ivec3 at, int layer, float share) {
    imageStore(visibility, ivec3(at.xy, layer + at.z), vec4(share));
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < int(view.samples); ++i) imageStore(visibility, ivec3(at.xy, layer + i), vec4(share));
}

void main() {
    if (gl_GlobalInvocationID == uvec3(0u)) count_texels();
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, view.extent))) return;
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (at.z > 0 && is_plain(at.xy)) return;
    const Spot spot = spot_of(at);
    vec3 position = vec3(0.0), normal = vec3(0.0);
    if (spot.depth > 0.0) {
        const Surface s = surface_at(at);
        position = view_position(vec2(at.xy) + spot.place, view_z(spot.depth));
        normal = facing_normal(s.lighting_model, s.normal, position);
    }
    uint filtered_here = 0u, penumbra_here = 0u;
    for (uint i = 0u; i < view.light_count; ++i) {
        if (lights[i].visibility_layer == no_index) continue;
        float share = 1.0;
        if (spot.depth > 0.0) {
            share = filtered_shadow(lights[i], position, normal, shadow_features);
            ++filtered_here;
            if (share > 0.0 && share < 1.0) ++penumbra_here;
        }
        store_share(at, int(lights[i].visibility_layer), share);
    }
    count(filtered_here, penumbra_here);
    count_kernels();
}
