// Adds the glow to every sample of a pixel alike, as radiance before exposure.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/bloom/added.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(color).xy))) return;
    const vec3 added = added_glow(pixel, imageSize(color).xy);
    for (int i = 0; i < imageSize(color).z; ++i) {
        const vec4 own = imageLoad(color, ivec3(pixel, i));
        imageStore(color, ivec3(pixel, i), vec4(own.rgb + added, own.a));
    }
}
