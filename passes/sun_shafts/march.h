// What techniques that march rays through the sun's shadow maps have in common: their parameters, steps and views.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passes/sun_shafts/march.shared.h"
#include "passes/technique.h"

namespace strata::sun_shafts {

/// Whether the frame's air scatters sunlight towards the eye.
bool has_shafts(const FrameImages&);
/// Whether the sun's shadows are in FrameImages::shadow_maps. Without, every step is lit.
bool has_sun_maps(const FrameImages&);

/// Makes FrameImages::shafts. `shader` includes march.glsl; `bounds` is bound as "bounds" if there are any.
void march_shafts(Graph&, FrameImages&, const Settings&, const std::string& shader, const Image& bounds = {});

std::vector<Param> march_params();
std::vector<DebugView> march_views();
/// Technique::approximates: the truth of the phase function.
std::string_view truth_of_phase(const Settings&);

}  // namespace strata::sun_shafts
