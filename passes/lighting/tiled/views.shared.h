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
}
#endif
#endif
