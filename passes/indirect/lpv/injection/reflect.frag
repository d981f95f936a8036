// Surfaces reflect once more what a grid holds: each piece takes irradiance as a sample of the picture does, and sends its share out as a
// virtual point light (docs/algorithms/lighting.md 5.7, "Multiple bounces"). Surfaces that no light reaches reflect, too. Irradiance is the
// mean over a cell whatever the picture takes: as of a light at the cell's face, surfaces would reflect more than they receive.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/apply/taps.glsl"
#include "passes/indirect/lpv/injection/receiving_cell.glsl"
#include "passes/indirect/lpv/surfels/surfel.glsl"
#include "passes/shaders/finished.glsl"

layout(constant_id = 10) const float bias = 0.5;  // cells along the normal of what is injected

layout(set = 0, binding = 1, scalar) readonly buffer Scale { float fixed_one; };

vec3 irradiance_at(vec3 place, vec3 n) {
    if (depth_inside(push.grid, place) <= 0.0) return vec3(0.0);
    return 3.14159265358979 * received_light(push.grid, seen_light(push.grid, LitPlace(place, n)), first_facing(), n);
}

void reflect_side(Surfel s, vec3 n) {
    const vec3 flux = s.albedo * irradiance_at(s.place, n) * (s.area * push.grid.cell * push.grid.cell);
    if (flux == vec3(0.0)) return;
    const ivec3 cell = receiving_cell(push.grid, s.place, n, bias);
    if (cell.x < 0) return;
    atomicAdd(counters.reflected, 1u);
    add_lobe(cell_index(push.grid, cell), flux, n, fixed_one);
}

void main() {
    const Surfel s = surfel();
    if (!s.exists) return;
    for (uint side = 0u; side < (s.has_two_sides ? 2u : 1u); ++side) reflect_side(s, side == 0u ? s.normal : -s.normal);
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
