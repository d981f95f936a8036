// Casters that a part of a light's map sees, by their bounding spheres: never fewer. Whoever includes this includes
// passes/culling/draw_command.shared.h before.
#ifndef PASSES_SHADERS_MAP_CASTERS_GLSL
#define PASSES_SHADERS_MAP_CASTERS_GLSL
#include "passes/shaders/map_casters.shared.h"
#include "passes/shaders/scene.glsl"

// Whether a sphere reaches below the plane dot(plane, (p, 1)) = 0; one that is no number does.
bool reaches_below(vec4 plane, vec3 center, float radius) { return !(dot(plane.xyz, center) + plane.w > radius * length(plane.xyz)); }

bool is_seen(MapCastersPush map, DrawRecord draw) {
    const vec3 center = draw.bound_center;
    const float away = distance(center, map.light);
    const float radius = draw.bound_radius + bound_slack * (1.0 + length(center) + away + draw.bound_radius);
    if (map.range > 0.0 && away - radius > map.range) return false;
    const mat4 rows = transpose(map.to_clip);
    const vec4 x = rows[0], y = rows[1], w = rows[3];
    return reaches_below(-w, center, radius) && reaches_below(x - map.high.x * w, center, radius) &&
           reaches_below(map.low.x * w - x, center, radius) && reaches_below(y - map.high.y * w, center, radius) &&
           reaches_below(map.low.y * w - y, center, radius);
}
#endif
