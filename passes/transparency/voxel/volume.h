// The volume of voxels as steps of the graph: cleared, splatted into, integrated.
#pragma once

#include <cstdint>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/transparency/voxel/voxel.shared.h"

namespace strata::transparency {

struct Volume {
    Buffer voxels;    ///< words, by channel, row, column, then slices
    Buffer overflow;  ///< a word per column; one word where nothing notes overflows
    std::uint32_t divisor = 8, field_bits = 8;
    VoxelPush push;

    /// Binds the voxels to a step whose shader includes voxels.glsl.
    template <typename Pass>
    Pass& bind(Pass&& pass) {
        return pass.updates("Voxels", voxels).fixes("field_bits", field_bits).push(push);
    }
};

/// Holds inclusive sums instead of extinction.
Volume integrated_volume(Graph&, const FrameImages&, const VoxelParams&);

/// One of view_zero_depth, view_overflow, view_thickness.
Image volume_view(Graph&, const FrameImages&, const VoxelParams&, std::uint32_t shown);

}  // namespace strata::transparency
