#include "passes/gbuffer/surface_at.h"

#include "passes/frame_images.h"
#include "passes/gbuffer/layout.shared.h"

namespace strata {

ComputeStep sample_words(ComputeStep builder, const FrameImages& frame) {
    return builder.samples("gbuffer0", frame.gbuffer0).samples("gbuffer1", frame.gbuffer1).samples("gbuffer2", frame.gbuffer2);
}

ComputeStep sample_gbuffer(ComputeStep builder, const FrameImages& frame) {
    const bool reads_depth = (frame.gbuffer_layout & gbuffer::layout_reads_depth) != 0;
    return sample_words(builder, frame)
        .samples("gbuffer_depth", reads_depth ? frame.depth_layers : Image{})
        .fixes("gbuffer_layout", frame.gbuffer_layout & gbuffer::layout_readers_mask);
}

}  // namespace strata
