// The bins as numbers: where each begins and ends, its first light in the order of depth, and how many it spans.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/z_binned/bins.glsl"

layout(local_size_x = 1, local_size_y = 64) in;

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D numbers;
layout(set = 0, binding = 1, scalar) readonly buffer Header { ZHeader header; };
layout(set = 0, binding = 2, scalar) readonly buffer Bins { uint bins[]; };
layout(push_constant, scalar) uniform Push { ZBinsPush push; };

float begin_of(uint bin) {
    const float way = float(bin) / header.scale;
    return push.spacing == spacing_logarithmic ? header.near * exp(way) : header.near + way;
}

void main() {
    const uint bin = gl_GlobalInvocationID.y;
    if (bin >= push.bins) return;
    const uint low = bins[bin] & 0xffffu, high = bins[bin] >> 16u;
    imageStore(numbers, ivec2(0, bin), vec4(begin_of(bin), begin_of(bin + 1u), low, low > high ? 0.0 : float(high - low + 1u)));
}
