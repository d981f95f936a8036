// Draws at one sample per texel and at the frame's extent divided by 1, 2, 4 or 8: where moments, wavelets and voxels gather the
// optical depths of all fragments, and where low-resolution draws go. Depth is tested against the farthest opaque surface of a
// texel's block, or what is visible beside an edge would be missing.
#pragma once

#include "capture_format/frame/draw.h"
#include "passes/frame_images.h"
#include "passes/settings.h"

namespace strata::transparency {

/// The frame's images with extent, samples and opaque depth of the prepass: what draw_fragments() draws a prepass with. At
/// divisor 1 and one sample they are the frame's own, and nothing is declared.
FrameImages prepass_images(Graph&, const FrameImages&, std::uint32_t divisor);

/// Texels of the prepass: each axis rounded up.
Extent prepass_extent(Extent, std::uint32_t divisor);

/// The row of the `resolution` parameter: a choice by name; divisor_of() is what it stands for.
extern const Param resolution_row;
std::uint32_t divisor_of(std::uint32_t resolution);
/// How a draw reads a prepass through low_resolution/filtered.glsl.
struct PrepassRead {
    Filter filter;
    std::uint32_t in_shader;  ///< fixed as `filters_in_shader`: 1 where the device cannot filter the prepass's formats
};
/// Draws of the frame, or of half its extent, read a prepass at `resolution`: nearest where texel lies on texel.
PrepassRead prepass_read(const FrameImages&, std::uint32_t resolution, Resolution drawn_at);

/// The row of the `channels` parameter: automatic, mono, rgb. channel_count() is how many functions a texel has: 1 or 3.
extern const Param channels_row;
std::uint32_t channel_count(std::uint32_t channels, const Features&);

}  // namespace strata::transparency
