// A place that light is read at, and where it lies in a grid.
#ifndef PASSES_INDIRECT_LIT_PLACE_GLSL
#define PASSES_INDIRECT_LIT_PLACE_GLSL
#include "passes/indirect/grid.glsl"

// Meters off a surface from which taps are asked about.
const float tap_start = 0.02;

struct LitPlace {
    vec3 place, normal;
};

// How far a place is from the grid's border, meters; below 0 outside.
float depth_inside(GridPlace grid, vec3 place) {
    const vec3 least = min(place - grid.origin, grid.origin + vec3(grid.cells) * grid.cell - place);
    return min(least.x, min(least.y, least.z));
}

// Some cells before the surface, in cells from the grid's origin.
vec3 place_before(GridPlace grid, LitPlace lit, float cells) { return (lit.place - grid.origin) / grid.cell + cells * lit.normal; }

// Where ways from the surface begin, view space.
vec3 way_start(LitPlace lit) { return in_view(lit.place + lit.normal * tap_start); }

#endif
