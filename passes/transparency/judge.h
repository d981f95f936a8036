// How far a transparency technique is from the exact blend, over the samples whose coverage is decided.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// rmse and worst sample in radiance, rmse relative to the truth's root mean square, bias (mean signed error: above 0 things
/// shine through that should not, or nothing hides them); of each sample's relative error the 95th and 99th percentile and the
/// share of samples over 2 % and over 10 %; and the share of samples more than 1/255 off after the tone curve.
std::vector<Metric> transparency_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

/// The bound is of the relative rmse.
Metric settle_transparency(const ImageSet& result, ImageSet& truth);

}  // namespace strata
