// What one light adds to one sample, with all of its blockers and the shadow that the shadows stage left: for techniques that know
// no tiles.
#ifndef PASSES_LIGHTING_LIGHT_TERM_GLSL
#define PASSES_LIGHTING_LIGHT_TERM_GLSL
#include "passes/lighting/light_arrives.glsl"

layout(constant_id = 1) const uint has_visibility = 0u;
layout(constant_id = 3) const uint features = every_light_feature;  // what lights and surfaces of the frame may need

layout(set = 0, binding = 3) uniform sampler2DArray visibility;

float visibility_of(LightRecord light, ivec3 at) {
    if (has_visibility == 0u || light.visibility_layer == no_index) return 1.0;
    return texelFetch(visibility, ivec3(at.xy, int(light.visibility_layer) + at.z), 0).r;
}

// 0 where range, blockers or shadow end it.
float share_that_arrives(LightRecord light, MaterialPoint m, vec3 above, ivec3 at) {
    return light_arrives(light, m, above, all_asked(light), features) ? visibility_of(light, at) : 0.0;
}

// `precise`, so that no variant of the shader rounds otherwise than the next.
vec3 light_term(uint index, MaterialPoint m, vec3 above, ivec3 at) {
    const LightRecord light = lights[index];
    const float visible = share_that_arrives(light, m, above, at);
    if (visible <= 0.0) return vec3(0.0);
    precise const vec3 term = visible * reflected(m, light, features);
    return term;
}

#endif
