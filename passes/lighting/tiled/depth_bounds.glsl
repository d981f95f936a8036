// P0: how near and far the surfaces of a tile are, and what models they have. Depth is the G-buffer's: the points that are lit
// are made of it, while the depth image holds each sample's own, which may be a step of the code nearer or farther.
#ifndef PASSES_LIGHTING_TILED_DEPTH_BOUNDS_GLSL
#define PASSES_LIGHTING_TILED_DEPTH_BOUNDS_GLSL

const uint no_depth = 0xffffffffu;
const uint most_samples = 4u;

// The cells of a tile: two with half-Z, where surfaces lie on both sides of the middle (Stewart, GPU Pro 6, 2015).
struct TileCells {
    Cell near;
    Cell far;
    bool two;
};

// Bits of the view depth where something is lit: positive floats are in the order of their bits. 0 where not.
uint lit_depth(ivec3 at) {
    const Surface s = surface_at(at);
    if (!takes_light(s) || !(s.z > 0.0)) return 0u;
    const uint models = subgroupOr(model_feature(s.lighting_model));
    if (subgroupElect() && models != 0u) atomicOr(lists.models, models);
    return floatBitsToUint(s.z);
}

// Of the samples of the thread's pixel; a plain pixel is its first.
uvec4 lit_depths() {
    const ivec3 extent = textureSize(gbuffer0, 0);
    const ivec2 lane = ivec2(gl_LocalInvocationIndex % tile_size, gl_LocalInvocationIndex / tile_size);
    const ivec2 pixel = ivec2(gl_WorkGroupID.xy * tile_size) + lane;
    uvec4 depths = uvec4(0u);
    if (any(greaterThanEqual(pixel, extent.xy))) return depths;
    const uint samples = is_plain(pixel) ? 1u : min(uint(extent.z), most_samples);
    for (uint i = 0u; i < samples; ++i) depths[i] = lit_depth(ivec3(pixel, i));
    return depths;
}

// Each half's own bounds: what is nearer than the middle, and what is farther.
void split_depths(uvec4 depths) {
    const float middle = 0.5 * (uintBitsToFloat(lists.nearest) + uintBitsToFloat(lists.farthest));
    uint near_end = 0u, far_begin = no_depth;
    for (uint i = 0u; i < most_samples; ++i) {
        if (uintBitsToFloat(depths[i]) <= middle) near_end = max(near_end, depths[i]);
        else far_begin = min(far_begin, depths[i]);
    }
    near_end = subgroupMax(near_end);
    far_begin = subgroupMin(far_begin);
    if (!subgroupElect()) return;
    atomicMax(lists.near_end, near_end);
    atomicMin(lists.far_begin, far_begin);
}

void find_depths() {
    if (gl_LocalInvocationIndex == 0u) {
        lists.nearest = lists.far_begin = no_depth;
        lists.farthest = lists.near_end = lists.models = 0u;
    }
    barrier();
    const uvec4 depths = lit_depths();
    uint nearest = no_depth, farthest = 0u;
    for (uint i = 0u; i < most_samples; ++i) {
        if (depths[i] == 0u) continue;
        nearest = min(nearest, depths[i]);
        farthest = max(farthest, depths[i]);
    }
    nearest = subgroupMin(nearest);
    farthest = subgroupMax(farthest);
    if (subgroupElect()) {
        atomicMin(lists.nearest, nearest);
        atomicMax(lists.farthest, farthest);
    }
    barrier();
    if (half_z != 0u) split_depths(depths);
    barrier();
}

// How many cells a tile has, and one of them. Loops over them, instead of a call for each, halve what drivers translate.
uint cell_count(TileCells cells) { return cells.two ? 2u : 1u; }

Cell cell_of(TileCells cells, uint index) {
    Cell cell = cells.near;
    if (index != 0u) cell = cells.far;
    return cell;
}

TileCells cells_of_tile() {
    const float nearest = uintBitsToFloat(lists.nearest), farthest = uintBitsToFloat(lists.farthest);
    TileCells cells;
    cells.two = lists.far_begin != no_depth;
    cells.near = tile_cell(gl_WorkGroupID.xy, tile_size, nearest, cells.two ? uintBitsToFloat(lists.near_end) : farthest);
    cells.far = cells.near;
    if (cells.two) cells.far = tile_cell(gl_WorkGroupID.xy, tile_size, uintBitsToFloat(lists.far_begin), farthest);
    return cells;
}

#endif
