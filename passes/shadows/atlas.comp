// The layers of shadow_maps side by side, as a picture of the frame's extent: 0 where no map lies, .25 on a map where nothing was
// drawn and on the maps' outermost texels, from .5 to 1 what was drawn, nearer to the light brighter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"
#include "passes/shadows/shadows.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray picture;
layout(push_constant, scalar) uniform Atlas { AtlasPush push; };

float shown(ivec2 texel, uint layer) {
    for (uint slot = 0u; slot < view.shadow_count; ++slot) {
        const ShadowRecord map = shadows[push.first + slot];
        const ivec2 within = texel - ivec2(map.offset), last = ivec2(int(map.size) - 1);
        if (map.layer != layer || any(lessThan(within, ivec2(0))) || any(greaterThan(within, last))) continue;
        if (any(equal(within, ivec2(0))) || any(equal(within, last))) return 0.25;
        const float depth = texelFetch(shadow_maps, ivec3(texel, layer), 0).r;
        return depth > 0.0 ? 0.5 + 0.5 * sqrt(sqrt(min(depth, 1.0))) : 0.25;  // the root spreads near / z
    }
    return 0.0;
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view.extent))) return;
    // As many layers in a row that all fit when a layer is a square of `edge` pixels, the largest that does.
    uint edge = max(min(view.extent.x, view.extent.y), 1u);
    while (edge > 1u && (view.extent.x / edge) * (view.extent.y / edge) < push.layers) --edge;
    const uvec2 square = pixel / edge;
    const uint in_row = max(view.extent.x / edge, 1u), layer = square.y * in_row + square.x;
    float value = 0.0;
    if (square.x < in_row && layer < push.layers) {
        value = shown(ivec2((vec2(pixel - square * edge) + 0.5) / float(edge) * float(push.extent)), layer);
    }
    imageStore(picture, ivec3(pixel, 0), vec4(vec3(value), 1.0));
}
