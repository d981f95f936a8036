// A plan for people: text to read and diff, and Graphviz to draw.
#pragma once

#include <cstdint>
#include <string>

#include "passes/graph/plan.h"

namespace strata {

/// Steps in order with their barriers and memory, then what was culled and why.
std::string describe(const Plan&);
/// The same as a Graphviz digraph of steps and images.
std::string describe_dot(const Plan&);

/// "64 x 36 rgba16f, 4 samples".
std::string describe(const Shape&);
/// "color: color_written -> sampled", and whose memory the image takes over.
std::string describe(const Plan&, const Barrier&);
/// "312 B", "1.2 MiB".
std::string size_text(std::uint64_t bytes);

}  // namespace strata
