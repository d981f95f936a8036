// A bit per sorted light and tile: set where the light touches the tile's cell (lighting chapter 1.4). One group per tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/lighting/tile_cell.glsl"
#include "passes/lighting/z_binned/bins.glsl"

layout(local_size_x = 256) in;
layout(constant_id = 0) const uint bounds = 1u;

layout(set = 0, binding = 0) uniform sampler2DArray depth_layers;
layout(set = 0, binding = 1, scalar) readonly buffer Sorted { ZLight sorted[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Header { ZHeader header; };
layout(set = 0, binding = 3, scalar) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 4, scalar) buffer Counters { ZBinnedCounters counters; };
layout(push_constant, scalar) uniform Push { ZBinsPush push; };

shared uint nearest_bits, farthest_bits;  // of reversed depth: positive floats are in the order of their bits
shared uint words[8];
shared uint kept;

void read_depths() {
    const ivec3 size = textureSize(depth_layers, 0);
    const uint area = push.tile_size * push.tile_size;
    for (uint i = gl_LocalInvocationIndex; i < area; i += 256u) {
        const ivec2 at = ivec2(gl_WorkGroupID.xy * push.tile_size + uvec2(i % push.tile_size, i / push.tile_size));
        if (any(greaterThanEqual(at, size.xy))) continue;
        for (int sample_index = 0; sample_index < size.z; ++sample_index) {
            const float depth = texelFetch(depth_layers, ivec3(at, sample_index), 0).r;
            if (!(depth > 0.0)) continue;
            atomicMax(nearest_bits, floatBitsToUint(depth));
            atomicMin(farthest_bits, floatBitsToUint(depth));
        }
    }
}

bool touches(uint i, Cell cell) { return i < push.lights && light_touches(lights[sorted[i].light], cell); }

// 256 lights at a time are 8 words.
void write_words(uint tile, Cell cell) {
    const uint thread = gl_LocalInvocationIndex;
    for (uint first = 0u; first < push.lights; first += 256u) {
        if (thread < 8u) words[thread] = 0u;
        barrier();
        if (touches(first + thread, cell)) {
            atomicOr(words[thread / 32u], 1u << (thread & 31u));
            atomicAdd(kept, 1u);
        }
        barrier();
        const uint word = first / 32u + thread;
        if (thread < 8u && word < push.words) masks[tile * push.words + word] = words[thread];
        barrier();
    }
}

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        nearest_bits = 0u;
        farthest_bits = 0xffffffffu;
        kept = 0u;
    }
    barrier();
    read_depths();
    barrier();
    const uint tile = gl_WorkGroupID.y * push.tiles_across + gl_WorkGroupID.x;
    if (nearest_bits == 0u) {  // no surface: nothing reads the mask
        for (uint word = gl_LocalInvocationIndex; word < push.words; word += 256u) masks[tile * push.words + word] = 0u;
        return;
    }
    const bool tight = bounds == bounds_depth;
    write_words(tile, tile_cell(gl_WorkGroupID.xy, push.tile_size, tight ? view_z(uintBitsToFloat(nearest_bits)) : header.near,
                                tight ? view_z(uintBitsToFloat(farthest_bits)) : header.far));
    if (gl_LocalInvocationIndex == 0u) atomicAdd(counters.tile_lights, kept);
}
