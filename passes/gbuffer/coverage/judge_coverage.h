// How much of a picture masked surfaces cover, against a picture of 64 samples per pixel.
#pragma once

#include <vector>

#include "passes/stages.h"

namespace strata::gbuffer {

/// Nothing where a frame has no masked surfaces. A sample counts as masked where its depth is nearer than what is not masked.
/// First the mean difference of coverage per pixel over pixels that either covers in part or wholly, then by how much the whole
/// area is off, in percent of the true one: fences and leaves that vanish or grow solid where texels are small.
std::vector<Figure> coverage_figures(const ImageSet& result, const StageInput&);

/// The share of each pixel that masked surfaces cover, by 8 x 8 samples per pixel, each with alpha filtered over its own 64th.
std::vector<double> true_coverage(const Frame&);

}  // namespace strata::gbuffer
