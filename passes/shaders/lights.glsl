// What a light sends to a point and what the point reflects to the eye, without shadow (lighting chapter 0.3 and 0.4).
// Omni, round spot and directional; other types light nothing here (a technique that does them says so).
#ifndef PASSES_SHADERS_LIGHTS_GLSL
#define PASSES_SHADERS_LIGHTS_GLSL
#include "passes/shaders/brdf.glsl"
#include "passes/shaders/scene.glsl"

// LightType of capture_format/frame.h.
const uint light_omni = 0u;
const uint light_round_spot = 1u;
const uint light_directional = 7u;
// Metres: nearer than this a point light grows no brighter.
const float nearest_light = 0.01;

// 1 at the light, exactly 0 from its range on: what makes culling by range lossless.
float range_window(float d, float range) {
    const float share = d / range;
    const float rest = clamp(1.0 - share * share * share * share, 0.0, 1.0);
    return d < range ? rest * rest : 0.0;
}

float spot_cone(LightRecord light, vec3 to_light) {
    const float cosine = dot(-to_light, light.direction);
    const float t = clamp((cosine - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-4), 0.0, 1.0);
    return t * t;
}

struct Incident {
    vec3 to_light;    // unit
    vec3 irradiance;  // on a plane facing the light
};

Incident incident_light(LightRecord light, vec3 position) {
    if (light.type == light_directional) return Incident(-light.direction, light.intensity);
    const vec3 offset = light.position - position;
    const float squared = dot(offset, offset);
    const float d = sqrt(squared);
    if (light.type > light_round_spot || d >= light.range || d < 1e-12) return Incident(vec3(0.0), vec3(0.0));
    const vec3 to_light = offset / d;
    const float cone = light.type == light_round_spot ? spot_cone(light, to_light) : 1.0;
    const float fall_off = range_window(d, light.range) * cone / max(squared, nearest_light * nearest_light);
    return Incident(to_light, light.intensity * fall_off);
}

// L_o = f E cos towards the eye, which is the origin.
vec3 reflected(MaterialPoint m, LightRecord light) {
    const Incident incident = incident_light(light, m.position);
    const float cosine = brdf_cosine(m, incident.to_light, every_light_feature);
    if (cosine <= 0.0 || incident.irradiance == vec3(0.0)) return vec3(0.0);
    return brdf(m, incident.to_light, normalize(-m.position), every_light_feature) * incident.irradiance * cosine;
}

// Diffuse light of sky and ground. The material's own occlusion is in it; traced or screen-space occlusion is not.
vec3 hemisphere_light(MaterialPoint m) {
    if (m.lighting_model == model_unlit) return vec3(0.0);
    const vec3 normal = facing_normal(m.lighting_model, m.normal, m.position);
    const float up = 0.5 + 0.5 * (view.to_world * normal).y;
    return m.base_color * (1.0 - m.metallic) * mix(view.ground, view.sky, up) * m.occlusion;
}

#endif
