// The largest blur in each tile of pixels, over all samples.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/blur.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, r32f) writeonly uniform image2D reach;

shared uint largest;  // positive floats are in the order of their bits

void main() {
    if (gl_LocalInvocationIndex == 0u) largest = 0u;
    barrier();
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    const ivec3 size = textureSize(color, 0);
    if (all(lessThan(pixel, size.xy)))
        for (int i = 0; i < size.z; ++i) atomicMax(largest, floatBitsToUint(abs(blur_at(ivec3(pixel, i)))));
    barrier();
    if (gl_LocalInvocationIndex == 0u) imageStore(reach, ivec2(gl_WorkGroupID.xy), vec4(uintBitsToFloat(largest)));
}
