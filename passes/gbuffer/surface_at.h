// What a shader that decodes the G-buffer is given.
#pragma once

#include "passes/frame_images.h"

namespace strata {

/// Binds the G-buffer and fixes its layout in a step whose shader includes passes/gbuffer/surface_at.glsl.
ComputePass sample_gbuffer(ComputePass, const FrameImages&);

}  // namespace strata
