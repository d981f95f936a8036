// How many taps of focus=gather fall on each pixel's first sample: red before its surface, green on it, blue behind it. A pixel in
// focus takes light of what lies before it alone. Counted by depth: taps whose radiance is not a number are among them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/gather.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 2, rgba32f) writeonly uniform image2D shown;

vec3 falls(Tap tap) { return vec3(greaterThan(vec3(tap.before, tap.on, tap.behind), vec3(0.0))); }

vec3 counted(Center c) {
    vec3 count = vec3(0.0);
    vec2 way = first_way(c.at);
    for (uint i = 0u; i < taps / 2u; ++i) {
        count += falls(tap_at(c, way * (c.outer * from_center(i))));
        count += falls(tap_at(c, -way * (c.inner * from_center(i))));
        way = next_way(way);
    }
    return abs(c.blur) > sharp ? count : vec3(count.r, 0.0, 0.0);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(shown)))) return;
    const ivec3 at = ivec3(pixel, 0);
    vec3 count = vec3(0.0);
    if (reach_at(at) > sharp) count = counted(center_at(at));
    imageStore(shown, pixel, vec4(count, 1.0));
}
