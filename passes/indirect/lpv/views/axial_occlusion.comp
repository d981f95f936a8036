// What blockers take of the light through the six faces of the cell that a surface lies in: red across x, green across y, blue across z,
// of two faces the more closed one. A wall along x is red, a floor green, an open door black.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/lpv/occlusion/links.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, rgba32f) uniform image2D picture;

const float off_surface = 0.02;  // meters: of a surface on the border of two cells the one before it

// Light does not come in over the grid's border: nothing is taken of it there.
float occluded(ivec3 lower, uint axis) {
    ivec3 upper = lower;
    ++upper[axis];
    return in_grid(grid, lower) && in_grid(grid, upper) ? 1.0 - transmitted(grid, lower, axis) : 0.0;
}

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    const Surface s = surface_at(ivec3(at, 0));
    if (!s.exists) return;
    const MaterialPoint m = lit_point(s, uvec2(at));
    const vec3 n = facing_normal(m.lighting_model, m.normal, m.position);
    const ivec3 cell = cell_of(grid, view.to_world * (m.position + off_surface * n));
    if (!in_grid(grid, cell)) return;
    vec3 shares = vec3(0.0);
    for (uint axis = 0u; axis < 3u; ++axis) {
        ivec3 lower = cell;
        --lower[axis];
        shares[axis] = max(occluded(lower, axis), occluded(cell, axis));
    }
    imageStore(picture, at, vec4(shares, 1.0));
}
