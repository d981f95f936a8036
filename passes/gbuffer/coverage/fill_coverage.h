// How alpha of masked surfaces becomes covered samples, as a parameter of all G-buffer techniques.
#pragma once

#include <vector>

#include "passes/claims.h"
#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/graph/step.h"
#include "passes/settings.h"

namespace strata {

class DrawStep;      // passes/graph/graph.h
class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::gbuffer {

/// The row of FillParams::masked.
Param masked_param();
/// Times of its modes against each other.
std::vector<TimeRatio> coverage_ratios();

enum class ShadingRate { pixel, sample };

/// What the fill of a frame is given: the constants of coverage.glsl and the image it reads.
struct Coverage {
    uint mode = masked_clip;
    std::uint32_t samples = 1;
    ShadingRate rate = ShadingRate::pixel;
    Image scales = {};
};

/// The mode of these settings, or `clip` where it does the same as that in this frame: without masked surfaces, and of modes
/// that differ in their samples alone at one sample per pixel or where every sample is shaded. Declares the steps that write the
/// scales of mips where they are read.
Coverage declare_coverage(Graph&, const FrameImages&, uint mode, ShadingRate);
/// The same for a step that draws masked surfaces at one sample per texel of another image than the frame's, such as a shadow
/// map.
Coverage declare_coverage_of_texels(Graph&, const FrameImages&, uint mode);
/// Gives it to a step whose fragment shader includes coverage.glsl.
void add_coverage(DrawStep&, const Coverage&);

/// The first of two passes of masked_hardware: draws frame.opaque into the depth alone, by the device's alpha to coverage. The
/// fill then draws at equal depth.
void draw_depth_by_alpha(Graph&, FrameImages&);

/// What the fill of a drawn G-buffer was given, for a step that draws the same surfaces once per pixel: the mode out of
/// FrameImages::gbuffer_layout. Declares what declare_coverage() declares.
Coverage declare_coverage_again(Graph&, const FrameImages&);

}  // namespace strata::gbuffer
