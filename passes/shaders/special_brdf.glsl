// The lighting models that are not for everything: cloth, skin and hair, each behind its bit of light_features.shared.h; and the
// lobes they share with the others of brdf.glsl.
#ifndef PASSES_SHADERS_SPECIAL_BRDF_GLSL
#define PASSES_SHADERS_SPECIAL_BRDF_GLSL
#include "passes/shaders/albedo_fits.shared.h"
#include "passes/shaders/light_features.shared.h"
#include "passes/shaders/material_point.glsl"

const float pi = 3.14159265358979;
// Below this a lobe is narrower than a float's D can hold, and highlights of points alias anyway.
const float smallest_lobe = 0.002;
// Keeps the visibility term finite where a mapped normal leans away from the eye.
const float smallest_cosine = 1e-4;
// How far light of each color wraps around skin, in cosines: red by 0.4, our choice, the others as their mean free paths are
// shorter, 3.67, 1.37 and .68 mm (Jensen et al., A Practical Model for Subsurface Light Transport, 2001, "skin1").
const vec3 skin_wrap = 0.4 / 3.67 * vec3(3.67, 1.37, 0.68);
const float skin_f0 = 0.028;  // an index of refraction of 1.4
const float hair_f0 = 0.0465;  // 1.55
// Of the light that enters a fiber this share comes back after a reflection inside, the rest from fiber to fiber.
const float hair_inside = 0.25;

// The bit that shading a model needs, 0 where every shader knows it.
uint model_feature(uint lighting_model) {
    if (lighting_model == model_cloth) return feature_cloth;
    if (lighting_model == model_skin) return feature_skin;
    return lighting_model == model_hair ? feature_hair : 0u;
}

bool is_special(MaterialPoint m, uint feature, uint features) {
    return (features & feature) != 0u && model_feature(m.lighting_model) == feature;
}

// All unit.
struct Directions {
    vec3 normal, l, v, h;  // h halves the angle between l and v
};

float fifth_power(float x) { return x * x * x * x * x; }

vec3 schlick(vec3 f0, float cosine) { return f0 + (1.0 - f0) * fifth_power(1.0 - clamp(cosine, 0.0, 1.0)); }

float fitted_albedo(vec4 fit[6], float s, float lobe) {
    vec4 by_lobe = fit[5];
    for (int i = 4; i >= 0; --i) by_lobe = by_lobe * s + fit[i];
    return dot(by_lobe, vec4(1.0, lobe, lobe * lobe, lobe * lobe * lobe));
}

float ggx_width(float roughness) { return max(roughness * roughness, smallest_lobe); }

// D V. |n x h|^2 instead of 1 - dot(n,h)^2: the difference cancels in a float exactly where the lobe is sharp.
float ggx(Directions d, float roughness) {
    const float lobe = ggx_width(roughness);
    const float a2 = lobe * lobe;
    const float n_l = max(dot(d.normal, d.l), smallest_cosine), n_v = max(dot(d.normal, d.v), smallest_cosine);
    const float n_h = clamp(dot(d.normal, d.h), 0.0, 1.0);
    const vec3 off = cross(d.normal, d.h);
    // A normal that leans away from both, of a map or extrapolated beyond an edge, is as far off the lobe as can be: without
    // the condition n x h would vanish again behind the surface and light it as in the mirror's direction.
    const float spread = n_h > 0.0 ? a2 * n_h * n_h + dot(off, off) : 1.0;
    const float distribution = a2 / (pi * spread * spread);
    const float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2));
    return distribution * visibility;
}

// What ggx() reflects of a uniform sky towards a cosine: x with a Fresnel term of 1, y with one of (1 - l.h)^5.
vec2 ggx_albedo(float n_v, float roughness) {
    const float lobe = ggx_width(roughness), cosine = clamp(n_v, smallest_cosine, 1.0);
    const float rough = max(roughness, 0.1), s = max(cosine, 0.002);
    const float grazing = fitted_albedo(ggx_fresnel_fit, s / (s + rough * rough), rough) * fifth_power(1.0 - cosine);
    return vec2(min(fitted_albedo(ggx_albedo_fit, cosine / (cosine + lobe), lobe), 1.0), grazing);
}

// Fuzz over Lambert. The distribution of Estevez & Kulla (Production Friendly Microfacet Sheen BRDF, SIGGRAPH 2017) with the
// visibility of Neubelt & Pettineo (Crafting a Next-Gen Material Pipeline for The Order: 1886, 2013), which for alpha below 0.25
// would reflect more than it gets: 1.41 at 0.09. Single fibers tint less than the cloth: the square root of its color, our choice.
// The fuzz takes from the layer below what it reflects, on the way in and on the way out.
vec3 cloth(MaterialPoint m, Directions d) {
    const float lobe = mix(0.25, 1.0, m.roughness);
    const float n_l = clamp(dot(d.normal, d.l), smallest_cosine, 1.0), n_v = clamp(dot(d.normal, d.v), smallest_cosine, 1.0);
    const vec3 off = cross(d.normal, d.h);
    const float spread = dot(d.normal, d.h) > 0.0 ? dot(off, off) : 1.0;  // leaning away from both, as ggx()
    const float distribution = (2.0 + 1.0 / lobe) * pow(max(spread, 1e-12), 0.5 / lobe) / (2.0 * pi);
    const float visibility = 0.25 / (n_l + n_v - n_l * n_v);
    const vec3 tint = sqrt(max(m.base_color, 0.0));
    const vec3 into = 1.0 - tint * fitted_albedo(sheen_albedo_fit, sqrt(n_l), lobe);
    const vec3 out_of = 1.0 - tint * fitted_albedo(sheen_albedo_fit, sqrt(n_v), lobe);
    return tint * (distribution * visibility) + m.base_color * into * out_of / pi;
}

// The cosine by which the color that wraps farthest is lit.
float skin_cosine(float n_l) { return max(n_l + skin_wrap.x, 0.0) / (1.0 + skin_wrap.x); }

// Two GGX lobes of 0.75 and 1.3 times the roughness, 85 % and 15 % (Unreal Engine's subsurface profile), over diffuse light that
// wraps around, divided by (1 + wrap)^2 so that it adds up to the base color (McAuley, Energy-Conserving Wrapped Diffuse, 2011),
// of what the sharper lobe, which reflects more, lets in.
// Instead of scattering: no blur across shadows or texture, no curvature, no light through thin parts.
vec3 skin(MaterialPoint m, Directions d) {
    const float n_l = dot(d.normal, d.l);
    const float cosine = max(skin_cosine(n_l), smallest_cosine);
    const vec3 wrapped = max(n_l + skin_wrap, 0.0) / ((1.0 + skin_wrap) * (1.0 + skin_wrap));
    const float lobes = 0.85 * ggx(d, 0.75 * m.roughness) + 0.15 * ggx(d, min(1.3 * m.roughness, 1.0));
    const vec2 sky = ggx_albedo(dot(d.normal, d.v), 0.75 * m.roughness);
    const float entering = 1.0 - mix(sky.y, sky.x, skin_f0);
    const vec3 specular = lobes * max(n_l, 0.0) * schlick(vec3(skin_f0), dot(d.l, d.h));
    return (m.base_color / pi * entering * wrapped + specular) / cosine;
}

float gauss(float x, float width) { return exp(-0.5 * x * x / (width * width)) / (width * sqrt(2.0 * pi)); }

// Where a direction points around the fiber. The cosine of half the angle phi between two of them is half the length of their sum,
// also where phi is nearly pi, and cos(phi) all but -1.
vec3 across_fiber(vec3 direction, vec3 along) {
    const vec3 across = direction - along * dot(direction, along);
    return across / max(length(across), smallest_cosine);
}

// Kajiya & Kay's cylinder (1989) with the two highlights of Marschner et al. 2003 as Scheuermann (Practical Real-Time Hair
// Rendering and Shading, 2004) draws them, the white one towards the tip and the colored one towards the root, their shape from
// Karis, Tafuri (Physically Based Hair Shading in Unreal, 2016). m.normal is the fiber, towards its tip. Both lobes are
// normalized along the fiber (in sines) and around it (cos(phi / 2) / 4), the cylinder by pi^2.
vec3 hair(MaterialPoint m, Directions d) {
    const float s_l = dot(d.normal, d.l), s_v = dot(d.normal, d.v);
    const float around = 0.125 * length(across_fiber(d.l, d.normal) + across_fiber(d.v, d.normal));
    const float width = max(m.roughness * m.roughness, 0.01);
    const float white = gauss(s_l + s_v + 0.07, width) * around;
    const float colored = gauss(s_l + s_v - 0.14, 2.0 * width) * around;
    const vec3 mirrored = schlick(vec3(hair_f0), 0.5 * length(d.l + d.v));
    return mirrored * white + (1.0 - mirrored) * m.base_color * (hair_inside * colored + (1.0 - hair_inside) / (pi * pi));
}

#endif
