// What shaders that read the G-buffer are given.
#pragma once

#include "passes/frame_images.h"

namespace strata {

/// Binds the words of the G-buffer in a step whose shader includes passes/gbuffer/words.glsl.
ComputePass sample_words(ComputePass, const FrameImages&);

/// The same for a shader that includes passes/gbuffer/surface_at.glsl and so decodes them; fixes their layout.
ComputePass sample_gbuffer(ComputePass, const FrameImages&);

}  // namespace strata
