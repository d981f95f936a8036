// Where every opaque draw is in the picture, how near it can be, and how large: bounds of its sphere (Mara and McGuire 2013).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/culling/hiz_two_phase/hiz_two_phase.shared.h"
#include "passes/culling/view_planes.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) readonly buffer History { uint visible_before[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer HizDraws { HizDraw hiz_draws[]; };
layout(set = 0, binding = 3, scalar) buffer Work { HizWork work; };
layout(set = 0, binding = 4, scalar) buffer Counters { HizCounters counters; };
layout(push_constant, scalar) uniform Push { HizPush push; };

// Smallest and largest a / z of a circle around (along, z) before the eye: its tangents are the direction to its center, turned
// by the angle whose sine is radius over distance.
vec2 slopes(float along, float z, float radius) {
    const float tangent = sqrt(along * along + (z - radius) * (z + radius));  // factored: nothing cancels
    return vec2((tangent * along - radius * z) / (tangent * z + radius * along),
                (tangent * along + radius * z) / (tangent * z - radius * along));
}

// In pixels along one axis, smaller one first.
vec2 in_pixels(vec2 slope, float scale, float offset, float extent) {
    const vec2 pixels = ((slope * scale + offset) * 0.5 + 0.5) * extent;
    return vec2(min(pixels.x, pixels.y) - pixel_slack, max(pixels.x, pixels.y) + pixel_slack);
}

// Pixels with a sample in the bounds. Samples lie within 3/8 of a pixel's center where there are four, at it where there is one.
// False, and nothing set, where the bounds are no numbers: squares of more than 1e19 m overflow.
bool set_pixels(inout HizDraw draw, vec3 center, float radius) {
    const mat4 p = view.projection;
    const vec2 extent = vec2(view.extent);
    const vec2 x = in_pixels(slopes(center.x, center.z, radius), p[0][0], p[2][0], extent.x);
    const vec2 y = in_pixels(slopes(center.y, center.z, radius), p[1][1], p[2][1], extent.y);
    if (!(x.x <= x.y && y.x <= y.y)) return false;
    const float reach = view.samples > 1u ? 0.375 : 0.0;
    draw.first = ivec2(clamp(ceil(vec2(x.x, y.x) - 0.5 - reach), vec2(0.0), extent));
    draw.last = ivec2(clamp(floor(vec2(x.y, y.y) - 0.5 + reach), vec2(-1.0), extent - 1.0));
    draw.nearest = view.near / (center.z - radius);
    return true;
}

uint size_bin(float radius_over_depth) {
    return clamp(floatBitsToUint(radius_over_depth) >> size_bin_shift, smallest_size_bin, smallest_size_bin + size_bins - 1u) -
           smallest_size_bin;
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const DrawRecord d = draws[all_commands[push.first + i].first_instance];
    const float radius = padded_radius(d.bound_center, d.bound_radius);
    HizDraw draw = HizDraw(0u, ivec2(0), ivec2(-1), 1.0, size_bins - 1u);
    if (outside(d.bound_center, radius)) {
        hiz_draws[i] = draw;
        return;
    }
    draw.state = hiz_in_view;
    const bool is_ahead = d.bound_center.z - radius >= view.near && set_pixels(draw, d.bound_center, radius);
    if (is_ahead) draw.size_bin = size_bin(radius / d.bound_center.z);
    else draw.state |= hiz_at_eye;
    if (visible_before[i] != 0u) draw.state |= hiz_known;
    if (materials[d.material].alpha_mode == alpha_opaque) {
        draw.state |= hiz_occludes;
        atomicAdd(work.sizes[draw.size_bin], 1u);
        if ((draw.state & hiz_known) != 0u) atomicAdd(work.known, 1u);
    }
    hiz_draws[i] = draw;
    atomicAdd(counters.in_view, 1u);
}
