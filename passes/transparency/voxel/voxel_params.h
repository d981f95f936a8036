// Parameters of voxel transparency. Their choices are the constants of voxel.shared.h.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct VoxelParams {
    std::uint32_t slices;  ///< there is memory for
    std::uint32_t volume;
    float thinnest;          ///< meters, of the nearest slice; what is adaptive or sparse is not cut finer
    std::uint32_t pool;      ///< MiB of blocks, with volume_sparse
    std::uint32_t skipping;  ///< 1: clearing and integration leave empty tiles out
    std::uint32_t splat;
    std::uint32_t bits;
    std::uint32_t packing;
    std::uint32_t splatting;
    std::uint32_t sampling;
    float shift;  ///< in slices, added to the sampling's bias
    std::uint32_t rounding;
    std::uint32_t curve;
    float near_thickness;  ///< meters, of the nearest slice with curve_thickness
    float linear;          ///< meters, with curve_linear
    std::uint32_t range;
    float farthest;  ///< meters, of the last slice's end with range_fixed
    std::uint32_t channels;
    std::uint32_t resolution;
    std::uint32_t accumulation;
    std::uint32_t culling;
    std::uint32_t prepared;
    std::uint32_t hysteresis;   ///< frames for which a coarser adaptive volume is held
    std::uint32_t shown_slice;  ///< of views, physical
    std::uint32_t tint;
    std::uint32_t thickness;
};

}  // namespace strata::transparency
