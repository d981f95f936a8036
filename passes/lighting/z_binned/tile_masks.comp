// A bit per sorted light and tile: set where the light touches the tile's cell (docs/algorithms/lighting.md 1.4). One group per
// tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/lighting/tile_cell.glsl"
#include "passes/lighting/z_binned/bins.glsl"

layout(local_size_x = 256) in;
layout(constant_id = 4) const uint bounds = 1u;

layout(set = 0, binding = 1, scalar) readonly buffer Sorted { ZLight sorted[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Header { ZHeader header; };
layout(set = 0, binding = 3, scalar) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 4, scalar) buffer Counters { ZBinnedCounters counters; };
layout(push_constant, scalar) uniform Push { ZBinsPush push; };

shared uint nearest_bits, farthest_bits;  // of view z: positive floats are in the order of their bits
shared uint words[8];
shared uint kept;

// From the G-buffer and not from depth: what is lit lies where the decoded surface is, which rounding may have moved.
void read_depths() {
    const ivec3 size = textureSize(gbuffer0, 0);
    const uint area = push.tile_size * push.tile_size;
    for (uint i = gl_LocalInvocationIndex; i < area; i += 256u) {
        const ivec2 pixel = ivec2(gl_WorkGroupID.xy * push.tile_size + uvec2(i % push.tile_size, i / push.tile_size));
        if (any(greaterThanEqual(pixel, size.xy))) continue;
        for (int sample_index = 0; sample_index < size.z; ++sample_index) {
            const Surface s = surface_at(ivec3(pixel, sample_index));
            if (!s.exists || !(s.z > 0.0)) continue;
            atomicMin(nearest_bits, floatBitsToUint(s.z));
            atomicMax(farthest_bits, floatBitsToUint(s.z));
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
        nearest_bits = 0xffffffffu;
        farthest_bits = 0u;
        kept = 0u;
    }
    barrier();
    read_depths();
    barrier();
    const uint tile = gl_WorkGroupID.y * push.tiles_across + gl_WorkGroupID.x;
    if (farthest_bits == 0u) {  // no surface: nothing reads the mask
        for (uint word = gl_LocalInvocationIndex; word < push.words; word += 256u) masks[tile * push.words + word] = 0u;
        return;
    }
    const bool tight = bounds == bounds_depth;
    write_words(tile, tile_cell(gl_WorkGroupID.xy, push.tile_size, tight ? uintBitsToFloat(nearest_bits) : header.near,
                                tight ? uintBitsToFloat(farthest_bits) : header.far));
    if (gl_LocalInvocationIndex == 0u) atomicAdd(counters.tile_lights, kept);
}
