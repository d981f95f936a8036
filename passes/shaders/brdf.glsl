// Reflectance of the lighting models (lighting chapter 0.5): Lambert, Burley renormalised by Lagarde & de Rousiers (Frostbite,
// 2014), GGX of Walter et al. 2007 with the height-correlated visibility of Heitz 2014. Any shader stage.
#ifndef PASSES_SHADERS_BRDF_GLSL
#define PASSES_SHADERS_BRDF_GLSL
#include "passes/shaders/material_point.glsl"
#include "passes/shaders/scene.shared.h"

const float pi = 3.14159265358979;
// Below this a lobe is narrower than a float's D can hold, and highlights of points alias anyway.
const float smallest_lobe = 0.002;
// Keeps the visibility term finite where a mapped normal leans away from the eye.
const float smallest_cosine = 1e-4;

float fifth_power(float x) { return x * x * x * x * x; }

// D V F. |n x h|^2 instead of 1 - dot(n,h)^2: the difference cancels in a float exactly where the lobe is sharp.
vec3 ggx_specular(MaterialPoint m, vec3 l, vec3 v, vec3 h) {
    const float lobe = max(m.roughness * m.roughness, smallest_lobe);
    const float a2 = lobe * lobe;
    const float n_l = max(dot(m.normal, l), smallest_cosine), n_v = max(dot(m.normal, v), smallest_cosine);
    const float n_h = clamp(dot(m.normal, h), 0.0, 1.0);
    const vec3 off = cross(m.normal, h);
    // A normal that leans away from both, of a map or extrapolated beyond an edge, is as far off the lobe as can be: without
    // the condition n x h would vanish again behind the surface and light it as in the mirror's direction.
    const float spread = n_h > 0.0 ? a2 * n_h * n_h + dot(off, off) : 1.0;
    const float distribution = a2 / (pi * spread * spread);
    const float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2));
    const vec3 f0 = mix(vec3(0.04), m.base_color, m.metallic);
    const vec3 fresnel = f0 + (1.0 - f0) * fifth_power(1.0 - clamp(dot(l, h), 0.0, 1.0));
    return distribution * visibility * fresnel;
}

// Burley's diffuse over rho / pi, with the energy bias and factor of Frostbite: the plain form reflects up to 1.38.
float burley_shape(MaterialPoint m, vec3 l, vec3 v, vec3 h) {
    const float n_l = clamp(dot(m.normal, l), 0.0, 1.0), n_v = clamp(dot(m.normal, v), smallest_cosine, 1.0);
    const float l_h = clamp(dot(l, h), 0.0, 1.0);
    const float grazing = 0.5 * m.roughness + 2.0 * m.roughness * l_h * l_h - 1.0;
    const float energy = mix(1.0, 1.0 / 1.51, m.roughness);
    return energy * (1.0 + grazing * fifth_power(1.0 - n_l)) * (1.0 + grazing * fifth_power(1.0 - n_v));
}

// f(l, v) per steradian; l and v unit, towards the light and the eye. The cosine is not in it. Unlit surfaces reflect nothing.
vec3 brdf(MaterialPoint m, vec3 l, vec3 v) {
    if (m.lighting_model == model_unlit) return vec3(0.0);
    if (m.lighting_model == model_lambert) return m.base_color / pi;
    const vec3 half_way = l + v;
    const vec3 h = half_way * inversesqrt(max(dot(half_way, half_way), 1e-20));
    vec3 diffuse = m.base_color * ((1.0 - m.metallic) / pi);
    if (m.lighting_model == model_burley) diffuse *= burley_shape(m, l, v, h);
    return diffuse + ggx_specular(m, l, v, h);
}

#endif
