// What all G-buffer techniques declare alike: the raster step over the visible opaque draws into depth, targets and emission.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "passes/graph/format.h"
#include "passes/settings.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::gbuffer {

/// Where readers take view depth from.
enum class DepthFrom : std::uint32_t { targets, depth_buffer };

/// What a technique's shaders write: "<technique>/fill.frag" at the pixel's center, "<technique>/fill_sample.frag" at the sample.
struct Layout {
    std::string_view technique;
    std::span<const Format> targets;  ///< of gbuffer0, gbuffer1 and, if there is one, gbuffer2
    DepthFrom depth = DepthFrom::targets;
};

/// Rows of FillParams: parameters of every G-buffer technique.
std::vector<Param> fill_params();

/// Draws frame.opaque into the layout's targets and emission (rgba16f), with depth writes, into frame.depth where an earlier
/// stage has drawn into it what hides them, and leaves their own depth there; spreads samples into layers, tells readers the
/// layout and declares the decoded surfaces. The settings hold the rows of fill_params().
void add_fill(Graph&, FrameImages&, const Layout&, const Settings&);

}  // namespace strata::gbuffer
