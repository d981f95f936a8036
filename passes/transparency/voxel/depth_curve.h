// Where slices of voxels end in depth (transparency chapter 6.2, with the near end at the eye): s(z) = n ln(1 + z / a) /
// ln(1 + farthest / a). About even up to z = a, logarithmic beyond; defined from z = 0 on because of the 1.
#pragma once

#include "passes/transparency/voxel/voxel.shared.h"

namespace strata::transparency {

struct DepthCurve {
    double slices = 128;    ///< n
    double linear = 3.25;   ///< a, in the unit of depth
    double farthest = 800;  ///< where slice n ends

    /// Real: slice k reaches from k to k + 1. Not clamped.
    double slice_of(double z) const;
    double depth_of(double slice) const;
    /// dz / ds.
    double thickness_at(double z) const;
};

/// a at which the nearest slice is so thick, however many there are: a ln(1 + farthest / a) = n thickness. At most 10 farthest,
/// where slices are even to 5 % and thinner ones than asked for: n of them would reach farther.
double linear_of_thickness(double slices, double farthest, double near_thickness);

DepthCurve depth_curve(const VoxelParams&);

}  // namespace strata::transparency
