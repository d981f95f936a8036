#include "passes/edges/plain_pixels.h"

#include "passes/frame_images.h"
#include "passes/stage_input.h"

namespace strata {

ComputeStep sample_edges(ComputeStep builder, const FrameImages& frame) {
    return builder.samples("edges", frame.edges).fixes("has_edges", frame.edges ? 1u : 0u);
}

bool is_plain_pixel(const StageInput& input, std::uint32_t x, std::uint32_t y) {
    const auto edges = input.before.find("edges");
    return edges != input.before.end() && edges->second.at(x, y).x == 0;
}

}  // namespace strata
