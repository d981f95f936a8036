// Types of lights as LightRecord::type has them, and what is true of them: LightType and the table of
// capture_format/light_types.h.
#ifndef PASSES_SHADERS_LIGHT_TYPES_SHARED_H
#define PASSES_SHADERS_LIGHT_TYPES_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
inline bool light_has_range(uint type);
inline bool light_has_round_cone(uint type);
inline bool light_has_square_cone(uint type);
inline bool light_is_spot(uint type);
inline bool light_has_area(uint type);
inline bool light_is_flat(uint type);
#endif

const uint light_omni = 0u;
const uint light_round_spot = 1u;
const uint light_square_spot = 2u;
const uint light_tube = 3u;
const uint light_sphere = 4u;
const uint light_disc = 5u;
const uint light_rectangle = 6u;
const uint light_directional = 7u;

const uint window_squared_quartic = 0u;
const uint window_quartic = 1u;

bool light_has_range(uint type) { return type != light_directional; }
bool light_has_round_cone(uint type) { return type == light_round_spot; }
bool light_has_square_cone(uint type) { return type == light_square_spot; }
bool light_is_spot(uint type) { return type == light_round_spot || type == light_square_spot; }
bool light_has_area(uint type) { return type >= light_tube && type <= light_rectangle; }
bool light_is_flat(uint type) { return type == light_disc || type == light_rectangle; }

#ifdef __cplusplus
}
#endif
#endif
