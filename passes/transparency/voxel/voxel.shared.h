// What voxel transparency's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_VOXEL_SHARED_H
#define PASSES_TRANSPARENCY_VOXEL_SHARED_H
#include "passes/transparency/functions/function.shared.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// A word of 32 bits for each slice; or as many slices in a word as fit, added to with a wrapping add, by compare-and-swap that
// saturates, or wrapping with a note of the nearest slice that did. Or no sum: the product of what is let through, by blending.
const uint splat_words = 0u;
const uint splat_wrapping = 1u;
const uint splat_saturating = 2u;
const uint splat_overflow_minimum = 3u;
const uint splat_multiply = 4u;

const uint bits_8 = 0u;
const uint bits_10 = 1u;
const uint bits_16 = 2u;
const uint bits_32 = 3u;

// Of three channels: a volume each; or all of a slice in one word, of what has a color, and a volume for what is gray.
const uint packing_planes = 0u;
const uint packing_rgb10 = 1u;

const uint splatting_point = 0u;
const uint splatting_linear = 1u;

const uint sampling_point = 0u;
const uint sampling_linear = 1u;
const uint sampling_bicubic = 2u;

// A fragment is at its depth; or lies evenly around it, as deep as its emitter fades before opaque surfaces.
const uint thickness_point = 0u;
const uint thickness_segment = 1u;

const uint rounding_nearest = 0u;
const uint rounding_stochastic = 1u;

const uint curve_slices = 0u;
const uint curve_thickness = 1u;
const uint curve_linear = 2u;

// Slices cut all of the range of depth; or only what holds something anywhere, as finely as their number allows; or each tile has
// blocks where it holds something, as finely as a pool of them allows.
const uint volume_dense = 0u;
const uint volume_adaptive = 1u;
const uint volume_sparse = 2u;

const uint range_frame = 0u;
const uint range_fixed = 1u;

// What keeps fragments of which nothing is seen from being shaded: quads of so many pixels, or a depth written in every pixel.
const uint culling_off = 0u;
const uint culling_quads_16 = 1u;
const uint culling_quads_32 = 2u;
const uint culling_full_screen = 3u;

// When the volume is made.
const uint prepared_after_opaque = 0u;
const uint prepared_before_opaque = 1u;

// Push constants of the steps. Slices that are adaptive have two numbers: among those that cut all of the range ("virtual"), and
// among those that are there ("physical"). Where nothing is adaptive they are the same.
struct VoxelPush {
    float nearest;          // meters: where the first slice begins
    float per_linear;       // 1 / a, per meter: depth is divided evenly up to a behind that, logarithmically beyond
    float slices_per_log2;  // n / log2(1 + range / a), of the finest virtual slices
    uint finest_slices;     // n: a power of two where slices are adaptive, at most most_virtual_slices
    uint slices;            // physical, those of interface layers among them
    uint words;             // of a column
    uint width;             // columns
    uint height;
    uint channels;                // 1 or 3
    uint full_code;               // M: the code of t = 1 / M, from which on nothing is seen
    float codes_per_depth;        // M / ln M
    float bias;                   // in slices
    float color_codes_per_depth;  // of words of three channels
    uint color_scale;             // codes to those of words of three channels, in color_scale_one
    uint interfaces;              // layers: physical slices in front of the world's, the highest layer's first
};

// What slices/warp.comp and sparse/blocks.comp find out, in front of their tables.
struct WarpHeader {
    uint halvings;        // of the finest slices until what is used fits
    uint virtual_slices;  // that are left: finest_slices >> halvings
    uint used;            // of these, slices with something in them; words of all tiles, where blocks are
    uint fitting;         // halvings that this frame needs; more are held of those before it
};
const uint most_virtual_slices = 8192u;
// Of a volume, those of interface layers among them: nobody may ask for more.
const uint most_slices = 1024u;
// An entry of the table: the number of used slices up to and with this one, whether it is used, and first or last of a run.
const uint warp_count_mask = 0xffffu;
const uint warp_used = 1u << 16u;
const uint warp_begin = 1u << 17u;
const uint warp_end = 1u << 18u;

// What slices/warp.comp leaves to the next frame.
struct VoxelHistory {
    float thickness;    // meters, of the nearest slice; 0: there was no frame
    uint finer_frames;  // in a row, that would have fitted into thinner ones
};

struct VoxelCounters {
    FunctionCounters function;
    uint columns;
    uint atomics;
    uint border_atomics;
    uint uncovered;
    uint overflowed;
    uint saturated;
    uint voxels;
    uint cleared;
    uint integrated;
    uint slices_used;
    uint virtual_slices;
    uint zero_tiles;
    uint unseen;
    uint halvings;
    uint halvings_held;
    uint blocks;
};

// Columns of a tile, each way.
const uint tile_size = 8u;
// A block is a word of each of a tile's columns, 256 bytes. A layer of the pool has so many of them each way: a MiB.
const uint pool_blocks_across = 64u;
const uint pool_blocks_per_layer = pool_blocks_across * pool_blocks_across;
// In front of the marks that sparse/marks.glsl lays out: how many there are at each resolution, from 8192 slices down to one, and
// how many words of the resolution chosen have got their place.
const uint words_placed = 14u;
const uint first_mark = 15u;
// Between what slices/coverage.glsl makes of a triangle's corners and what its fragments interpolate: of depth, and of rays in z
// = 1. Beyond `steepest`, distance over distance to the plane, a triangle's plane says nothing in float.
const float depth_slack = 2e-6f;
const float ray_slack = 1e-5f;
const float steepest = 1000.0f;
// Fields of words of three channels, red lowest: codes of 8 bits, and two more that hold four of the largest before one of them
// is carried into the next channel.
const uint color_bits = 10u;
const uint color_full_code = 255u;
const uint color_scale_one = 1u << 22u;
// Sources that tiles tell apart where colors are packed, and planes of notes of overflow: that of gray, then one for each
// channel.
const uint source_gray = 0u;
const uint source_color = 1u;
// Of columns in which no slice overflowed, or none is full.
const uint no_overflow = 0xffffffffu;
// A filtered integral is full from here on, in M: weights that add up to 1 do so up to rounding.
const float full_share = 0.99999f;
// A fragment at or beyond the end is so far in front of it: in the last slice, and not behind it.
const float end_margin = 0.001f;

#ifdef __cplusplus
}
#endif
#endif
