// A sphere in the middle of every cell of a grid that holds light (docs/algorithms/lighting.md 5.8, "Debug draws"): a white diffuse ball that
// the cell's light falls on, as probes are shown, or shaded by what the cell sends. What is nearer hides it. Where grids overlap, the
// cells of the first are shown.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/irradiance.glsl"
#include "passes/indirect/lpv/read_total.glsl"
#include "passes/indirect/lpv/views/views.shared.h"
#include "passes/shaders/camera.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint shown = spheres_received;
layout(push_constant, scalar) uniform Push { SpheresPush push; };
layout(set = 0, binding = 1, scalar) buffer Places { GridPlace places[]; };  // of the grids up to this one
layout(set = 0, binding = 2, rgba32f) uniform image2D picture;
layout(set = 0, binding = 3, r32f) uniform image2D nearest;  // view depth

const float radius = 0.2;  // cells

bool is_of_another(vec3 middle) {
    for (uint i = 0u; i < push.number; ++i)
        if (in_grid(places[i], cell_of(places[i], middle))) return true;
    return false;
}

bool is_empty(LightCell l) { return l.red.x == 0.0 && l.green.x == 0.0 && l.blue.x == 0.0; }

// View depth at which a ray from the eye, 1 deep, enters the sphere of a cell; below 0 where it misses.
float entered_at(vec3 middle, vec3 ray) {
    const float squared = dot(ray, ray), closest = dot(ray, middle) / squared, r = radius * push.grid.cell;
    const vec3 aside = middle - closest * ray;
    const float half_way = r * r - dot(aside, aside);
    return half_way > 0.0 ? closest - sqrt(half_way / squared) : -1.0;
}

float sent(vec4 l, vec3 n) { return max(0.0, y0 * l.x + y1 * dot(l.yzw, n)); }

vec3 shade(LightCell l, vec3 n) {
    if (shown == spheres_received) return irradiance_over_pi(push.grid, l, n);
    return vec3(sent(l.red, n), sent(l.green, n), sent(l.blue, n));
}

void draw(ivec2 at, LightCell l, vec3 n, float depth) {
    imageStore(picture, at, vec4(shade(l, n), 1.0));
    imageStore(nearest, at, vec4(depth));
}

// A sphere lies within its cell: the first that the ray meets, cell by cell, is the nearest.
void follow(ivec2 at, vec3 ray, float end) {
    const vec3 low = push.grid.origin / ray, high = (push.grid.origin + vec3(push.grid.cells) * push.grid.cell) / ray;
    const vec3 entry = min(low, high), leaving = max(low, high);
    const float begin = max(max(entry.x, entry.y), max(entry.z, view.near));
    end = min(end, min(leaving.x, min(leaving.y, leaving.z)));
    if (begin >= end) return;
    ivec3 cell = clamp(cell_of(push.grid, begin * ray), ivec3(0), ivec3(push.grid.cells) - 1);
    const ivec3 turn = ivec3(sign(ray));
    vec3 next = (push.grid.origin + (vec3(cell) + max(vec3(turn), 0.0)) * push.grid.cell) / ray;
    const vec3 width = push.grid.cell / abs(ray);
    for (float entered = begin; entered < end && in_grid(push.grid, cell);) {
        const vec3 middle = middle_of(push.grid, cell);
        const float depth = entered_at(middle, ray);
        const LightCell l = total_light(cell_index(push.grid, cell));
        if (depth > view.near && depth < end && !is_empty(l) && !is_of_another(middle)) {
            draw(at, l, (depth * ray - middle) / (radius * push.grid.cell), depth);
            return;
        }
        const uint axis = next.x <= next.y && next.x <= next.z ? 0u : next.y <= next.z ? 1u : 2u;
        entered = next[axis];
        cell[axis] += turn[axis];
        next[axis] += width[axis];
    }
}

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at == ivec2(0)) places[push.number] = push.grid;
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    vec3 ray = view.to_world * view_ray(vec2(at) + 0.5);
    for (uint i = 0u; i < 3u; ++i)
        if (ray[i] == 0.0) ray[i] = 1e-20;
    follow(at, ray, imageLoad(nearest, at).x);
}
