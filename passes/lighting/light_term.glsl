// What one light adds to one sample: shadow, blockers, reflection. Every technique of the stage that loops over lights adds this
// same term, which is what makes their pictures equal bit by bit when they add the same lights in the same order.
#ifndef PASSES_LIGHTING_LIGHT_TERM_GLSL
#define PASSES_LIGHTING_LIGHT_TERM_GLSL
#include "passes/shaders/blockers.glsl"
#include "passes/shaders/light_features.shared.h"
#include "passes/shaders/lights.glsl"

layout(constant_id = 1) const uint has_visibility = 0u;
layout(constant_id = 3) const uint features = every_light_feature;  // what lights and surfaces may need here

layout(set = 0, binding = 3) uniform sampler2DArray visibility;

float visibility_of(LightRecord light, ivec3 at) {
    if (has_visibility == 0u || light.visibility_layer == no_index) return 1.0;
    return texelFetch(visibility, ivec3(at.xy, int(light.visibility_layer) + at.z), 0).r;
}

// The blockers and portals that are asked, as bits of the light's own; `lifted` is off_surface() of the point. `precise`, so
// that no variant of the shader rounds otherwise than the next.
vec3 light_term(LightRecord light, MaterialPoint m, vec3 lifted, ivec3 at, uvec2 asked) {
    const float visible = visibility_of(light, at);
    if (visible <= 0.0) return vec3(0.0);
    if ((features & feature_blockers) != 0u && asked.x != 0u && !blockers_pass(light, lifted, asked.x, asked.y)) return vec3(0.0);
    precise const vec3 term = visible * reflected(m, light, features);
    return term;
}

// With all of the light's blockers and portals.
vec3 light_term(uint index, MaterialPoint m, vec3 lifted, ivec3 at) {
    const LightRecord light = lights[index];
    return light_term(light, m, lifted, at, uvec2(low_bits(light.blockers), low_bits(light.portals)));
}

#endif
