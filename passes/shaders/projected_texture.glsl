// Pictures of lights: thrown by spots, emitted by rectangles (docs/algorithms/lighting.md 0.4). The picture's u grows along the
// light's axis_u and its v against axis_v; alpha means nothing. Levels of detail are computed: in a compute shader there are no
// derivatives, and a neighbor may belong to other geometry.
#ifndef PASSES_SHADERS_PROJECTED_TEXTURE_GLSL
#define PASSES_SHADERS_PROJECTED_TEXTURE_GLSL
#include "passes/shaders/camera.glsl"
#include "passes/shaders/material_point.glsl"
#include "passes/shaders/texture.glsl"

vec3 axis_v(LightRecord light) { return cross(light.direction, light.axis_u); }

// A picture of clamped address, filtered linearly: pictures neither repeat nor mirror.
TextureRecord picture(LightRecord light) {
    TextureRecord t = textures[light.texture];
    t.sampling = address_clamp_both;
    return t;
}

// One mip with black around it: beyond the outer texels' centers what is left of them is the share of the taps inside.
vec3 bordered(TextureRecord t, uint mip, vec2 uv) {
    const vec2 size = vec2(max(1u, t.width >> mip), max(1u, t.height >> mip));
    const vec2 at = uv * size - 0.5;
    const vec2 inside = clamp(min(at + 1.0, size - at), 0.0, 1.0);
    return bilinear(t, mip_of(t, mip), uv).rgb * (inside.x * inside.y);
}

vec3 bordered_trilinear(TextureRecord t, vec2 uv, float lod) {
    const float finer = floor(lod);
    const vec3 fine = bordered(t, uint(finer), uv);
    return lod == finer ? fine : mix(fine, bordered(t, uint(finer) + 1u, uv), lod - finer);
}

// Texels of the finest mip that a length covers on a picture of this extent, as a level that exists.
float picture_lod(TextureRecord t, vec2 extent, float covered) {
    const vec2 texels_covered = vec2(t.width, t.height) * covered / extent;
    return min(log2(max(1.0, max(texels_covered.x, texels_covered.y))), float(t.mips - 1u));
}

// Of a spot on what lies at `offset` from it, in front of it: the pixel's footprint on the surface, seen from the light.
vec3 projected_picture(LightRecord light, MaterialPoint m, vec3 offset) {
    const TextureRecord t = picture(light);
    const float depth = dot(offset, light.direction);
    const vec2 half_extent = depth * light.tan_half;
    const vec2 share = vec2(dot(offset, light.axis_u), -dot(offset, axis_v(light))) / half_extent;
    const float facing = max(dot(m.normal, normalize(-m.position)), 0.1);
    const float footprint = 2.0 * m.position.z / (float(view.extent.y) * view.ndc_scale.y * facing);
    return bordered_trilinear(t, 0.5 + 0.5 * share, picture_lod(t, 2.0 * half_extent, footprint));
}

// A lobe of directions by its axis and the tangent of its half width.
struct LightLobe {
    vec3 axis;
    float half_width;
};

// Of a rectangle whose center is at `offset`: where the axis of the lobe meets it, as wide as the lobe is there.
vec3 emitted_picture(LightRecord light, vec3 offset, LightLobe lobe) {
    const TextureRecord t = picture(light);
    const float distance_along = dot(offset, light.direction) / min(dot(lobe.axis, light.direction), -1e-4);
    const vec3 hit = lobe.axis * distance_along - offset;
    const vec2 half_extent = max(light.half_extent, vec2(1e-6));
    const vec2 share = clamp(vec2(dot(hit, light.axis_u), -dot(hit, axis_v(light))) / half_extent, -1.0, 1.0);
    const float lod = picture_lod(t, 2.0 * half_extent, distance_along * lobe.half_width);
    return trilinear(t, 0.5 + 0.5 * share, lod).rgb;
}

#endif
