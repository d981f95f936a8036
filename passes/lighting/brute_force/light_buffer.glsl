// Lights as the talk's light buffer has them (docs/algorithms/deferred.md 1.5, 1.6): materials out of a table, highlights without
// the light's color. Area lights, of which the talk has none, are reflected as recorded.
#ifndef PASSES_LIGHTING_BRUTE_FORCE_LIGHT_BUFFER_GLSL
#define PASSES_LIGHTING_BRUTE_FORCE_LIGHT_BUFFER_GLSL
#include "passes/lighting/brute_force/brute_force.shared.h"
#include "passes/lighting/material_table.glsl"
#include "passes/shaders/lights.glsl"

layout(constant_id = 108) const uint material_source = materials_recorded;
layout(constant_id = 109) const uint specular = specular_colored;

vec3 kept_of_highlight(vec3 irradiance) {
    if (specular == specular_white) return vec3((irradiance.r + irradiance.g + irradiance.b) / 3.0);
    return irradiance;
}

// Base color times diffuse plus gloss times specular, whatever the metal: docs/algorithms/deferred.md 8.2.
vec3 by_table(MaterialPoint m, vec3 l, vec3 irradiance) {
    const vec3 normal = facing_normal(m.lighting_model, m.normal, m.position);
    const float n_l = dot(normal, l);
    if (n_l <= 0.0) return vec3(0.0);
    const vec3 h = normalize(l + normalize(-m.position));
    const uint slice = slice_of(m);
    const vec2 shares = table_at(n_l, clamp(dot(normal, h), 0.0, 1.0), slice);
    return (m.base_color * shares.x * irradiance + gloss_of(m, slice) * shares.y * kept_of_highlight(irradiance)) / pi;
}

// The highlight of models that have one above a diffuse layer, as passes/shaders/brdf.glsl adds it.
vec3 highlight_brdf(MaterialPoint m, vec3 l) {
    const vec3 v = normalize(-m.position), f0 = mix(vec3(0.04), m.base_color, m.metallic);
    const Directions d = Directions(m.normal, l, v, normalize(l + v));
    const vec3 once = ggx(d, m.roughness) * schlick(f0, dot(l, d.h));
    if (m.lighting_model != model_multiscatter_ggx) return once;
    return once * (1.0 + f0 * (1.0 / ggx_albedo(dot(m.normal, v), m.roughness).x - 1.0));
}

vec3 accumulated(MaterialPoint m, LightRecord light, uint features) {
    const bool is_whole = material_source == materials_recorded && !has_metals(m.lighting_model);
    if (is_whole || is_area_light(light, features)) return reflected(m, light, features);
    if (is_asked(features, feature_clip_planes) && is_clipped(light, m.position)) return vec3(0.0);
    const Incident incident = incident_light(light, m, features);
    if (incident.irradiance == vec3(0.0)) return vec3(0.0);
    if (material_source == materials_table) return by_table(m, incident.to_light, incident.irradiance);
    const float cosine = clamp(dot(m.normal, incident.to_light), 0.0, 1.0);
    if (cosine <= 0.0) return vec3(0.0);
    const vec3 paled = kept_of_highlight(incident.irradiance) - incident.irradiance;
    return reflected(m, light, features) + highlight_brdf(m, incident.to_light) * cosine * paled;
}

#endif
