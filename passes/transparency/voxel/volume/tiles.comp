// Marks the words of each tile of 8 x 8 columns that are splatted to or read (docs/algorithms/transparency.md 6.8): what is
// cleared and integrated. A row of groups for each draw, a group for each of its triangles, a thread for each tile around it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/slices/coverage.glsl"
#include "passes/transparency/voxel/sources.glsl"
#include "passes/transparency/voxel/thick_fragments/thickness.glsl"
#include "passes/transparency/voxel/volume/tiles.glsl"

layout(local_size_x = 32) in;
layout(constant_id = 3) const uint field_bits = 8u;
layout(constant_id = 1) const uint splatting = splatting_linear;
layout(constant_id = 2) const uint sampling = sampling_linear;

const uint slices_per_word = 32u / field_bits;
#include "passes/transparency/voxel/sparse/marks.glsl"

// Bilinear reads reach a column further, unless what is not there can be read, too; rounding of rays and pixels less than a tenth
// of one.
const float reach = sparse != 0u ? 0.1 : 1.1;

// The tiles around a triangle, the last included.
struct TileRange {
    uvec2 first, last;
};

TileRange tiles_around(Triangle triangle) {
    vec2 low = vec2(0.0), high = vec2(push.width, push.height);
    if (triangle.nearest >= view.near) {
        low = high = column_of(triangle.corners[0]);
        for (uint i = 1u; i < 3u; ++i) {
            const vec2 column = column_of(triangle.corners[i]);
            low = min(low, column);
            high = max(high, column);
        }
    }
    const vec2 end = vec2(push.width, push.height) - 0.5;
    return TileRange(uvec2(clamp(low - reach, vec2(0.0), end)) / tile_size, uvec2(clamp(high + reach, vec2(0.0), end)) / tile_size);
}

Rays rays_of(uvec2 tile) {
    const vec2 first = vec2(tile * tile_size);
    return rays_through(first - reach, first + float(tile_size) + reach);
}

// Physical slices that fragments between these depths add to and read, the last included.
uvec2 slices_between(float nearest, float farthest) {
    const float from = slice_of_depth(nearest), to = slice_of_depth(farthest);
    const float splatted = splatting == splatting_linear ? 0.5 : 0.0, filtered = sampling == sampling_point ? 0.0 : 0.5;
    const int taps_before = sampling == sampling_bicubic ? 1 : 0, taps_behind = int(sampling);
    const int first = min(int(floor(from - splatted)), int(floor(from + push.bias - filtered)) - taps_before);
    const int last = max(int(floor(to - splatted) + 2.0 * splatted), int(floor(to + push.bias - filtered)) + taps_behind);
    return uvec2(max(ivec2(physical_slice(first), physical_slice(last)), 0));
}

uvec2 slices_of_layer(uint layer) {
    const int slice = slice_of_layer(layer);
    return uvec2(max(slice - 1, 0), slice);
}

// Returns how many words were not marked before.
uint mark_words(uint base, uvec2 slices) {
    const uint first = slices.x / slices_per_word, last = slices.y / slices_per_word;
    uint marked = 0u;
    for (uint i = first / 32u; i <= last / 32u; ++i) {
        const uint bits = bits_between(i, first, last);
        if ((tile_bits[base + i] & bits) != bits) marked += uint(bitCount(bits & ~atomicOr(tile_bits[base + i], bits)));
    }
    return marked;
}

// What fragments between these depths add to at every resolution: which one fits the pool is known when all are counted.
void mark_resolutions(uvec2 tile, vec2 depths) {
    const float from = finest_slice_of_depth(depths.x), to = finest_slice_of_depth(depths.y);
    const float splatted = splatting == splatting_linear ? 0.5 : 0.0;
    Resolution r = finest_resolution();
    while (true) {
        const float scale = exp2(-float(r.halvings));
        const vec2 slices = clamp(vec2(from * scale - splatted, to * scale + splatted), 0.0, float(r.slices) - 1.0);
        const uint marked = mark_words(first_mark_of(r, tile), uvec2(slices));
        if (marked > 0u) atomicAdd(tile_bits[r.halvings], marked);
        if (is_coarsest(r)) return;
        r = coarser(r);
    }
}

void mark(uvec2 tile, uint source, vec2 depths) {
    if (sparse != 0u) mark_resolutions(tile, depths);
    else mark_words(first_bits_of(tile, source), slices_between(depths.x, depths.y));
}

void main() {
    const DrawCommand command = commands[first_command + gl_WorkGroupID.y];
    const uint source = packs_colors != 0u ? source_of(command.first_instance) : source_gray;
    const uint layer = draws[command.first_instance].layer;
    const float half_deep = 0.5 * thickness_of(command.first_instance);
    for (uint i = gl_WorkGroupID.x; i < command.index_count / 3u; i += gl_NumWorkGroups.x) {
        const Triangle triangle = triangle_of(command, i);
        if (!is_seen(triangle)) continue;
        const TileRange around = tiles_around(triangle);
        const uvec2 count = around.last - around.first + 1u;
        for (uint t = gl_LocalInvocationIndex; t < count.x * count.y; t += gl_WorkGroupSize.x) {
            const uvec2 tile = around.first + uvec2(t % count.x, t / count.x);
            const vec2 depths = depths_within(triangle, rays_of(tile)) - triangle.depth_offset;
            if (depths.x > depths.y) continue;
            if (layer > 0u) mark_words(first_bits_of(tile, source), slices_of_layer(layer));
            else mark(tile, source, depths + vec2(-half_deep, half_deep));
        }
    }
}
