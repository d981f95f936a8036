// Writes the scales of one material's mips, which the host has found (passes/gbuffer/coverage/mip_scales.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/gbuffer/coverage/coverage.shared.h"

layout(local_size_x = 16) in;

layout(push_constant, scalar) uniform Push { MaskScalesPush push; };

layout(set = 0, binding = 0, r32f) writeonly uniform image2D mask_scales;

void main() {
    const uint mip = gl_GlobalInvocationID.x;
    if (mip >= mask_scale_mips) return;
    imageStore(mask_scales, mask_scale_texel(push.material, mip), vec4(push.scales[mip]));
}
