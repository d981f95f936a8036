// What voxel transparency's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_VOXEL_SHARED_H
#define PASSES_TRANSPARENCY_VOXEL_SHARED_H
#include "passes/transparency/function.shared.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// A word of 32 bits for each slice; or as many slices in a word as fit, added to with a wrapping add, by compare-and-swap that
// saturates, or wrapping with a note of the nearest slice that did.
const uint splat_words = 0u;
const uint splat_wrapping = 1u;
const uint splat_saturating = 2u;
const uint splat_overflow_minimum = 3u;

const uint bits_8 = 0u;
const uint bits_16 = 1u;
const uint bits_32 = 2u;

const uint splatting_point = 0u;
const uint splatting_linear = 1u;

const uint sampling_point = 0u;
const uint sampling_linear = 1u;
const uint sampling_bicubic = 2u;

const uint rounding_nearest = 0u;
const uint rounding_stochastic = 1u;

const uint curve_slices = 0u;
const uint curve_thickness = 1u;

// What view.comp shows.
const uint view_zero_depth = 0u;
const uint view_overflow = 1u;
const uint view_thickness = 2u;

struct VoxelParams {
    uint slices;
    uint splat;
    uint bits;
    uint splatting;
    uint sampling;
    float shift;  // in slices, added to the sampling's bias
    uint rounding;
    uint curve;
    float near_thickness;  // metres, of the nearest slice with curve_thickness
    float farthest;        // metres, of the last slice's end
    uint channels;
    uint resolution;
    uint accumulation;
};

// Push constants of the steps.
struct VoxelPush {
    float per_linear;       // 1 / a, per metre: depth is divided evenly up to a, logarithmically beyond
    float slices_per_log2;  // n / log2(1 + farthest / a)
    uint slices;
    uint width;  // columns
    uint height;
    uint channels;          // 1 or 3
    uint full_code;         // M: the code of t = 1 / M, from which on nothing is seen
    float codes_per_depth;  // M / ln M
    float bias;             // in slices
};

struct VoxelCounters {
    FunctionCounters function;
    uint columns;
    uint atomics;
    uint border_atomics;
    uint overflowed;
    uint saturated;
};

// Of columns in which no slice overflowed.
const uint no_overflow = 0xffffffffu;
// A filtered integral is full from here on, in M: weights that add up to 1 do so up to rounding.
const float full_share = 0.99999f;
// An event at or beyond the end is so far in front of it: in the last slice, and not behind it.
const float end_margin = 0.001f;

#ifdef __cplusplus
}
#endif
#endif
