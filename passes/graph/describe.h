// A plan for people: text to read and diff, and Graphviz to draw.
#pragma once

#include <string>

#include "passes/graph/plan.h"

namespace strata {

/// Steps in order with their barriers and memory, then what was culled and why.
std::string describe(const Plan&);
/// The same as a Graphviz digraph of steps and images.
std::string describe_dot(const Plan&);

}  // namespace strata
