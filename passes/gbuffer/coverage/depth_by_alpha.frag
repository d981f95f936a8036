// Depth alone, of the samples that the device's alpha to coverage makes of alpha (docs/algorithms/deferred.md 4.3). The fill then
// draws at equal depth: no attribute may be written as an alpha of color 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/alpha_test.glsl"

layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 6) flat in uint in_draw;

layout(location = 0) out vec4 coverage;

void main() {
    const MaterialRecord material = material_of(in_draw);
    const float alpha = alpha_of(material, footprint(in_uv), has_attribute(attribute_color) ? in_color.a : 1.0);
    if (!gl_FrontFacing && has_one_side(material.double_sided)) discard;
    coverage = vec4(is_masked(material) ? alpha : 1.0);
}
