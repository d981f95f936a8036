// What depth peeling does not get to.
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/settings.h"
#include "passes/transparency/depth_peeling/depth_peeling_params.h"
#include "passes/transparency/layers_beyond.h"

namespace strata::transparency {

Image depth_peeling_beyond_view(Graph& graph, FrameImages& images, const Settings& settings) {
    return layers_beyond(graph, images, settings.as<DepthPeelingParams>().passes, "depth_peeling beyond");
}

}  // namespace strata::transparency
