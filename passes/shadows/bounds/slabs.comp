// Two parallel planes between which all depths of a block's window lie (docs/algorithms/deferred.md 5.6; Gruen, GPU Pro 2010): their
// slope is that of the least squares, and they are level where that is as close or the window leaves the map. With planes_only
// they follow a slope only where they are closer than a tolerance and something is drawn everywhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/bounds/window.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint planes_only = 0u;
layout(constant_id = 1) const float tolerance = 1e-4;

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray bounds;

// Roundings of a residual and of a lookup's four sums and products, of 2^-24 each, are below 10 of the depth and the rise.
const float rounding = 1.0 / 1048576.0;

// Ways of a quad's texels from the window's center.
vec4 ways_x(int x) { return float(x) - 0.5 * float(window - 1) + vec4(0.0, 1.0, 0.0, 1.0); }
vec4 ways_y(int y) { return float(y) - 0.5 * float(window - 1) + vec4(0.0, 0.0, 1.0, 1.0); }

struct Extremes {
    float least, greatest;
    vec2 slope;  // in depth per texel, of the least squares
};

Extremes extremes_of(ivec2 begin) {
    vec4 least = vec4(1.0), greatest = vec4(0.0);
    vec2 slope = vec2(0.0);
    for (int y = 0; y < window; y += 2) {
        for (int x = 0; x < window; x += 2) {
            const vec4 quad = quad_at(begin + ivec2(x, y));
            least = min(least, quad);
            greatest = max(greatest, quad);
            slope += vec2(dot(ways_x(x), quad), dot(ways_y(y), quad));
        }
    }
    // Divided by the sum of squared ways along an axis over K x K texels.
    slope *= 12.0 / float(window * window * (window * window - 1));
    return Extremes(least_of(least), greatest_of(greatest), slope);
}

// Least and greatest distance from a plane through depth 0 at the window's center.
vec2 residuals_of(ivec2 begin, vec2 slope) {
    vec4 least = vec4(2.0e38), greatest = vec4(-2.0e38);
    for (int y = 0; y < window; y += 2) {
        for (int x = 0; x < window; x += 2) {
            const vec4 residual = quad_at(begin + ivec2(x, y)) - (slope.x * ways_x(x) + slope.y * ways_y(y));
            least = min(least, residual);
            greatest = max(greatest, residual);
        }
    }
    return vec2(least_of(least), greatest_of(greatest));
}

vec4 slab_of(ivec2 begin) {
    const Extremes extremes = extremes_of(begin);
    const vec2 residuals = residuals_of(begin, extremes.slope);
    const float rise = float(window) * (abs(extremes.slope.x) + abs(extremes.slope.y));
    const float margin = rounding * (extremes.greatest + rise);
    const vec4 tilted = vec4(residuals.x - margin, residuals.y + margin, extremes.slope);
    const vec4 level = vec4(extremes.least, extremes.greatest, 0.0, 0.0);
    if (tilted.y - tilted.x >= level.y - level.x) return level;
    if (planes_only != 0u && (tilted.y - tilted.x >= tolerance || extremes.least == 0.0)) return level;
    return tilted;
}

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy), begin = block * bounds_block - bounds_reach;
    if (any(greaterThanEqual(block * bounds_block, ivec2(int(push.size))))) return;
    vec4 found;
    if (leaves_map(begin)) found = vec4(clipped_extremes(begin), 0.0, 0.0);
    else found = slab_of(begin);
    imageStore(bounds, ivec3(ivec2(push.offset) / bounds_block + block, push.layer), found);
}
