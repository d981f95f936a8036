// The K nearest front to back, behind them the tail, behind that what was there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/k_buffer/k_buffer.shared.h"
#include "passes/transparency/k_buffer/keys.glsl"
#include "passes/transparency/k_buffer/slots.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { KBufferParams params; };
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1, scalar) readonly buffer Slots { uint64_t slots[]; };
layout(set = 0, binding = 2) uniform sampler2DArray tail;
layout(set = 0, binding = 3) uniform sampler2DArray tail_count;

// n layers of their mean coverage; their colors count by coverage. Of layers without any, (1 - T) / A is 1: light just adds.
vec3 averaged_over(vec4 sum, float count, vec3 behind) {
    const float mean = count > 0.0 ? min(sum.a / count, 1.0) : 0.0;
    const float through = count > 0.0 ? pow(1.0 - mean, count) : 1.0;
    const float shown = sum.a > 0.0 ? (1.0 - through) / sum.a : 1.0;
    return sum.rgb * shown + through * behind;
}

vec3 tail_over(ivec3 at, vec3 behind) {
    const vec4 fallen = texelFetch(tail, at, 0);
    if (params.tail == tail_blend) return fallen.rgb + fallen.a * behind;
    if (params.tail == tail_hybrid) return averaged_over(fallen, texelFetch(tail_count, at, 0).r, behind);
    return behind;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const vec4 behind = imageLoad(color, at);
    vec3 sum = vec3(0.0);
    float through = 1.0;
    for (uint slot = 0u; slot < params.layers; ++slot) {
        const uint64_t key = slots[slot_index(at, slot)];
        if (key == empty_slot) break;
        const Layer layer = layer_of(key);
        sum += through * layer.color;
        through *= 1.0 - layer.alpha;
    }
    imageStore(color, at, vec4(sum + through * tail_over(at, behind.rgb), behind.a));
}
