// How much of a picture masked surfaces cover, against what their masks cover of every pixel (passes/gbuffer/coverage/truth.h).
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::gbuffer {

/// The share of a pixel that masked surfaces cover.
struct PixelCoverage {
    double got = 0, wanted = 0;  ///< of the result, and true
    double alpha = 0;            ///< mean alpha over the pixel: what it covers where alpha is coverage
    double own_error = 0;        ///< standard error of `wanted`
};

/// By pixel, row by row. Empty where a frame has no masked surfaces, which is asked before anything else. A sample counts as
/// masked where its depth is nearer than what is not masked. The images need depth_layers alone.
std::vector<PixelCoverage> pixel_coverage(const ImageSet& result, const ImageSet& truth, const Frame&);

/// Nothing where a frame has no masked surfaces. The mean difference of coverage per pixel, over pixels that either covers in
/// part or wholly, and by how much the whole area is off, in percent of the true one: fences and leaves that vanish or grow solid
/// where texels are small. Both once against the area where alpha reaches the cutoff and once against mean alpha. The relative
/// ones take a true area for at least 1 % of those pixels. Last the standard errors of the true area.
std::vector<Metric> coverage_metrics(const ImageSet& result, const ImageSet& truth, const Frame&);

}  // namespace strata::gbuffer
