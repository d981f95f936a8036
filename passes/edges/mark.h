// Declares the step that marks edges, and the rows that all techniques with such a step share.
#pragma once

#include <string>
#include <vector>

#include "passes/graph/graph.h"
#include "passes/settings.h"

namespace strata {

struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::edges {

/// Whether there is anything to mark: pixels have several samples. The stage may be forced on where they have one.
bool has_samples(const FrameImages&);

/// Declares frame.edges and the step of a compute shader that includes passes/edges/mark.glsl.
ComputeStep mark_edges(Graph&, FrameImages&, std::string shader);

/// Rows of EdgeCounters.
std::vector<Counter> edge_counters();

}  // namespace strata::edges
