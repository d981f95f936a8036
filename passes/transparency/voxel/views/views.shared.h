// What views and tables of the volume share between C++ and shaders.
#ifndef PASSES_TRANSPARENCY_VOXEL_VIEWS_SHARED_H
#define PASSES_TRANSPARENCY_VOXEL_VIEWS_SHARED_H
#ifdef __cplusplus
#include "passes/shader_interop.h"
namespace strata::transparency {
#endif

// What view.comp shows.
const uint view_saturation_depth = 0u;
const uint view_overflow = 1u;
const uint view_thickness = 2u;
const uint view_occupancy = 3u;
const uint view_slice = 4u;
const uint view_slice_integral = 5u;

// What slice_table.comp has rows of.
const uint table_slices = 0u;
const uint table_runs = 1u;
const uint table_histogram = 2u;
const uint table_overflows = 3u;
const uint table_divider = 4u;

// What slice_counts.comp counts over all columns.
struct SliceCounts {
    uint tiles;
    uint columns;  // that hold something in it
    uint overflowed;
    uint saturated;
};

// Least optical depth read in pixels without fragments.
const uint reads_nothing = 0xffffffffu;

#ifdef __cplusplus
}
#endif
#endif
