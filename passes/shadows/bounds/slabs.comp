// Two parallel planes between which all depths of a block's window lie (docs/algorithms/deferred.md 5.6; Gruen, GPU Pro 2010): their
// slope is that of the least squares, and they are level where that is as close. With planes_only they follow a slope only where
// they are closer than a tolerance and something is drawn everywhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/bounds/bounds.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 67) const int bounds_block = 4;
layout(constant_id = 68) const int bounds_reach = 2;
layout(constant_id = 0) const uint planes_only = 0u;
layout(constant_id = 1) const float tolerance = 1e-4;

layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray bounds;
layout(push_constant, scalar) uniform Bounds { BoundsPush push; };

// Roundings of a residual and of a lookup's four sums and products, of 2^-24 each, are below 10 of the depth and the rise.
const float rounding = 1.0 / 1048576.0;

float depth_at(ivec2 texel) {
    const ivec2 inside = clamp(texel, ivec2(0), ivec2(int(push.size) - 1));
    if (push.is_face == 0u && inside != texel) return 0.0;
    return texelFetch(shadow_maps, ivec3(ivec2(push.offset) + inside, push.layer), 0).r;
}

const int window = bounds_block + 2 * bounds_reach;

struct Extremes {
    float least, greatest;
    vec2 slope;  // in depth per texel, of the least squares
};

Extremes extremes_of(ivec2 begin) {
    Extremes found = Extremes(1.0, 0.0, vec2(0.0));
    for (int y = 0; y < window; ++y) {
        for (int x = 0; x < window; ++x) {
            const float depth = depth_at(begin + ivec2(x, y));
            found.least = min(found.least, depth);
            found.greatest = max(found.greatest, depth);
            found.slope += (vec2(x, y) - 0.5 * float(window - 1)) * depth;
        }
    }
    // The sum of squared distances from the center over K x K texels.
    found.slope *= 12.0 / float(window * window * (window * window - 1));
    return found;
}

// Least and greatest distance from a plane through depth 0 at the window's center.
vec2 residuals_of(ivec2 begin, vec2 slope) {
    vec2 found = vec2(2.0e38, -2.0e38);
    for (int y = 0; y < window; ++y) {
        for (int x = 0; x < window; ++x) {
            const vec2 from_center = vec2(x, y) - 0.5 * float(window - 1);
            const float residual = depth_at(begin + ivec2(x, y)) - dot(slope, from_center);
            found = vec2(min(found.x, residual), max(found.y, residual));
        }
    }
    return found;
}

vec4 slab_of(ivec2 begin) {
    const Extremes extremes = extremes_of(begin);
    const vec4 level = vec4(extremes.least, extremes.greatest, 0.0, 0.0);
    if (extremes.least == extremes.greatest || (planes_only != 0u && extremes.least == 0.0)) return level;
    const vec2 residuals = residuals_of(begin, extremes.slope);
    const float rise = float(window) * (abs(extremes.slope.x) + abs(extremes.slope.y));
    const float margin = rounding * (extremes.greatest + rise);
    const vec2 tilted = vec2(residuals.x - margin, residuals.y + margin);
    const float limit = planes_only != 0u ? min(tolerance, extremes.greatest - extremes.least)
                                          : extremes.greatest - extremes.least;
    return tilted.y - tilted.x < limit ? vec4(tilted, extremes.slope) : level;
}

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(block * bounds_block, ivec2(int(push.size))))) return;
    const ivec2 place = ivec2(push.offset) / bounds_block + block;
    imageStore(bounds, ivec3(place, push.layer), slab_of(block * bounds_block - bounds_reach));
}
