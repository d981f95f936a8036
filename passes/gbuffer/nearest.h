// The nearest opaque surface under every sample of a frame, in double, and its images: what truth and models start from.
#pragma once

#include <vector>

#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/reference/shade.h"

namespace strata::gbuffer {

struct NearestSurface {
    bool exists = false;
    bool undecided = false;  ///< coverage, depth order or alpha test hang on rounding
    SurfacePoint point;      ///< attributes at the sample or at the pixel's center
    double depth = 0;        ///< device depth near / z, always at the sample
    glm::dvec2 offset{0};    ///< from the pixel's center to where the position lies, in pixels
};

/// A surface that a sample may show instead of its nearest, as far as rounding decides.
struct RivalSurface {
    std::size_t texel = 0;
    NearestSurface surface;
};

struct SurfacesOfSamples {
    std::vector<NearestSurface> nearest;  ///< in the order of ReferenceImage's texels, layer = sample
    std::vector<RivalSurface> rivals;     ///< in the same order
};

/// Backs of one-sided faces and what the alpha test cuts are not there.
/// `masked` is a mode of passes/gbuffer/coverage/coverage.shared.h.
SurfacesOfSamples nearest_surfaces(const Frame&, ShadeAt, std::uint32_t masked = masked_clip);

/// surface_normal, surface_color, surface_material, emission and depth_layers as passes/frame_images.h defines them.
/// Rivals are alternatives of the first five.
ImageSet surface_images(const Frame&, const SurfacesOfSamples&);

}  // namespace strata::gbuffer
