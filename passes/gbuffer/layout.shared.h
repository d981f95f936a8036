// FrameImages::gbuffer_layout: which layout the G-buffer has and how readers must read it. C++ and GLSL.
#ifndef PASSES_GBUFFER_LAYOUT_SHARED_H
#define PASSES_GBUFFER_LAYOUT_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::gbuffer {
#endif

const uint layout_index_mask = 0xffu;         // index_in_stage of the technique
const uint layout_decoded = 0xffu;            // no technique: the images are surface_normal, surface_color, surface_material
const uint layout_shaded_at_sample = 0x100u;  // attributes are the sample's and not the pixel center's
const uint layout_reads_depth = 0x200u;       // view depth is the depth buffer's
const uint layout_readers_mask = 0xffffu;     // what readers of surfaces must know
const uint layout_masked_shift = 16u;         // above: the mode of coverage/coverage.shared.h that masked surfaces were drawn by

#ifdef __cplusplus
}
#endif
#endif
