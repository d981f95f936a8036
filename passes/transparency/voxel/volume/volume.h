// The volume of voxels as steps of the graph: which slices it has, cleared, splatted into, integrated.
#pragma once

#include <cstdint>

#include "capture_format/frame/draw.h"
#include "passes/graph/step.h"
#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/voxel_params.h"

namespace strata {

class ComputeStep;   // passes/graph/graph.h
class DrawStep;      // passes/graph/graph.h
class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::transparency {

struct Volume {
    Image voxels;     ///< r32ui: layer = word of a column; channels one below the other, or see voxels.glsl; or the pool's blocks
    Buffer overflow;  ///< a word per column, four where colors are packed; one word where nothing notes overflows
    Buffer warp;      ///< WarpHeader and its table, of slices or of blocks; a header of zeros where all there is is dense
    Buffer tiles;     ///< a bit per tile, source and word of its columns, or sparse/marks.glsl; one word where nothing is skipped
    Image
        zero_slices;  ///< r32ui, of each column and channel: the first slice that is full, by its physical number, or no_overflow
    std::uint32_t divisor = 8, field_bits = 8;
    bool packs = false;           ///< colors, three to a word
    std::uint32_t thickness = 0;  ///< thickness_segment where any fragment is thick
    VoxelPush push;
};

/// Holds inclusive sums instead of extinction, where a tile uses a slice; anything elsewhere. Where the frame has no opaque depth
/// yet, of all that is transparent.
Volume integrated_volume(Graph&, const FrameImages&, const VoxelParams&);

/// The one integrated_volume() made at an earlier stage of the frame, to be read.
Volume earlier_volume(const Graph&, const FrameImages&, const VoxelParams&);

/// What is drawn into the volume and read from it: numbered triangles where their numbers decide how codes are rounded.
const DrawList& drawn_triangles(const FrameImages&, const VoxelParams&);

/// To a step that reads the integral at fragments' depths, and to one that knows slices' depths.
DrawStep& read_volume(DrawStep&, const Volume&, const VoxelParams&, Resolution drawn);
ComputeStep& read_slices(ComputeStep&, const Volume&, const VoxelParams&);

/// From the integral being full in a slice to all that a filtered read weighs being full, in slices
/// (docs/algorithms/transparency.md 6.9).
double slices_to_zero(const VoxelParams&);

/// To a step that looks at what is in columns: integral, overflows, tiles.
ComputeStep& look_into(ComputeStep&, Volume&, const VoxelParams&);

}  // namespace strata::transparency
