// Modes by which alpha of masked surfaces becomes covered samples: what C++ and shaders share of them.
#ifndef PASSES_GBUFFER_COVERAGE_SHARED_H
#define PASSES_GBUFFER_COVERAGE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::gbuffer {
#endif

const uint masked_clip = 0u;             // alpha at the pixel's center against the cutoff: all samples or none
const uint masked_per_sample = 1u;       // alpha at every sample against the cutoff
const uint masked_per_sample_fine = 2u;  // the same, each tap as sharp as one of S samples
const uint masked_a2c_1 = 3u;            // bands of alpha, patterns that take turns
const uint masked_a2c_2 = 4u;            // dithered bands, one pattern; x + y dithers
const uint masked_a2c_or = 5u;           // the same; x | y dithers
const uint masked_full_step = 6u;        // the same; the dither spans a whole band
const uint masked_unbiased = 7u;         // dithered so that the mean coverage is alpha, and hashed by surface
const uint masked_mip_coverage = 8u;     // alpha scaled mip by mip so that as much stays as in the finest mip
const uint masked_sharpened = 9u;        // alpha steepened to one pixel around the cutoff, then bands
const uint masked_hardware = 10u;        // the device's alpha to coverage, in a pass of its own before the fill
const uint masked_dithered = 11u;  // of shadow maps alone: a dither of 16 steps over 4 x 4 texels (passes/shadows/cast.frag)

// Mips of a texture that have a scale of their own; coarser ones take the last.
const uint mask_scale_mips = 16u;

// The image of scales: so many materials a row.
const uint mask_scale_columns = 64u;

// The scales of one material's mips, finest first.
struct MaskScalesPush {
    uint material;
    float scales[mask_scale_mips];
};

#ifdef __cplusplus
}
#else
ivec2 mask_scale_texel(uint material, uint mip) {
    return ivec2((material % mask_scale_columns) * mask_scale_mips + mip, material / mask_scale_columns);
}
#endif
#endif
