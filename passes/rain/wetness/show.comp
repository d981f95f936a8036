// The rain map as a square in the middle of the picture, or the share of rain that arrives at each pixel's first sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/rain/wetness/lookup.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 4) const uint shows_map = 0u;

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray picture;

float arriving(ivec2 pixel) {
    const Surface s = surface_at(ivec3(pixel, 0));
    if (!s.exists) return 0.0;
    const vec3 position = surface_position(s, uvec2(pixel));
    return rain_visibility(position, facing_normal(s.lighting_model, s.normal, position));
}

/// Its texels stay square, so that a roof in it has the roof's shape.
float in_map(ivec2 pixel) {
    const ivec2 extent = ivec2(view.extent);
    const int edge = min(extent.x, extent.y);
    const ivec2 place = pixel - (extent - edge) / 2;
    if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, ivec2(edge)))) return 0.0;
    return texelFetch(rain_map, ivec3(place * map_size / edge, 0), 0).r;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, view.extent))) return;
    float shown = 0.0;
    if (shows_map != 0u) shown = in_map(pixel);
    else shown = arriving(pixel);
    imageStore(picture, ivec3(pixel, 0), vec4(vec3(shown), 1.0));
}
