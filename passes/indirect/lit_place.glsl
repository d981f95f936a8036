// A place that light is read at, and where it lies in a grid.
#ifndef PASSES_INDIRECT_LIT_PLACE_GLSL
#define PASSES_INDIRECT_LIT_PLACE_GLSL
#include "passes/indirect/grid.glsl"

// One rule for the side of a blocker that a surface is on, for light that is injected, for surfels and for taps: the side of the place this
// many meters along the normal. Both faces of a wall lie on their own sides of a blocker up to 2 cm beside the wall, and direct light, which
// ends 15 mm behind a blocker (docs/algorithms/lighting.md 2.2), lights no face that is on the other side.
const float way_offset = 0.02;

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

// Where ways from the surface begin, view space. The same bits whoever asks: a surface takes and gives light on one side alone.
vec3 way_start(LitPlace lit) {
    precise const vec3 begin = lit.place + lit.normal * way_offset;
    return in_view(begin);
}

#endif
