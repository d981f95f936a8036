// Where the A-buffer overflows.
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/settings.h"
#include "passes/transparency/a_buffer/a_buffer_params.h"
#include "passes/transparency/layers_beyond.h"

namespace strata::transparency {

Image a_buffer_overflow_view(Graph& graph, FrameImages& images, const Settings& settings) {
    return layers_beyond(graph, images, settings.as<ABufferParams>().layers, "a_buffer overflow");
}

}  // namespace strata::transparency
