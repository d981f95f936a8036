// What z-binning's C++ and its shaders share.
#ifndef PASSES_LIGHTING_Z_BINNED_SHARED_H
#define PASSES_LIGHTING_Z_BINNED_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::lighting {
#endif

const uint spacing_uniform = 0u;
const uint spacing_logarithmic = 1u;
const uint bounds_frustum = 0u;  // a tile's lights are those that touch its frustum
const uint bounds_depth = 1u;    // ... or the part of it between its nearest and farthest surface
const uint merge_lanes = 0u;
const uint merge_subgroup = 1u;

const float z_largest = 3.4e38f;  // as good as infinite

const uint view_pixel_lights = 0u;
const uint view_tile_lights = 1u;
const uint view_idle_lights = 2u;

// What the steps are told.
struct ZBinsPush {
    uint lights;  // submitted
    uint padded;  // the power of two that is sorted
    uint words;   // of a tile's mask
    uint bins;
    uint spacing;
    uint tile_size;  // pixels per edge
    uint tiles_across;
};

// A light in the order of its nearest depth. Those that are everywhere come first, with both depths at -z_largest.
struct ZLight {
    float nearest;   // view z its reach begins at
    float farthest;  // ... and ends at
    float reached;   // the largest `farthest` up to here: it grows, so it can be searched
    uint light;      // index into lights
};

struct ZHeader {
    uint everywhere;  // how many of the sorted lights reach every depth
    float near;       // view z of the first bin's begin
    float far;        // ... and of the last one's end
    float scale;      // bins per meter, or per unit of log(z / near)
};

struct ZBinnedCounters {
    uint evaluations;
    uint words_read;
    uint samples_shaded;
    uint tile_lights;
    uint unfinished;
};

#ifdef __cplusplus
}
#endif
#endif
