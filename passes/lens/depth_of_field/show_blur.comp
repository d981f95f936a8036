// The circle of confusion of each pixel's first sample: its radius in pixels, negative before the plane in focus.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/xray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint form = focus_gather;

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D shown;

float signed_radius(ivec3 at) {
    if (form == focus_gather) return blur_at(at);
    const float radius = xray_radius(factor_at(at)).x;
    return xray_depth(at) < push.focus ? -radius : radius;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(shown)))) return;
    imageStore(shown, pixel, vec4(vec3(signed_radius(ivec3(pixel, 0))), 1.0));
}
