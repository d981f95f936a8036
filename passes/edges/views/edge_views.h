// Debug views and a table that every technique of the stage has.
#pragma once

#include <vector>

#include "passes/debug_views.h"

namespace strata::edges {

/// surfaces: how many surfaces the samples of a pixel show. outcome: which marks are right, missing or needless.
std::vector<DebugView> edge_views();
/// surfaces per pixel: pixels by how many surfaces their samples show, and how many of them are marked.
std::vector<DebugTable> edge_tables();

}  // namespace strata::edges
