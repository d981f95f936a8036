// The fixed-function state of a draw or full-screen step, from its attachments and work.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "passes/graph/plan.h"

namespace strata {

struct ColorTarget {
    vk::Format format = vk::Format::eUndefined;
    Blend blend = Blend::none;
    friend bool operator==(const ColorTarget&, const ColorTarget&) = default;
};

/// What tells two raster pipelines with the same shaders apart. Plain numbers only: its bytes are a key.
struct RasterState {
    std::vector<ColorTarget> colors;
    bool keeps_side_effects = false;  ///< see raster_state()
    DepthUse depth = DepthUse::none;
    std::uint32_t samples = 1;
    Cull cull = Cull::none;
    bool alpha_to_coverage = false;
};

/// llvmpipe (22.3 and 25.0) drops what a fragment shader writes to buffers and images where later opaque fragments cover a whole
/// 64 x 64 tile of a single color attachment without depth. Blending with factors one and zero prevents it.
RasterState raster_state(const PlannedStep&, const std::vector<ImageRecord>& images, bool on_llvmpipe);

/// The pipeline's blend state of a color attachment.
vk::PipelineColorBlendAttachmentState blend_state(const RasterState&, Blend);

bool is_depth(const Attachment&);

}  // namespace strata
