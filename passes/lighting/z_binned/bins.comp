// The first and the last of the sorted lights that reach each bin, 16 bits each; a bin that none reaches holds more than it
// ends with. Both are found by bisection: `nearest` grows by the sort, `reached` by being a running maximum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/lighting/z_binned/bins.glsl"
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer Sorted { ZLight sorted[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Header { ZHeader header; };
layout(set = 0, binding = 2, scalar) writeonly buffer Bins { uint bins[]; };
layout(push_constant, scalar) uniform Push { ZBinsPush push; };

bool begins_by(uint i, uint bin) { return bin_of(header, push, sorted[i].nearest * (1.0 - slack_of(push))) <= bin; }
bool reaches(uint i, uint bin) { return bin_of(header, push, sorted[i].reached * (1.0 + slack_of(push))) >= bin; }

void main() {
    const uint bin = gl_GlobalInvocationID.x;
    if (bin >= push.bins) return;
    uint low = header.everywhere, end = push.lights;  // the first that reaches the bin
    while (low < end) {
        const uint middle = (low + end) / 2u;
        if (reaches(middle, bin)) end = middle;
        else low = middle + 1u;
    }
    uint high = header.everywhere;  // one past the last that begins by it
    end = push.lights;
    while (high < end) {
        const uint middle = (high + end) / 2u;
        if (begins_by(middle, bin)) high = middle + 1u;
        else end = middle;
    }
    bins[bin] = low < high ? low | (high - 1u) << 16u : 0x0000ffffu;
}
