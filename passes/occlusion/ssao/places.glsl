// Surfaces as ambient occlusion sees them, and how well one speaks for another.
#ifndef PASSES_OCCLUSION_SSAO_PLACES_GLSL
#define PASSES_OCCLUSION_SSAO_PLACES_GLSL
#include "passes/edges/plain_pixels.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/occlusion/ssao/ssao.shared.h"

layout(constant_id = 1) const uint divisor = 1u;  // pixels a side for which one is estimated
layout(constant_id = 2) const uint edge_stop = edge_stop_plane;
layout(constant_id = 3) const uint material_rule = material_product;  // of steps that write the frame's occlusion

struct Place {
    bool exists;
    vec3 position;  // view space
    vec3 normal;
    float occlusion;  // of the material
};

Place place_at(ivec3 at) {
    const Surface s = surface_at(at);
    if (!s.exists) return Place(false, vec3(0.0), vec3(0.0), 1.0);
    const vec3 position = surface_position(s, uvec2(at.xy));
    return Place(true, position, facing_normal(s.lighting_model, s.normal, position), s.occlusion);
}

// Of the view depth: as far from the tangent plane a surface has no more say.
const float plane_tolerance = 0.02;

// From 0 to 1. Depth: the bilateral weight of docs/algorithms/deferred.md 8.4, which lets a wall speak for the floor before it.
float fit(Place center, Place other) {
    if (!other.exists) return 0.0;
    const float nearer = min(center.position.z, other.position.z);
    if (edge_stop == edge_stop_depth) return clamp(1.0 - 8.0 * abs(center.position.z - other.position.z) / nearer, 0.0, 1.0);
    const float off_plane = abs(dot(other.position - center.position, center.normal));
    return max(0.0, 1.0 - off_plane / (plane_tolerance * center.position.z)) * max(0.0, dot(center.normal, other.normal));
}

// What is stored: a number from 0 to 1, whatever was computed. The darker of both occlusions: combine multiplies by the material's.
float stored(float visibility, Place place) {
    if (isnan(visibility)) return 1.0;
    const float visible = clamp(visibility, 0.0, 1.0);
    if (material_rule == material_product || place.occlusion <= 0.0) return visible;
    return min(1.0, visible / place.occlusion);
}

#endif
