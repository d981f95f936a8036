// Truths that hang on rounding: what a result is compared with.
#pragma once

#include <vector>

#include "passes/reference/image.h"

namespace strata {

/// Makes every undecided texel with alternatives the color nearest to the result's, channel by channel, that lies between the
/// least and the largest of them and itself, and decided: its error is the distance to that interval. Texels without alternatives
/// stay undecided. Returns how much of an error that can hide: the root mean square of the intervals' widths over all texels and
/// channels, 0 wide where a texel is decided.
double settle(const ReferenceImage& got, ReferenceImage& truth);

/// By texel: whether it has alternatives.
std::vector<bool> has_alternatives(const ReferenceImage&);

}  // namespace strata
