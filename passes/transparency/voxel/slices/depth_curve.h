// Where slices of voxels end in depth (docs/algorithms/transparency.md 6.2): s(z) = n ln(1 + (z - nearest) / a) /
// ln(1 + (farthest - nearest) / a). About even up to a behind the nearest, logarithmic beyond; it may begin at the eye because of
// the 1.
#pragma once

#include "passes/depth_range.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/voxel_params.h"

namespace strata::transparency {

struct DepthCurve {
    double slices = 128;    ///< n
    double linear = 3.25;   ///< a, in the unit of depth
    double farthest = 800;  ///< where slice n ends
    double nearest = 0;     ///< where slice 0 begins

    /// Real: slice k reaches from k to k + 1. Not clamped.
    double slice_of(double z) const;
    double depth_of(double slice) const;
    /// dz / ds.
    double thickness_at(double z) const;
};

/// a at which the nearest slice is so thick, however many there are: a ln(1 + range / a) = n thickness. At most 10 ranges,
/// where slices are even to 5 % and thinner ones than asked for: n of them would reach farther.
double linear_of_thickness(double slices, double range, double near_thickness);

/// The depths of the frame's transparent world (what is in no interface layer), wider by half of its deepest fragment, both in
/// meters; or, with range=fixed, from the eye to `farthest`.
DepthRange voxel_range(const VoxelParams&, DepthRange world, double deepest, float near);

/// Cut into `slices`; or, where they are adaptive, into as many as 8192 of these that are not thinner than `thinnest`: halves,
/// quarters and so on of most_virtual_slices, and at least one less than twice `slices`.
DepthCurve depth_curve(const VoxelParams&, DepthRange);

}  // namespace strata::transparency
