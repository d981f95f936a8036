// Runs a shader over the samples that are shaded by themselves: those of edge pixels, and the first of plain ones.
#pragma once

#include <functional>
#include <string>

#include "passes/choice_names.h"
#include "passes/edges/routing/routing.shared.h"
#include "passes/graph/graph.h"
#include "passes/settings.h"

namespace strata {

struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::edges {

inline constexpr auto routings = choice_names({{routing_threads, "threads"}, {routing_list, "list"}});
/// The row of a technique that leaves the routing to its user.
inline constexpr Param routing_row = {.name = "routing",
                                      .low = 0,
                                      .high = routing_list,
                                      .fallback = routing_list,
                                      .help =
                                          "assignment of threads to samples; threads: one per sample, also in plain pixels; "
                                          "list: one per pixel, then one per further sample of edges",
                                      .choices = routings};

/// What a shader that includes passes/edges/routing/routed.glsl leaves of every sample.
struct Shaded {
    std::string name;  ///< the shader's
    Image& image;
};

/// Declares the steps. `step` makes one with everything bound but the edges, their list and what is shaded.
void shade_samples(Graph&, const FrameImages&, std::uint32_t routing, const Shaded&, const std::function<ComputeStep()>& step);

}  // namespace strata::edges
