// Two-phase occlusion culling in double, in parts that have facts of their own: bounds of spheres and the pyramid of depth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "passes/culling/hiz_two_phase/hiz_two_phase.shared.h"
#include "passes/image_set.h"
#include "passes/reference/bounds.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h
struct View;        // capture_format/view.h

}  // namespace strata

namespace strata::culling {

/// In pixels from the picture's upper left corner, y down, and the largest device depth of the sphere.
struct SphereBounds {
    glm::dvec2 low{0}, high{0};
    double nearest = 0;
};
/// The tightest box around a sphere's picture (Mara, McGuire 2013). Nothing where it reaches over the near plane.
std::optional<SphereBounds> bounds_in_picture(const View&, const Sphere&);

/// Pixels, both ends included; last < first is none.
struct PixelRange {
    glm::ivec2 first{0}, last{-1};
    bool empty() const { return last.x < first.x || last.y < first.y; }
};
/// The pixels of the picture that have a sample within the bounds.
PixelRange pixels_of(const View&, const SphereBounds&);

/// Farthest depths: a texel of level n is the least device depth of the 2^n x 2^n pixels it covers, those in the picture.
class DepthPyramid {
public:
    /// One depth per pixel, row by row.
    DepthPyramid(std::uint32_t width, std::uint32_t height, std::vector<double> depth);

    struct Level {
        std::uint32_t width = 0, height = 0;
        std::vector<double> depth;
        double at(std::uint32_t x, std::uint32_t y) const { return depth[std::size_t(y) * width + x]; }
    };
    const std::vector<Level>& levels() const { return levels_; }
    /// Least depth over the range in the finest level in which it is at most so many texels wide and high.
    double farthest(const PixelRange&, std::uint32_t across) const;

private:
    std::vector<Level> levels_;
};

/// The place of a size among the bins of a cold start.
std::uint32_t size_bin(double radius_over_depth);

ImageSet hiz_two_phase_model(const StageInput&, const Settings&);

}  // namespace strata::culling
