// The rain map over the picture, or the share of rain that arrives at each pixel's first sample.
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

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, view.extent))) return;
    float shown = 0.0;
    if (shows_map != 0u) shown = texelFetch(rain_map, ivec3(pixel * map_size / ivec2(view.extent), 0), 0).r;
    else shown = arriving(pixel);
    imageStore(picture, ivec3(pixel, 0), vec4(vec3(shown), 1.0));
}
