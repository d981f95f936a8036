// Irradiance over pi that a grid gives at the chosen pixel of each 2 x 2; a: 1 where it lights it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/apply/half_resolution.glsl"
#include "passes/shaders/finished.glsl"
#include "passes/shaders/largest_half.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ApplyPush push; };

layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D block_light;

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(block, imageSize(block_light)))) return;
    imageStore(block_light, block, vec4(0.0));
    const uint chosen = texelFetch(chosen_pixels, block, 0).r;
    if (chosen == no_pixel) return;
    const LitPlace lit = lit_pixel(pixel_of(block, chosen));
    if (depth_inside(push.grid, lit.place) <= 0.0) return;
    imageStore(block_light, block, vec4(min(gathered_light(push.grid, lit), largest_half), 1.0));
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
