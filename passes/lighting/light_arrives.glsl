// Whether a light gets to a point at all: its range, then its blockers, which cost least; shadows and reflection come after. Every
// technique of the stage asks here, which is what makes their pictures equal bit by bit where they add the same lights in the
// same order.
#ifndef PASSES_LIGHTING_LIGHT_ARRIVES_GLSL
#define PASSES_LIGHTING_LIGHT_ARRIVES_GLSL
#include "passes/shaders/blockers.glsl"
#include "passes/shaders/lights.glsl"

// Where blockers are asked about.
vec3 lifted(MaterialPoint m) { return off_surface(m.position, facing_normal(m.lighting_model, m.normal, m.position)); }

bool is_in_range(LightRecord light, vec3 position) {
    const vec3 offset = light.position - position;
    return !light_has_range(light.type) || dot(offset, offset) < light.range * light.range * (1.0 + 1e-6);
}

// `asked` are the blockers and portals that matter here, as bits of the light's own; `above` is lifted(m).
bool light_arrives(LightRecord light, MaterialPoint m, vec3 above, uvec2 asked, uint features) {
    if (!is_in_range(light, m.position)) return false;
    if ((features & feature_blockers) == 0u || asked.x == 0u) return true;
    return blockers_pass(light, above, asked.x, (features & feature_portals) != 0u ? asked.y : 0u);
}

uvec2 all_asked(LightRecord light) { return uvec2(low_bits(light.blockers), low_bits(light.portals)); }

#endif
