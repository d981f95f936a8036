// The pyramid's levels and the bounds of draws, as pictures: see the rows of views in views.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/culling/hiz_two_phase/pyramid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint shown = hiz_view_pyramid;

layout(set = 0, binding = 0, scalar) readonly buffer Pyramid { float pyramid[]; };
layout(set = 0, binding = 1, scalar) readonly buffer HizDraws { HizDraw hiz_draws[]; };
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2DArray picture;
layout(push_constant, scalar) uniform Push { HizView push; };

// Meters; 0 where nothing hides anything.
float farthest_at(uvec2 pixel) {
    const uint level = min(push.level, last_level());
    const uvec2 texel = pixel >> level;
    const float depth = pyramid[level_begin(level) + texel.y * level_size(level).x + texel.x];
    return depth > 0.0 ? view.near / depth : 0.0;
}

bool has_bounds(HizDraw draw) { return (draw.state & hiz_in_view) != 0u && (draw.state & hiz_at_eye) == 0u; }

bool covers(HizDraw draw, ivec2 pixel) { return all(greaterThanEqual(pixel, draw.first)) && all(lessThanEqual(pixel, draw.last)); }

bool is_on_border(HizDraw draw, ivec2 pixel) {
    return covers(draw, pixel) && (any(equal(pixel, draw.first)) || any(equal(pixel, draw.last)));
}

float hidden_draws(ivec2 pixel) {
    float sum = 0.0;
    for (uint i = 0u; i < push.count; ++i) {
        const HizDraw draw = hiz_draws[i];
        if (has_bounds(draw) && (draw.state & hiz_visible) == 0u && covers(draw, pixel)) sum += 1.0;
    }
    return sum;
}

// Red: hidden. Green: drawn in phase 1 and visible. Blue: visible, and not drawn in phase 1.
vec3 borders(ivec2 pixel) {
    vec3 color = vec3(0.0);
    for (uint i = 0u; i < push.count; ++i) {
        const HizDraw draw = hiz_draws[i];
        if (!has_bounds(draw) || !is_on_border(draw, pixel)) continue;
        if ((draw.state & hiz_visible) == 0u) color.r = 1.0;
        else if ((draw.state & hiz_first) != 0u) color.g = 1.0;
        else color.b = 1.0;
    }
    return color;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture).xy))) return;
    vec3 color = vec3(0.0);
    if (shown == hiz_view_pyramid) color = vec3(farthest_at(uvec2(pixel)));
    if (shown == hiz_view_hidden) color = vec3(hidden_draws(pixel));
    if (shown == hiz_view_bounds) color = borders(pixel);
    imageStore(picture, ivec3(pixel, 0), vec4(color, 1.0));
}
