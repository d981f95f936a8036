// What shaders that read the G-buffer are given.
#pragma once

#include "passes/graph/graph.h"

namespace strata {

struct FrameImages;  // passes/frame_images.h

/// Binds the words of the G-buffer in a step whose shader includes passes/gbuffer/words.glsl.
ComputeStep sample_words(ComputeStep, const FrameImages&);

/// The same for a shader that includes passes/gbuffer/surface_at.glsl and so decodes them; fixes their layout.
ComputeStep sample_gbuffer(ComputeStep, const FrameImages&);

}  // namespace strata
