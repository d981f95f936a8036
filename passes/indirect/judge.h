// How far the bounced light of a technique is from what is gathered, and how much of it is where none can be.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// Root mean square error of irradiance / pi, the same relative to the truth's root mean square, the worst channel, the leak: the
/// mean of the result over pixels to whose surfaces the truth gives exactly 0, relative to the mean of the truth over all other
/// surfaces (0 where no pixel is dark), and the dark pixels' share of all surfaces in percent: what the leak is measured on.
std::vector<Metric> indirect_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
