// How much of a picture masked surfaces cover, against a picture of 64 samples per pixel.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::gbuffer {

/// Prepares the truth of a frame with masked surfaces for coverage_figures(): what they cover of each pixel by 8 x 8 samples,
/// each with alpha filtered over its own 64th, and per sample how near what is not masked is. They go into the second and the
/// third channel of depth_layers, which has one: coverage is dear, and one truth judges many results.
void add_true_coverage(ImageSet& truth, const Frame&);

/// The share of a pixel that masked surfaces cover.
struct PixelCoverage {
    double got = 0, wanted = 0;
};

/// By pixel, row by row. Empty where a frame has no masked surfaces, which is asked before anything else. A sample counts as
/// masked where its depth is nearer than what is not masked. The images need depth_layers alone.
std::vector<PixelCoverage> pixel_coverage(const ImageSet& result, const ImageSet& truth, const Frame&);

/// Nothing where a frame has no masked surfaces. First the mean difference of coverage per pixel over pixels that either covers
/// in part or wholly, then by how much the whole area is off, in percent of the true one: fences and leaves that vanish or grow
/// solid where texels are small.
std::vector<Metric> coverage_metrics(const ImageSet& result, const ImageSet& truth, const Frame&);

}  // namespace strata::gbuffer
