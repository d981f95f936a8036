// How far what a technique shows has moved since the frame before, as motion vectors of a frame are
// (docs/algorithms/transparency.md 6.13): fragments weighted as their color is, over what is opaque behind them.
#pragma once

#include "passes/transparency/functions/draw.h"

namespace strata::transparency {

/// Of the first sample: xy pixels, right and down, w what the background is seen with. sums: made with Offsets::motion.
Image motion_view(Graph&, const FrameImages&, const FunctionSums&);

/// The row of that view.
DebugView motion_row(Image (*declare)(Graph&, FrameImages&, const Settings&));
template <SumsFunction sums>
DebugView motion_row() {
    return motion_row([](Graph& graph, FrameImages& images, const Settings& settings) {
        return motion_view(graph, images, sums(graph, images, settings, Offsets::motion));
    });
}

}  // namespace strata::transparency
