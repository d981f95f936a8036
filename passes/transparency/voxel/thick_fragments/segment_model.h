// Thick fragments: optical depth that lies evenly between two depths, and is added to every slice there
// (docs/algorithms/transparency.md 6.5, thick objects). Point fragments lie at one depth; the truth knows no others, so what this
// gives is steadiness.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passes/reference/fragments.h"
#include "passes/transparency/voxel/slices/depth_curve.h"
#include "passes/transparency/voxel/volume/column.h"
#include "passes/transparency/voxel/volume/dimensions.h"

namespace strata::transparency {

/// How deep a fragment is along the view, in meters, or the fragments of a draw: what its emitter fades over before opaque
/// surfaces.
double thickness_of(const VoxelParams&, const Fragment&);
double thickness_of(const VoxelParams&, const Frame&, std::uint32_t draw);
/// voxel_range() of a recorded frame, as models derive it.
DepthRange voxel_range(const VoxelParams&, const Frame&);

struct Segment {
    DepthCurve curve;  ///< of virtual slices
    double farthest = 0, meters = 0;
    int first = 0, last = 0;  ///< virtual slices it is in

    /// The code of what is at or behind the front of a slice: differences from slice to slice add up to the unsplit code.
    std::uint32_t code_behind(int slice, double codes, double rounding) const;
    /// Those differences, from the first slice to the last.
    std::vector<std::uint32_t> codes_of_slices(double codes, double rounding) const;
};

/// Of a fragment at a depth. A linear splat is one slice deep itself: what is thinner than that is a point, as nothing is.
std::optional<Segment> segment_at(const DepthCurve& of_virtual_slices, double depth, double meters, std::uint32_t splatting);

/// An integral less what the fragment itself added to it. What is full stays full: who filled it is not known.
double without_own(const ColumnFormat&, double integral, double own);

}  // namespace strata::transparency
