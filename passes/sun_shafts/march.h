// What techniques that march rays through the sun's shadow maps have in common: their parameters, steps and views.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passes/debug_views.h"
#include "passes/settings.h"
#include "passes/shadows/bounds/nodes.h"
#include "passes/sun_shafts/march.shared.h"

namespace strata::sun_shafts {

/// Whether the frame's air scatters sunlight towards the eye.
bool has_shafts(const FrameImages&);
/// Whether the sun's shadows are in FrameImages::shadow_maps. Without, every step is lit.
bool has_sun_maps(const FrameImages&);

/// Bounds of the sun's maps for a shader that includes passes/shadows/bounds/query.glsl. No image: the sun casts no shadow.
struct SunBounds {
    Image image;
    BoundsSettings settings;
    BoundsNodes nodes;          ///< where segments are asked about
    std::uint32_t segment = 1;  ///< steps that are asked about at once; 1: each alone
};

/// A shader that includes march.glsl.
struct MarchShader {
    std::string name;
    std::optional<SunBounds> bounds = {};
};

/// Makes FrameImages::shafts.
void march_shafts(Graph&, FrameImages&, const Settings&, const MarchShader&);
/// An rgba16f image: the share of the steps of each pixel's first ray that bounds decide.
Image show_decided(Graph&, FrameImages&, const Settings&, const MarchShader&);

std::vector<Param> march_params();
std::vector<Counter> march_counters();
std::vector<DebugView> march_views();
/// Technique::approximates: the truth of the phase function.
std::string_view truth_of_phase(const Settings&);

}  // namespace strata::sun_shafts
