// How many of X-Ray's twelve taps have a weight above 0 at each pixel's first sample, in green as those of focus=gather that fall on
// the pixel's own surface: X-Ray has no layers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/xray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D shown;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(shown)))) return;
    const float factor = factor_at(ivec3(pixel, 0));
    float count = 0.0;
    if (factor > 0.0)
        for (int i = 0; i < 12; ++i)
            count += float(factor_at(tapped_sample(vec2(pixel) + 0.5 + xray_taps[i] * xray_radius(factor), 0)) > 0.0);
    imageStore(shown, pixel, vec4(0.0, count, 0.0, 1.0));
}
