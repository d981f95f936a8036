// Reads the talk's table of materials, and says what of it stands for a recorded material (material_table.shared.h).
#ifndef PASSES_LIGHTING_MATERIAL_TABLE_GLSL
#define PASSES_LIGHTING_MATERIAL_TABLE_GLSL
#include "passes/lighting/material_table.shared.h"
#include "passes/shaders/material_point.glsl"

layout(set = 0, binding = 33) uniform sampler2DArray material_table;

float mean_f0(MaterialPoint m) {
    const vec3 f0 = mix(vec3(0.04), m.base_color, m.metallic);
    return (f0.r + f0.g + f0.b) / 3.0;
}

uint slice_of(MaterialPoint m) {
    if (m.metallic >= least_metal) return slice_metal;
    if (m.roughness >= least_rough_roughness) return slice_rough;
    return m.roughness >= least_blinn_roughness ? slice_blinn : slice_phong;
}

// Lambert's surfaces have no highlight. 1 is the most that 8 bits hold.
float gloss_of(MaterialPoint m, uint slice) {
    if (m.lighting_model == model_lambert) return 0.0;
    float per_f0 = gloss_phong;
    if (slice == slice_rough) per_f0 = gloss_rough;
    if (slice == slice_blinn) per_f0 = gloss_blinn;
    if (slice == slice_metal) per_f0 = gloss_metal;
    return min(per_f0 * mean_f0(m), 1.0);
}

// Bilinear in floats, so that every device has the same fractions; texel centers as samplers have them.
vec2 table_at(float n_l, float n_h, uint slice) {
    const vec2 last = vec2(table_width, table_height) - 1.0;
    const vec2 at = clamp(vec2(n_l, n_h) * (last + 1.0) - 0.5, vec2(0.0), last);
    const ivec2 low = min(ivec2(at), ivec2(last) - 1);
    const vec2 f = at - vec2(low);
    const ivec3 texel = ivec3(low, slice);
    const vec2 lower = mix(texelFetch(material_table, texel, 0).rg, texelFetch(material_table, texel + ivec3(1, 0, 0), 0).rg, f.x);
    const vec2 upper = mix(texelFetch(material_table, texel + ivec3(0, 1, 0), 0).rg,
                           texelFetch(material_table, texel + ivec3(1, 1, 0), 0).rg, f.x);
    return mix(lower, upper, f.y);
}

#endif
