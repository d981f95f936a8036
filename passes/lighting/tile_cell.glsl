// Tiles of the screen as cells of view space, and which lights reach them (docs/algorithms/lighting.md 1.3 and 1.4). Every test
// is conservative: it may keep a light that misses and never drops one that adds anything but exactly 0 to a point of the cell.
#ifndef PASSES_LIGHTING_TILE_CELL_GLSL
#define PASSES_LIGHTING_TILE_CELL_GLSL
#include "passes/lighting/cell.glsl"
#include "passes/shaders/camera.glsl"
#include "passes/shaders/light_types.glsl"

// Meters. Squares of it are finite, and so are sums of them.
const float farthest_cell = 1e18;
// What a position may be off, and a distance from it, relative to the largest number in its computation: 64 ulps of a float.
const float relative_slack = 4e-6;
// What a cosine of two unit vectors may be off; a cone is widened by it, which is most where it is narrow.
const float cosine_slack = 1e-6;
// Axes of a capture are unit and perpendicular within 2e-3 (unit_tolerance of capture_format/inspection.h): bounds that need
// more reach so much farther.
const float axis_slack = 1.01;

// Of tile_size x tile_size pixels, cut off at the picture's edge, from z_near to z_far (meters of view depth; equal is legal).
Cell tile_cell(uvec2 tile, uint tile_size, float z_near, float z_far) {
    const uvec2 first = tile * tile_size, last = min(first + tile_size, view.extent);
    const vec2 upper_left = view_ray(vec2(first)).xy, lower_right = view_ray(vec2(last)).xy;
    Cell cell;
    cell.z_near = min(z_near, farthest_cell);
    cell.z_far = min(z_far, farthest_cell);
    for (uint i = 0u; i < 8u; ++i) {
        const float x = (i & 1u) != 0u ? lower_right.x : upper_left.x, y = (i & 2u) != 0u ? lower_right.y : upper_left.y;
        cell.corners[i] = vec3(x, y, 1.0) * ((i & 4u) != 0u ? cell.z_far : cell.z_near);
    }
    cell.planes[0] = vec4(vec3(1.0, 0.0, -upper_left.x) / sqrt(1.0 + upper_left.x * upper_left.x), 0.0);
    cell.planes[1] = vec4(vec3(-1.0, 0.0, lower_right.x) / sqrt(1.0 + lower_right.x * lower_right.x), 0.0);
    cell.planes[2] = vec4(vec3(0.0, 1.0, -lower_right.y) / sqrt(1.0 + lower_right.y * lower_right.y), 0.0);
    cell.planes[3] = vec4(vec3(0.0, -1.0, upper_left.y) / sqrt(1.0 + upper_left.y * upper_left.y), 0.0);
    cell.planes[4] = vec4(0.0, 0.0, 1.0, -cell.z_near);
    cell.planes[5] = vec4(0.0, 0.0, -1.0, cell.z_far);
    return cell;
}

// Meters within which "outside" proves nothing.
float cell_slack(LightRecord light, Cell cell) {
    const vec3 corner = max(abs(cell.corners[4]), abs(cell.corners[7]));
    const float reach = light.range * (1.0 + light.tan_half.x + light.tan_half.y);
    return relative_slack * (length(light.position) + corner.x + corner.y + corner.z + reach);
}

// Planes alone keep what is off a corner: the box of the cell drops it.
bool sphere_touches(vec3 center, float radius, Cell cell) {
    for (uint i = 0u; i < 6u; ++i)
        if (dot(cell.planes[i].xyz, center) + cell.planes[i].w < -radius) return false;
    vec3 low = cell.corners[0], high = cell.corners[0];
    for (uint i = 1u; i < 8u; ++i) {
        low = min(low, cell.corners[i]);
        high = max(high, cell.corners[i]);
    }
    const vec3 off = center - clamp(center, low, high);
    return dot(off, off) <= radius * radius;
}

// The cone of half angle below 90 degrees against a sphere: its distance from the side, the base and the apex.
bool cone_touches(vec3 axis, float cosine, vec3 from_apex, float radius, float range) {
    const float along = dot(from_apex, axis);
    const float aside = sqrt(max(0.0, dot(from_apex, from_apex) - along * along));
    const float from_side = cosine * aside - sqrt(max(0.0, 1.0 - cosine * cosine)) * along;
    return from_side <= radius && along <= range + radius && along >= -radius;
}

bool round_spot_touches(LightRecord light, Cell cell, float slack) {
    const float scale = inversesqrt(dot(light.direction, light.direction));
    const float cosine = light.cos_outer * scale - cosine_slack;
    if (cosine <= 0.0) return true;
    const vec3 axis = light.direction * scale;
    const vec2 around = sphere_around_cone(cosine, light.range);
    if (!sphere_touches(light.position + axis * around.x, around.y + slack, cell)) return false;
    const vec3 center = 0.5 * (0.5 * (cell.corners[0] + cell.corners[3]) + 0.5 * (cell.corners[4] + cell.corners[7]));
    float farthest = 0.0;
    for (uint i = 0u; i < 8u; ++i) farthest = max(farthest, distance(center, cell.corners[i]));
    return cone_touches(axis, cosine, center - light.position, farthest + slack, light.range);
}

// Least and largest dot(plane.xyz, p) + plane.w of the cell.
vec2 reach_along(vec4 plane, Cell cell) {
    vec2 reach = vec2(farthest_cell, -farthest_cell) * farthest_cell;
    for (uint i = 0u; i < 8u; ++i) {
        const float along = dot(plane.xyz, cell.corners[i]) + plane.w;
        reach = vec2(min(reach.x, along), max(reach.y, along));
    }
    return reach;
}

// Whether the plane through the point has the whole cell on its outer side, by more than the slack.
bool is_beyond(vec3 normal, vec3 point, Cell cell, float slack) {
    return reach_along(vec4(normal, -dot(normal, point)), cell).y < -slack;
}

// The pyramid of a square spot: 4 sides, apex and base against the corners, its 5 vertices against the cell's planes.
bool square_spot_touches(LightRecord light, Cell cell, float slack) {
    const vec3 axis_v = cross(light.direction, light.axis_u);
    const vec3 wide = light.tan_half.x * light.axis_u, high = light.tan_half.y * axis_v;
    for (float side = -1.0; side <= 1.0; side += 2.0) {
        const vec3 u = normalize(light.direction * light.tan_half.x + side * light.axis_u);
        const vec3 v = normalize(light.direction * light.tan_half.y + side * axis_v);
        if (is_beyond(u, light.position, cell, slack) || is_beyond(v, light.position, cell, slack)) return false;
    }
    if (is_beyond(light.direction, light.position, cell, slack)) return false;
    for (uint i = 0u; i < 6u; ++i) {
        const vec3 normal = cell.planes[i].xyz;
        const float apex = dot(normal, light.position) + cell.planes[i].w;
        const float base = dot(normal, light.direction) + abs(dot(normal, wide)) + abs(dot(normal, high));
        if (max(apex, apex + axis_slack * light.range * base) < -slack) return false;
    }
    return true;
}

// A rectangle lights one side of its plane, up to its range: half a box against the corners, and its corners against
// the cell's planes.
bool half_box_touches(LightRecord light, Cell cell, float slack) {
    const vec3 axis_v = cross(light.direction, light.axis_u);
    const vec2 along_u = reach_along(vec4(light.axis_u, -dot(light.axis_u, light.position)), cell);
    const vec2 along_v = reach_along(vec4(axis_v, -dot(axis_v, light.position)), cell);
    const vec2 ahead = reach_along(vec4(light.direction, -dot(light.direction, light.position)), cell);
    const float least = max(max(along_u.x, along_v.x), ahead.x), most = min(along_u.y, along_v.y);
    const float range = axis_slack * light.range;
    if (least > range + slack || most < -range - slack || ahead.y < -slack) return false;
    for (uint i = 0u; i < 6u; ++i) {
        const vec3 normal = cell.planes[i].xyz;
        const float aside = abs(dot(normal, light.axis_u)) + abs(dot(normal, axis_v)) + max(0.0, dot(normal, light.direction));
        if (dot(normal, light.position) + cell.planes[i].w + range * aside < -slack) return false;
    }
    return true;
}

// What the light's clip planes do in the cell: one has all of it on its dark side ...
bool is_clipped(LightRecord light, Cell cell, float slack) {
    for (uint i = 0u; i < light.clips; ++i) {
        const ClipPlaneRecord plane = clip_planes[light.first_clip + i];
        if (reach_along(vec4(plane.normal, plane.distance), cell).y < -slack - relative_slack * abs(plane.distance)) return true;
    }
    return false;
}

// ... or some of it: else no point of the cell needs the test.
bool is_straddled(LightRecord light, Cell cell) {
    const float slack = cell_slack(light, cell);
    for (uint i = 0u; i < light.clips; ++i) {
        const ClipPlaneRecord plane = clip_planes[light.first_clip + i];
        if (reach_along(vec4(plane.normal, plane.distance), cell).x < slack + relative_slack * abs(plane.distance)) return true;
    }
    return false;
}

bool light_touches(LightRecord light, Cell cell) {
    const float slack = cell_slack(light, cell);
    if (!light_has_range(light.type)) return !is_clipped(light, cell, slack);
    if (!sphere_touches(light.position, light.range + slack, cell)) return false;
    if (light_has_round_cone(light.type) && !round_spot_touches(light, cell, slack)) return false;
    if (light_has_square_cone(light.type) && !square_spot_touches(light, cell, slack)) return false;
    if (light.type == light_rectangle && !half_box_touches(light, cell, slack)) return false;
    // One-sided, too, but its axis_u may be anything.
    if (light.type == light_disc && is_beyond(light.direction, light.position, cell, slack)) return false;
    return !is_clipped(light, cell, slack);
}

#endif
