// A thick fragment: its optical depth lies evenly between two depths and is added to every slice there. segment_model.h has the same in
// double. A shader that includes this includes fragment.glsl and volume/voxels.glsl first.
#ifndef PASSES_TRANSPARENCY_VOXEL_SEGMENT_GLSL
#define PASSES_TRANSPARENCY_VOXEL_SEGMENT_GLSL
#include "passes/shaders/hash.shared.h"
#include "passes/transparency/functions/optical_depth.glsl"
#include "passes/transparency/voxel/thick_fragments/thickness.glsl"

layout(constant_id = 25) const uint splatting = splatting_linear;
layout(constant_id = 26) const uint rounding = rounding_nearest;

// Pairs of triangles share a number: the halves of a particle meet without a seam.
float rounded_up_by(uvec2 texel) {
    if (rounding == rounding_nearest) return 0.5;
    const uint key = hashed(hashed(0u, uvec3(texel, in_draw)) ^ (in_triangle / 2u));
    return float(key >> 8u) / 16777216.0;
}

struct Segment {
    float farthest, meters;  // where it ends, and how deep it is; 0: a point
    int first, last;         // virtual slices
};

// Of a fragment at z. A linear splat is one slice deep itself: what is thinner than that is a point.
Segment segment_at(float z) {
    const float meters = thickness_of(in_draw), farthest = z + 0.5 * meters;
    const float from = slice_of_depth(farthest - meters), to = slice_of_depth(farthest);
    const bool is_point = splatting == splatting_linear && to - from < 1.0;
    return Segment(farthest, is_point ? 0.0 : meters, int(from), int(to));
}

// What is at or behind the front of a virtual slice, as a code: differences from slice to slice add up to the unsplit one. `codes`
// is all of it, not rounded.
uint code_behind(Segment segment, int slice, float codes, float r) {
    if (slice > segment.last) return 0u;
    const float behind = (segment.farthest - depth_of_slice(float(slice))) / segment.meters;
    return min(uint(codes * (slice <= segment.first ? 1.0 : clamp(behind, 0.0, 1.0)) + r), push.full_code);
}

// A fragment's codes in the volume of what is gray, one for each of its channels.
vec3 gray_codes(Fragment fragment) {
    vec3 codes = vec3(0.0);
    for (uint channel = 0u; channel < push.channels; ++channel)
        codes[channel] = channel_depth(fragment.t, push.channels == 1u ? luminance_channel : channel) * push.codes_per_depth;
    return min(codes, float(push.full_code));
}

#endif
