// What views and tables of tiles share between C++ and shaders.
#ifndef PASSES_LIGHTING_TILED_VIEWS_SHARED_H
#define PASSES_LIGHTING_TILED_VIEWS_SHARED_H
#ifdef __cplusplus
#include "passes/shader_interop.h"
namespace strata::lighting {
#endif

// What view.comp shows.
const uint view_modes = 0u;
const uint view_lists = 1u;
const uint view_bytes = 2u;
const uint view_overflow = 3u;
const uint view_lights = 4u;
const uint view_pixel_tests = 5u;
const uint view_culled = 6u;
const uint view_features = 7u;
const uint view_mode_numbers = 8u;
const uint view_spectrum = 9u;

// What list_table.comp has the masks of.
const uint list_blockers = 0u;
const uint list_portals = 1u;

#ifdef __cplusplus
inline float mode_channel(uint mode, uint modes, int channel);
#endif

/// The red (0), green (1) or blue (2) of the color of a mode, one of `modes` hues.
float mode_channel(uint mode, uint modes, int channel) {
    const float hue = 6.0f * float(mode * 5u % modes) / float(modes);
    const float apart = channel == 0 ? hue - 3.0f : channel == 1 ? hue - 2.0f : hue - 4.0f;
    const float distance = apart < 0.0f ? -apart : apart;
    const float ramp = channel == 0 ? distance - 1.0f : 2.0f - distance;
    return 0.25f + 0.75f * (ramp < 0.0f ? 0.0f : ramp > 1.0f ? 1.0f : ramp);
}

#ifdef __cplusplus
}
#endif
#endif
