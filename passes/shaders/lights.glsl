// What a point reflects of a light to the eye, without shadow and blockers (docs/algorithms/lighting.md 0.3 and 0.4): all types
// of light, with clip planes and pictures. Any shader stage.
#ifndef PASSES_SHADERS_LIGHTS_GLSL
#define PASSES_SHADERS_LIGHTS_GLSL
#include "passes/shaders/area_lights.glsl"
#include "passes/shaders/brdf.glsl"
#include "passes/shaders/light_types.glsl"
#include "passes/shaders/projected_texture.glsl"

// Meters: nearer than this a point light grows no brighter.
const float nearest_light = 0.01;
// Share of a square spot's half width over which its edge fades.
const float square_feather = 0.1;

float spot_cone(LightRecord light, vec3 to_light) {
    const float cosine = dot(-to_light, light.direction);
    const float t = clamp((cosine - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-4), 0.0, 1.0);
    return t * t;
}

// s: distance from the axis, 1 at the edge.
float square_edge(float s) { return 1.0 - smoothstep(1.0 - square_feather, 1.0, s); }

float square_cone(LightRecord light, vec3 offset) {
    const float depth = dot(offset, light.direction);
    if (depth <= 0.0) return 0.0;
    const vec2 s = abs(vec2(dot(offset, light.axis_u), dot(offset, axis_v(light)))) / (depth * light.tan_half);
    return square_edge(s.x) * square_edge(s.y);
}

// What a spot leaves around its axis.
float cone_share(LightRecord light, MaterialPoint m, vec3 to_light, uint features) {
    if (is_asked(features, feature_square_spot) && light_has_square_cone(light.type)) return square_cone(light, m.position - light.position);
    if (is_asked(features, feature_round_spot) && light_has_round_cone(light.type)) return spot_cone(light, to_light);
    return 1.0;
}

struct Incident {
    vec3 to_light;    // unit
    vec3 irradiance;  // on a plane facing the light
};

Incident incident_light(LightRecord light, MaterialPoint m, uint features) {
    if (!light_has_range(light.type)) return Incident(-light.direction, light.intensity);
    const vec3 offset = light.position - m.position;
    const float squared = dot(offset, offset);
    const float d = sqrt(squared);
    if (d >= light.range || d < 1e-12) return Incident(vec3(0.0), vec3(0.0));
    const vec3 to_light = offset / d;
    const float cone = cone_share(light, m, to_light, features);
    const float fall_off = range_window(light, d) * cone / max(squared, nearest_light * nearest_light);
    vec3 irradiance = light.intensity * fall_off;
    const bool is_spot = light_is_spot(light.type);
    if (is_asked(features, feature_projected_texture) && light.texture != no_index && is_spot && cone > 0.0)
        irradiance *= projected_picture(light, m, -offset);
    return Incident(to_light, irradiance);
}

bool is_area_light(LightRecord light, uint features) {
    return is_asked(features, feature_tube | feature_area) && light_has_area(light.type);
}

// L_o towards the eye, which is the origin. `features` are bits of light_features.shared.h, a constant of the shader: what it lacks
// is compiled away, and lights that need it must not be asked about.
vec3 reflected(MaterialPoint m, LightRecord light, uint features) {
    if (is_asked(features, feature_clip_planes) && is_clipped(light, m.position)) return vec3(0.0);
    if (is_area_light(light, features)) return reflected_area(m, light, features);
    const Incident incident = incident_light(light, m, features);
    const float cosine = brdf_cosine(m, incident.to_light, features);
    if (cosine <= 0.0 || incident.irradiance == vec3(0.0)) return vec3(0.0);
    return brdf(m, incident.to_light, normalize(-m.position), features) * incident.irradiance * cosine;
}

// Sky above the horizon and ground below it as a lobe of linearly transformed cosines sees them, times the lobe's albedo: of the part
// that M makes of a cosine lobe, the half space around `up` holds .5 + .5 n.z / |n| with n = M^T up.
vec3 hemisphere_in_metal(MaterialPoint m, vec3 normal) {
    const vec3 v = normalize(-m.position);
    const LtcRecord lobe = ltc_at(m.roughness, max(dot(normal, v), smallest_cosine));
    const vec3 up = to_frame(normal, v) * vec3(view.to_world[0].y, view.to_world[1].y, view.to_world[2].y);
    const vec3 n = vec3(lobe.m11 * up.x + lobe.m31 * up.z, lobe.m22 * up.y, lobe.m13 * up.x + lobe.m33 * up.z);
    return ltc_reflectance(lobe, m, m.base_color) * mix(view.ground, view.sky, 0.5 + 0.5 * n.z / length(n));
}

// Light of sky and ground: what diffuse surfaces scatter and metals mirror. Dielectrics mirror none of it. The material's own occlusion
// is in it; traced or screen-space occlusion is not.
vec3 hemisphere_light(MaterialPoint m) {
    if (m.lighting_model == model_unlit) return vec3(0.0);
    const vec3 normal = facing_normal(m.lighting_model, m.normal, m.position);
    const float up = 0.5 + 0.5 * (view.to_world * normal).y;
    vec3 sum = m.base_color * (1.0 - m.metallic) * mix(view.ground, view.sky, up);
    if (m.metallic > 0.0) sum += m.metallic * hemisphere_in_metal(m, normal);
    return sum * m.occlusion;
}

#endif
