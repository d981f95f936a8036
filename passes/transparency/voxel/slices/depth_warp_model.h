// Which slices hold something, and the table that packs these and leaves the others out (docs/algorithms/transparency.md 6.10 and
// 6.11).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passes/reference/triangles.h"
#include "passes/transparency/voxel/slices/depth_curve.h"

namespace strata::transparency {

/// Which halves of slices some geometry is in. Halves, because a linear splat at s adds to floor(s - 1/2) and the slice behind:
/// from halves it is known which slices these are, at this resolution and at every coarser one.
class Coverage {
public:
    explicit Coverage(std::uint32_t slices) : halves_(2 * slices, false) {}

    std::uint32_t slices() const { return static_cast<std::uint32_t>(halves_.size() / 2); }
    /// Everything from slice coordinate `from` to `to`, both ends included; clamped to the volume.
    void take(double from, double to);
    /// Of slices that are twice as thick.
    Coverage coarser() const;
    /// Slices that splats of what is here add to, by number.
    std::vector<bool> used(std::uint32_t splatting) const;

private:
    std::vector<bool> halves_;
};

struct DepthWarp {
    std::uint32_t halvings = 0;
    std::vector<std::uint32_t> counts;  ///< of used slices up to and with each virtual one

    std::uint32_t virtual_slices() const { return static_cast<std::uint32_t>(counts.size()); }
    /// 0 in front of the volume, all behind it.
    std::uint32_t count_up_to(int slice) const;
    bool is_used(std::uint32_t slice) const { return counts[slice] > count_up_to(static_cast<int>(slice) - 1); }
    /// The physical slice that has a virtual one's number in the integral: its own, or where it is empty that in front of it,
    /// behind which nothing came; -1: nothing is in front.
    int physical(int slice) const { return static_cast<int>(count_up_to(slice)) - 1; }
    /// The filterable form Q(t), in texels of the packed volume (their centers at whole numbers), at t in slices' centers:
    /// one linear read there is what two reads at floor(t) and floor(t) + 1 would give.
    double packed(double t) const;
};

/// Twice as thick until no more than `physical` slices are used.
DepthWarp depth_warp(Coverage, std::uint32_t physical, std::uint32_t splatting);
/// Nothing is left out.
DepthWarp unwarped(std::uint32_t slices);

/// Rays through a part of the image, z = 1.
struct RayRectangle {
    glm::dvec2 low, high;
};
struct Depths {
    double nearest, farthest;
};
/// View depths of a triangle where these rays may meet it, at least `near`; nothing if none does. The plane through the eye and
/// an edge tells on which side of it the rays pass, the triangle's own plane what depths they meet: nothing needs to be clipped.
std::optional<Depths> depths_within(const Corners&, const RayRectangle&, double near);

/// What the frame's transparent triangles but those of interface layers cover of the curve's slices, each over as much of its
/// depth as may be seen.
Coverage transparent_coverage(const VoxelParams&, const Frame&, const DepthCurve&);

/// The warp that the parameters ask for.
DepthWarp depth_warp(const VoxelParams&, const Frame&, const DepthCurve&);

}  // namespace strata::transparency
