// Depth of field in double, from docs/algorithms/deferred.md 8.7 and passes/lens/camera/README.md.
#pragma once

#include "passes/lens/lens_params.h"
#include "passes/reference/image.h"

namespace strata {

struct Frame;       // capture_format/frame.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::lens {

/// Radius in pixels of the disc that a thin lens makes of a point at view depth z (infinity for the background), negative before
/// the plane in focus: aperture / 2 * (1 / focus - 1 / z) * P11 * height / 2.
double blur_radius(const Frame&, double z);
/// X-Ray's b(z).
double xray_blur(double z, double focus);

/// View depth of a sample of the picture; infinity where there is no surface.
double depth_of(const StageInput&, std::uint32_t x, std::uint32_t y, std::uint32_t sample);

/// `color` as the lens sees it. Texels are undecided where rounding decides which sample a tap reads.
ReferenceImage focus_model(const StageInput&, const ReferenceImage& color, const LensParams&);

/// Taps of focus=gather that fall before the surface of each pixel's first sample, on it and behind it.
ReferenceImage counted_taps(const StageInput&, const LensParams&);

}  // namespace strata::lens
