// Looks shadow maps up: the step, the rows and the pictures that the stage's techniques have in common.
#pragma once

#include <string>
#include <vector>

#include "passes/debug_views.h"
#include "passes/graph/graph.h"
#include "passes/settings.h"
#include "passes/shadows/shadow_map_params.h"

namespace strata {

struct FrameImages;  // passes/frame_images.h

/// At Stage::shadows: draws the maps and remembers in FrameImages::shadow_filter how they are looked up.
void make_shadow_maps(Graph&, FrameImages&, const Settings&);
void make_shadow_maps(Graph&, FrameImages&, const ShadowMapParams&);
/// At a stage behind the G-buffer: `shader` writes FrameImages::visibility. It includes passes/shadows/visibility.glsl.
void filter_shadow_maps(Graph&, FrameImages&, const std::string& shader);
/// The step of such a shader, and the image that it writes.
ComputeStep filter_step(Graph&, const FrameImages&, const std::string& shader, Image& visibility);

/// Fixes the constants of passes/shaders/shadow_filter.glsl in a step whose shader includes it.
ComputeStep& fix_shadow_filter(ComputeStep&, const ShadowFilter&);

/// Rows of the parameters kernel, slope_limit, allocation and caster_mask, of settings that begin with ShadowMapParams.
std::vector<Param> shadow_map_params();
std::vector<Counter> shadow_map_counters();
/// "atlas", a picture, and "map_places", a table: what lies where.
std::vector<DebugView> shadow_map_views();
std::vector<DebugTable> shadow_map_tables();

}  // namespace strata
