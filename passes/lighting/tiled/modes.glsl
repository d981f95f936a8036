// Which shading mode can shade which tile.
#ifndef PASSES_LIGHTING_TILED_MODES_GLSL
#define PASSES_LIGHTING_TILED_MODES_GLSL

#include "passes/shaders/light_features.shared.h"

bool serves(uint mode, uint spectrum) { return (spectrum & ~mode & every_light_feature) == 0u; }

#endif
