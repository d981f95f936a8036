// How much of a light reaches a point, by its shadow maps: percentage-closer filtering (Reeves, Salesin, Cook 1987), and for soft
// lights percentage-closer soft shadows (Fernando 2005; docs/algorithms/lighting.md 6.1 to 6.3). Whoever includes this declares
// `sampler2DArray shadow_maps` before, fixes the constants (passes/shadows/filter.h), and after it includes
// passes/shaders/plain_kernel.glsl or says itself what a fixed kernel gives.
#ifndef PASSES_SHADERS_SHADOW_FILTER_GLSL
#define PASSES_SHADERS_SHADOW_FILTER_GLSL
#include "passes/shaders/light_features.shared.h"
#include "passes/shaders/light_types.glsl"
#include "passes/shaders/scene.glsl"

layout(constant_id = 60) const int shadow_kernel = 4;         // texels per edge of the fixed kernel
layout(constant_id = 61) const float shadow_slope_limit = 20.0;  // tangent between normal and light that the bias makes up for
layout(constant_id = 62) const uint shadow_allocation = 0u;   // Allocation of passes/scene/shadow_views.h
layout(constant_id = 63) const int shadow_search_taps = 16;
layout(constant_id = 64) const int shadow_filter_taps = 32;
layout(constant_id = 65) const uint shadow_noise = 0u;        // 1: the discs of taps are turned pixel by pixel

const float cascade_blend_share = 0.1;  // of a cascade's depth (docs/algorithms/lighting.md 6.4)
const float least_disc_radius = 0.5;     // penumbrae are 1 to 64 texels wide (docs/algorithms/lighting.md 6.2)
const float greatest_disc_radius = 32.0;
// Tangent between normal and light up to which the receiver moves towards the light; what is steeper follows the receiver's plane.
const float moved_slope = 4.0;

// A receiver in a map: where, in texels with centers at +.5, how deep, and what its plane gains in depth per texel: `gradient` over
// every texel, `rise` over those alone that the plane crosses nearer to the light than the receiver. Of those that it crosses
// farther away, what is nearer than the plane but not than the receiver does not shade the receiver.
struct MapPoint {
    ivec3 corner;    // of the map: its first texel, its layer
    int size;
    bool at_seams;   // a face of a cube: taps stay on it
    bool sun;
    vec2 u;
    float depth;
    vec2 gradient;
    float penumbra;  // its width in texels per depth between receiver and blocker
    vec2 rise;
    float risen;     // what the receiver has moved for: of the rise, what is above it counts
};

ivec2 kept_on_face(MapPoint p, ivec2 texel) { return p.at_seams ? clamp(texel, ivec2(0), ivec2(p.size - 1)) : texel; }

// Outside the map and where nothing was drawn depth is 0: infinitely far from the light.
float map_depth(MapPoint p, ivec2 texel) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(p.size)))) return 0.0;
    return texelFetch(shadow_maps, p.corner + ivec3(texel, 0), 0).r;
}

// Of the receiver's plane over a texel's center.
float plane_depth(MapPoint p, ivec2 texel) {
    const vec2 away = vec2(texel) + 0.5 - p.u;
    return max(p.depth + dot(p.gradient, away) + max(dot(p.rise, away) - p.risen, 0.0), 0.0);
}

uint is_lit(MapPoint p, ivec2 texel) {
    const ivec2 at = kept_on_face(p, texel);
    return plane_depth(p, at) >= map_depth(p, at) ? 1u : 0u;
}

uint kernel_weight(int tap, uint f) { return tap == 0 ? 256u - f : tap == shadow_kernel - 1 ? f : 256u; }

// Where the kernel lies: its first texel, and how far u is beyond the center of the one that begins its middle, in 1/256.
struct KernelPlace {
    ivec2 first;
    uvec2 f;
};

KernelPlace kernel_place(vec2 u) {
    const vec2 corner = floor(u - 0.5);
    const uvec2 f = min(uvec2(256.0 * (u - 0.5 - corner)), uvec2(255u));
    return KernelPlace(ivec2(corner) - (shadow_kernel / 2 - 1), f);
}

const uint kernel_total = uint((shadow_kernel - 1) * (shadow_kernel - 1)) * 65536u;

float share_of_weight(uint sum) { return sum == kernel_total ? 1.0 : float(sum) * (1.0 / float(kernel_total)); }

// N x N texels with the weights of (N-1)^2 bilinear taps, as integers of 1/256, so that all lit is exactly 1 on every device.
float fixed_kernel(MapPoint p) {
    const KernelPlace k = kernel_place(p.u);
    uint sum = 0u;
    for (int y = 0; y < shadow_kernel; ++y) {
        uint in_row = 0u;
        for (int x = 0; x < shadow_kernel; ++x) in_row += kernel_weight(x, k.f.x) * is_lit(p, k.first + ivec2(x, y));
        sum += kernel_weight(y, k.f.y) * in_row;
    }
    return share_of_weight(sum);
}

// What whoever includes this says of a lookup by the fixed kernel, in a map of shadows: the share that is lit, and the same where
// the kernel reaches no texel of the map.
float fixed_share(uint record, MapPoint p);
float outside_share(uint record);

// Taps of a disc: tap i of n lies sqrt((i + .5) / n) out, each a golden angle (2.39996323) on from the one before (Vogel 1979).
// Turned by a matrix: sines of large angles are no two devices' the same.
vec2 golden_turn(vec2 d) { return vec2(-0.73736888 * d.x - 0.67549029 * d.y, 0.67549029 * d.x - 0.73736888 * d.y); }

vec2 disc_tap(int i, int n, vec2 direction) { return sqrt((float(i) + 0.5) / float(n)) * direction; }

// Direction of the first tap: by interleaved gradient noise (Jimenez 2014) of the pixel that shows the position, or +u.
vec2 first_direction(vec3 position) {
    if (shadow_noise == 0u) return vec2(1.0, 0.0);
    const vec2 ndc = view.ndc_scale * position.xy / position.z + view.ndc_offset;
    const vec2 pixel = floor((vec2(0.5, -0.5) * ndc + 0.5) * vec2(view.extent));
    const float turn = 6.28318531 * (fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5);
    return vec2(cos(turn), sin(turn));
}

// The penumbra is w (zR - zB) / zB wide on the receiver, where a texel t has t zR meters. With z = near / depth that is
// w (depthB - depthR) / (near t) texels; of the sun, whose depth is in units of its range, w (depthB - depthR) range / t.
float penumbra_per_depth(ShadowRecord map, bool sun) {
    const float near = map.view_to_map[3].z;
    const float per_meter = length(vec3(map.view_to_map[0].z, map.view_to_map[1].z, map.view_to_map[2].z));
    return map.source_width / ((sun ? per_meter : near) * map.texel);
}

// Radius in texels of the disc that the source is, seen from the receiver, where what blocks it has this depth.
float disc_radius(MapPoint p, float blocker_depth) {
    return clamp(0.5 * p.penumbra * (blocker_depth - p.depth), least_disc_radius, greatest_disc_radius);
}

// Mean depth of the texels of a disc that stand before the receiver; 0 where none does. Distances are averaged, not depths.
float mean_blocker(MapPoint p, vec2 direction) {
    const float radius = disc_radius(p, 1.0);
    float sum = 0.0, blockers = 0.0;
    for (int i = 0; i < shadow_search_taps; ++i) {
        const ivec2 texel = kept_on_face(p, ivec2(floor(p.u + radius * disc_tap(i, shadow_search_taps, direction))));
        direction = golden_turn(direction);
        const float depth = map_depth(p, texel);
        if (depth <= plane_depth(p, texel)) continue;
        sum += p.sun ? depth : 1.0 / depth;
        blockers += 1.0;
    }
    return blockers == 0.0 ? 0.0 : p.sun ? sum / blockers : blockers / sum;
}

uint bilinear_lit(MapPoint p, vec2 u) {
    const vec2 corner = floor(u - 0.5);
    const uvec2 f = min(uvec2(256.0 * (u - 0.5 - corner)), uvec2(255u));
    const ivec2 texel = ivec2(corner);
    const uint upper = (256u - f.x) * is_lit(p, texel) + f.x * is_lit(p, texel + ivec2(1, 0));
    const uint lower = (256u - f.x) * is_lit(p, texel + ivec2(0, 1)) + f.x * is_lit(p, texel + ivec2(1, 1));
    return (256u - f.y) * upper + f.y * lower;
}

// A disc as wide as the penumbra.
float soft_kernel(MapPoint p, vec2 direction) {
    const float blocker = mean_blocker(p, direction);
    if (blocker == 0.0) return 1.0;
    const float radius = disc_radius(p, blocker);
    uint sum = 0u;
    for (int i = 0; i < shadow_filter_taps; ++i) {
        sum += bilinear_lit(p, p.u + radius * disc_tap(i, shadow_filter_taps, direction));
        direction = golden_turn(direction);
    }
    const uint total = uint(shadow_filter_taps) * 65536u;
    return sum == total ? 1.0 : float(sum) * (1.0 / float(total));
}

// What a plane gains in map depth per texel: along two of its directions a and b, g . d(uv) = d(depth).
vec2 plane_gradient(ShadowRecord map, vec4 at, vec3 normal) {
    const vec3 a = normalize(cross(abs(normal.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), normal));
    const vec4 along_a = map.view_to_map * vec4(a, 0.0), along_b = map.view_to_map * vec4(cross(normal, a), 0.0);
    const vec3 da = along_a.xyz - along_a.w * at.xyz / at.w, db = along_b.xyz - along_b.w * at.xyz / at.w;
    const float area = da.x * db.y - da.y * db.x;
    if (abs(area) < 1e-6 * length(da.xy) * length(db.xy)) return vec2(0.0);  // edge on: no plane over the map
    return vec2(da.z * db.y - db.z * da.y, da.x * db.z - db.x * da.z) / (area * float(map.size));
}

// The share of one map. The receiver moves along the light's ray, so shadows stay where they are: by the map's bias, and by what a
// plane gains on the light over the fixed kernel's corner and half a texel. Texels lie across the map's axis, not across the ray: a
// plane that the ray meets squarely still gains if the axis does not. A soft kernel follows the plane, tap by tap. A fixed one follows
// the part of the slope above `moved_slope`: under a sun 3 degrees high the receiver would have to move 64 texels to make up for it, past
// whatever stands on the ground so near.
float one_map(LightRecord light, uint record, vec3 position, vec3 normal, bool soft) {
    const ShadowRecord map = shadows[record];
    const bool sun = !light_has_range(light.type);
    const vec3 offset = light.position - position;
    const vec3 to_light = sun ? -light.direction : normalize(offset);
    const float cosine = clamp(dot(normal, to_light), 1e-3, 1.0);
    const vec3 axis = sun ? to_light : vec3(map.view_to_map[0].w, map.view_to_map[1].w, map.view_to_map[2].w);
    const float tangent = length(cross(normal, axis)) / cosine, slope = min(tangent, shadow_slope_limit);
    const float w = (map.view_to_map * vec4(position, 1.0)).w;
    const float radius = soft ? 0.5 : 0.70710678 * float(shadow_kernel) + 0.5;
    float towards = map.bias + radius * map.texel * w * min(slope, moved_slope);
    if (!sun) towards = min(towards, 0.5 * length(offset));
    const vec4 at = map.view_to_map * vec4(position + towards * to_light, 1.0);
    if (at.w <= 0.0) return outside_share(record);
    const vec2 u = at.xy / at.w * float(map.size);
    const float reach = soft ? greatest_disc_radius + 1.0 : float(shadow_kernel);
    if (any(lessThan(u, vec2(-reach))) || any(greaterThan(u, vec2(map.size + reach)))) return outside_share(record);
    const bool at_seams = !sun && light.shadow_slots > 1u;
    const ivec3 corner = ivec3(map.offset, map.layer);
    MapPoint point = MapPoint(corner, int(map.size), at_seams, sun, u, at.z / at.w, vec2(0.0), 0.0, vec2(0.0), 0.0);
    if (!soft) {
        if (slope > moved_slope) {
            point.rise = slope / tangent * plane_gradient(map, at, normal);
            point.risen = 0.70710678 * float(shadow_kernel) * moved_slope / slope * length(point.rise);
        }
        return fixed_share(record, point);
    }
    point.gradient = plane_gradient(map, at, normal);
    point.penumbra = penumbra_per_depth(map, sun);
    return soft_kernel(point, first_direction(position));
}

// +x, -x, +y, -y, +z, -z of the world.
uint face_of(vec3 from_light) {
    const vec3 size = abs(from_light);
    if (size.x >= size.y && size.x >= size.z) return from_light.x < 0.0 ? 1u : 0u;
    if (size.y >= size.z) return from_light.y < 0.0 ? 3u : 2u;
    return from_light.z < 0.0 ? 5u : 4u;
}

// 1 lit, 0 shadowed. `features` is what the caller's variant can do: feature_shadows, feature_soft_shadows. Of cascades the first
// that reaches the depth serves, blended into the next one over its last tenth and finally into lit.
float filtered_shadow(LightRecord light, vec3 position, vec3 normal, uint features) {
    if ((features & feature_shadows) == 0u || light.shadow == no_index) return 1.0;
    const bool soft = (features & light.features & feature_soft_shadows) != 0u;
    const uint first = light.shadow + shadow_allocation * view.shadow_count;
    if (light_has_range(light.type)) {
        const uint face = light.shadow_slots > 1u ? face_of(view.to_world * (position - light.position)) : 0u;
        return one_map(light, first + face, position, normal, soft);
    }
    float before = 1.0, share = 0.0;
    for (uint record = first; record < first + light.shadow_slots; ++record) {
        const float rest = shadows[record].range_end - position.z;
        if (rest <= 0.0) continue;
        const float here = one_map(light, record, position, normal, soft);
        if (share > 0.0) return here + share * (before - here);
        before = here;
        share = min(rest / (cascade_blend_share * (shadows[record].range_end - shadows[record].range_begin)), 1.0);
        if (share == 1.0) return before;
    }
    return 1.0 + share * (before - 1.0);
}

#endif
