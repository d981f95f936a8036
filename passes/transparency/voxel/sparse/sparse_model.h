// What the pool of a sparse volume has room for (docs/algorithms/transparency.md 6.13), in double.
#pragma once

#include "passes/transparency/voxel/sparse/sparse.h"

namespace strata::transparency {

/// How often slices must be halved for the blocks of a frame to fit: what blocks.comp finds.
std::uint32_t sparse_halvings(const VoxelParams&, const Frame&, Extent columns, std::uint32_t channels);

}  // namespace strata::transparency
