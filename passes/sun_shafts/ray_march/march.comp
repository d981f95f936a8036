// Every step asks the shadow map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sun_shafts/march.glsl"

bool is_decided(MapRay map, vec3 at, inout Tally tally, out float lit) {
    lit = 1.0;
    return false;
}

bool are_decided(MapRay map, vec3 first, vec3 last, inout Tally tally, out float lit) {
    lit = 1.0;
    return false;
}
