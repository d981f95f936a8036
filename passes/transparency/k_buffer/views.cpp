// What the K-buffer has no place for.
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/settings.h"
#include "passes/transparency/k_buffer/k_buffer.shared.h"
#include "passes/transparency/layers_beyond.h"

namespace strata::transparency {

Image k_buffer_beyond_view(Graph& graph, FrameImages& images, const Settings& settings) {
    return layers_beyond(graph, images, settings.as<KBufferParams>().layers, "k_buffer beyond");
}

}  // namespace strata::transparency
