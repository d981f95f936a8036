// The sparse volume: blocks of 8 x 8 columns by a word for what each tile holds, out of a pool of fixed size
// (docs/algorithms/transparency.md 6.13: the talk's future work). pool.glsl has where they are.
#pragma once

#include "passes/transparency/voxel/slices/depth_curve.h"

namespace strata::transparency {

/// Products have no words to leave out: with splat_multiply what is asked to be sparse is adaptive.
bool is_sparse(const VoxelParams&);
bool is_adaptive(const VoxelParams&);

/// Tiles of so many columns, the last ones cut off by the edges.
Extent voxel_tiles(Extent columns);

/// Blocks that the pool has.
std::uint32_t pool_blocks(const VoxelParams&);
/// Whether it has one for each tile and channel: so that the coarsest resolution, a word for all of the depth, fits whatever is
/// there.
bool pool_suffices(const VoxelParams&, Extent columns, std::uint32_t channels);

/// What is noted of tiles that have so many virtual slices at most, in words of 32 bits.
struct SparseNotes {
    std::uint64_t marks = 0;  ///< marks.glsl
    std::uint64_t table = 0;  ///< pool.glsl
};
SparseNotes sparse_notes(const VoxelParams&, std::uint32_t slices, Extent columns);

/// depth_curve(), its slices halved until the notes are no larger than the pool.
DepthCurve sparse_curve(const VoxelParams&, DepthRange, Extent columns);

}  // namespace strata::transparency
