#include "passes/gbuffer/surface_at.h"

namespace strata {

ComputePass sample_gbuffer(ComputePass pass, const FrameImages& frame) {
    return pass.samples("gbuffer0", frame.gbuffer0)
        .samples("gbuffer1", frame.gbuffer1)
        .samples("gbuffer2", frame.gbuffer2)
        .fixes("gbuffer_layout", frame.gbuffer_layout);
}

}  // namespace strata
