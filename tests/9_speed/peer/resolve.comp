// Sorts the list of each pixel, nearest first, and composites it over the background.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "tests/9_speed/peer/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, r32ui) readonly uniform uimage2D heads;
layout(set = 0, binding = 1, scalar) readonly buffer Nodes { Node list_nodes[]; };
layout(set = 0, binding = 2, scalar) buffer Counters { uint used; uint too_long; };
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D picture;

const uint most_layers = 64u;

struct Layer {
    float depth;
    uint node;
};

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= width || pixel.y >= height) return;
    Layer layers[most_layers];
    uint count = 0u, node = imageLoad(heads, pixel).r;
    for (; node != no_node && count < most_layers; ++count) {
        const float depth = list_nodes[node].depth;
        uint at = count;
        for (; at > 0u && layers[at - 1u].depth < depth; --at) layers[at] = layers[at - 1u];
        layers[at] = Layer(depth, node);
        node = list_nodes[node].next;
    }
    if (node != no_node) atomicAdd(too_long, 1u);
    vec3 sum = vec3(0.0);
    float through = 1.0;
    for (uint i = 0u; i < count; ++i) {
        const uvec2 color = list_nodes[layers[i].node].color;
        const vec2 rg = unpackHalf2x16(color.x), ba = unpackHalf2x16(color.y);
        sum += through * vec3(rg, ba.x);
        through *= 1.0 - ba.y;
    }
    imageStore(picture, pixel, vec4(sum + through * background, 1.0));
}
