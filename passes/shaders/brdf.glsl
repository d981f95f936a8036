// Reflectance of the lighting models (docs/algorithms/lighting.md 0.5): Lambert; Burley 2012, plain and renormalized by Lagarde &
// de Rousiers (Frostbite, 2014); GGX of Walter et al. 2007 with the height-correlated visibility of Heitz 2014, and with the
// light of many bounces after Turquin 2019. Cloth, skin and hair are in special_brdf.glsl. Any shader stage.
// What one unit of irradiance from l adds to the radiance towards v is brdf() * brdf_cosine().
#ifndef PASSES_SHADERS_BRDF_GLSL
#define PASSES_SHADERS_BRDF_GLSL
#include "passes/shaders/special_brdf.glsl"

// Burley's diffuse over rho / pi, plain or with the energy bias and factor of Frostbite: the plain form reflects up to 1.38.
float burley_shape(MaterialPoint m, Directions d) {
    const bool plain = m.lighting_model == model_plain_burley;
    const float n_l = clamp(dot(d.normal, d.l), 0.0, 1.0), n_v = clamp(dot(d.normal, d.v), smallest_cosine, 1.0);
    const float l_h = clamp(dot(d.l, d.h), 0.0, 1.0);
    const float bias = plain ? 0.5 : 0.5 * m.roughness;
    const float grazing = bias + 2.0 * m.roughness * l_h * l_h - 1.0;
    const float energy = plain ? 1.0 : mix(1.0, 1.0 / 1.51, m.roughness);
    return energy * (1.0 + grazing * fifth_power(1.0 - n_l)) * (1.0 + grazing * fifth_power(1.0 - n_v));
}

// GGX with the light that bounces between its facets, 1 + F0 (1 / E - 1) times one bounce, over a Lambert layer that gets what
// the highlight leaves: together they reflect no more than they get. Not reciprocal: both ask the eye alone.
vec3 multiscatter(MaterialPoint m, Directions d, vec3 f0) {
    const vec2 sky = ggx_albedo(dot(d.normal, d.v), m.roughness);
    const vec3 bounces = 1.0 + f0 * (1.0 / sky.x - 1.0);
    const vec3 left = 1.0 - bounces * mix(vec3(sky.y), vec3(sky.x), f0);
    return ggx(d, m.roughness) * schlick(f0, dot(d.l, d.h)) * bounces + m.base_color * ((1.0 - m.metallic) / pi) * left;
}

// f(l, v) per steradian; l and v unit, towards the light and the eye. The cosine is not in it. Unlit surfaces reflect nothing.
// A cloth, skin or hair whose bit is not in `features` is taken for GGX.
vec3 brdf(MaterialPoint m, vec3 l, vec3 v, uint features) {
    if (m.lighting_model == model_unlit) return vec3(0.0);
    if (m.lighting_model == model_lambert) return m.base_color / pi;
    const vec3 half_way = l + v;
    const Directions d = Directions(m.normal, l, v, half_way * inversesqrt(max(dot(half_way, half_way), 1e-20)));
    if (is_special(m, feature_cloth, features)) return cloth(m, d);
    if (is_special(m, feature_skin, features)) return skin(m, d);
    if (is_special(m, feature_hair, features)) return hair(m, d);
    const vec3 f0 = mix(vec3(0.04), m.base_color, m.metallic);
    if (m.lighting_model == model_multiscatter_ggx) return multiscatter(m, d, f0);
    vec3 diffuse = m.base_color * ((1.0 - m.metallic) / pi);
    if (m.lighting_model == model_burley || m.lighting_model == model_plain_burley) diffuse *= burley_shape(m, d);
    return diffuse + ggx(d, m.roughness) * schlick(f0, dot(l, d.h));
}

// The cosine that irradiance comes in by: 0 from behind, but for skin, which light wraps around, and for hair, which has no
// behind.
float brdf_cosine(MaterialPoint m, vec3 l, uint features) {
    const float cosine = dot(m.normal, l);
    if (is_special(m, feature_skin, features)) return skin_cosine(cosine);
    if (is_special(m, feature_hair, features)) return length(cross(m.normal, l));
    return clamp(cosine, 0.0, 1.0);
}

#endif
