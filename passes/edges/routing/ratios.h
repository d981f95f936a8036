// What routing saves: times against shading every sample, on walls whose edges are counted.
#pragma once

#include <vector>

#include "passes/claims.h"

namespace strata::edges {

/// The stages that read edges, with marking itself, against shading every sample, beside ((1 - e) + S e) / S of
/// docs/algorithms/deferred.md 3.4.
std::vector<TimeRatio> shading_ratios();

/// routing=list against routing=threads, for a technique that shades samples with shade_samples(). Which edges there are is
/// the choice of the edges stage.
std::vector<TimeRatio> routing_ratios();

}  // namespace strata::edges
