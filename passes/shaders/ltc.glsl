// The table of linearly transformed cosines, interpolated, and its matrices (ltc.shared.h). Any shader stage.
#ifndef PASSES_SHADERS_LTC_GLSL
#define PASSES_SHADERS_LTC_GLSL
#include "passes/shaders/material_point.glsl"
#include "passes/shaders/scene.glsl"

LtcRecord mixed(LtcRecord a, LtcRecord b, float t) {
    return LtcRecord(mix(a.m11, b.m11, t), mix(a.m13, b.m13, t), mix(a.m22, b.m22, t), mix(a.m31, b.m31, t), mix(a.m33, b.m33, t),
                     mix(a.albedo, b.albedo, t), mix(a.fresnel, b.fresnel, t));
}

// M is interpolated and not its inverse: it grows with roughness^2 where the inverse falls with 1 / roughness^2.
LtcRecord ltc_at(float roughness, float eye_cosine) {
    const vec2 at = vec2(clamp(roughness, 0.0, 1.0), sqrt(1.0 - clamp(eye_cosine, 0.0, 1.0))) * float(ltc_edge - 1u);
    const uvec2 low = min(uvec2(at), uvec2(ltc_edge - 2u));
    const vec2 f = at - vec2(low);
    const uint first = low.x * ltc_edge + low.y;
    return mixed(mixed(ltc_table[first], ltc_table[first + 1u], f.y),
                 mixed(ltc_table[first + ltc_edge], ltc_table[first + ltc_edge + 1u], f.y), f.x);
}

float ltc_planar_determinant(LtcRecord r) { return r.m11 * r.m33 - r.m13 * r.m31; }

// The inverse of M times the determinant of its xz part: what directions are looked up with needs no scale.
mat3 ltc_inverse(LtcRecord r) {
    return mat3(r.m33, 0.0, -r.m31, 0.0, ltc_planar_determinant(r) / r.m22, 0.0, -r.m13, 0.0, r.m11);
}

// The share of light from everywhere that the lobe reflects. Of many bounces as passes/shaders/brdf.glsl has them.
vec3 ltc_reflectance(LtcRecord r, MaterialPoint m, vec3 f0) {
    const vec3 once = f0 * (r.albedo - r.fresnel) + r.fresnel;
    return m.lighting_model == model_multiscatter_ggx ? once * (1.0 + f0 * (1.0 / r.albedo - 1.0)) : once;
}

// Where the middle of the lobe points in the normal's frame, and the tangent of its half width: that of a cosine lobe is 1.
vec3 ltc_axis(LtcRecord r) { return normalize(vec3(r.m13, 0.0, r.m33)); }
float ltc_half_width(LtcRecord r) { return sqrt(ltc_planar_determinant(r) * r.m22); }

#endif
