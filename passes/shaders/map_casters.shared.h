// A map that a light draws, for who finds its casters.
#ifndef PASSES_SHADERS_MAP_CASTERS_SHARED_H
#define PASSES_SHADERS_MAP_CASTERS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

struct MapCastersPush {
    mat4 to_clip;
    vec2 low, high;  // of the part of the map that is drawn, x and y from -1 to 1
    vec3 light;      // its place, and where it ends, meters; range 0: parallel light
    float range;
    uint first, count;  // of the casters among all commands
    uint to;            // the first of the map's commands
};

#ifdef __cplusplus
}
#endif
#endif
