// Pixels whose first sample stands for all: those that are no edge.
#pragma once

#include "passes/graph/graph.h"

namespace strata {

struct FrameImages;  // passes/frame_images.h
struct StageInput;   // passes/stage_input.h

/// Binds the edges in a step whose shader includes passes/edges/plain_pixels.glsl. Without the edges stage no pixel is plain.
ComputeStep sample_edges(ComputeStep, const FrameImages&);

/// The same of the images that a model starts from.
bool is_plain_pixel(const StageInput&, std::uint32_t x, std::uint32_t y);

}  // namespace strata
