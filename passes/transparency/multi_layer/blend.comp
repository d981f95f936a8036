// Inserts a sample's fragments into its nodes in the order of submission, as an ordered interlock would, and composites the nodes
// (Salvi and Vaidyanathan 2014): those of one bucket of depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/multi_layer/multi_layer.shared.h"

layout(push_constant, scalar) uniform Push {
    Band band;
    float log_nearest, buckets_per_log;
    uint bucket;
};
#include "passes/shaders/finished.glsl"
#include "passes/transparency/lists/fragments.glsl"
#include "passes/transparency/lists/per_iteration.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint layers = 4u;
layout(constant_id = 1) const uint buckets = 1u;
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 6, scalar) buffer Counters { MultiLayerCounters counters; };

struct Node {
    float z;
    vec3 rgb;
    vec3 t;
};
Node nodes[most_layers + 1u];  // indexed by constants alone: registers, and loops that are unrolled
uint used = 0u, merged = 0u;

uint bucket_of(float z) { return uint(clamp((log(z) - log_nearest) * buckets_per_log, 0.0, float(buckets - 1u))); }

// Before what is not nearer: of equal depths the later submission is in front.
void insert(Node node) {
    uint place = 0u;
    [[unroll]] for (uint i = 0u; i < layers; ++i) place += i < used && nodes[i].z < node.z ? 1u : 0u;
    [[unroll]] for (uint k = 0u; k < layers; ++k)
        if (layers - k > place) nodes[layers - k] = nodes[layers - k - 1u];
    [[unroll]] for (uint i = 0u; i < layers + 1u; ++i)
        if (i == place) nodes[i] = node;
    ++used;
}

void merge_last_two() {
    const Node far = nodes[layers];
    nodes[layers - 1u].rgb += nodes[layers - 1u].t * far.rgb;
    nodes[layers - 1u].t *= far.t;
    used = layers;
    ++merged;
}

void add(ListKey key) {
    if (buckets > 1u && bucket_of(key.z) != bucket) return;
    const ListFragment fragment = fragments[key.fragment];
    insert(Node(key.z, fragment.p + fragment.e, fragment.t));
    if (used > layers) merge_last_two();
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const ivec3 texel = ivec3(at.x, at.y + band.first_row, at.z);
    const uint cell = cell_of(texel.xy, at.z), start = starts[cell], count = list_count(cell);
    if (count == 0u) return;

    vec3 sum = vec3(0.0), through = vec3(1.0);
    for (uint i = 0u; i < count; i += per_iteration)
        [[unroll]] for (uint k = 0u; k < per_iteration; ++k)
            if (i + k < count) add(keys[start + i + k]);
    [[unroll]] for (uint i = 0u; i < layers; ++i) {
        if (i < used) {
            sum += through * nodes[i].rgb;
            through *= nodes[i].t;
        }
    }
    const vec4 behind = imageLoad(color, texel);
    imageStore(color, texel, vec4(sum + through * behind.rgb, behind.a));
    if (!finished(band.width)) atomicAdd(counters.lists.unfinished, 1u);
    if (merged > 0u) atomicAdd(counters.merged, merged);
}
