// The cells of a grid. Positions are relative to the eye, along the world's axes.
#ifndef PASSES_INDIRECT_GRID_GLSL
#define PASSES_INDIRECT_GRID_GLSL
#include "passes/indirect/harmonics.glsl"
#include "passes/indirect/light_grid.shared.h"
#include "passes/shaders/scene.glsl"

bool in_grid(GridPlace grid, ivec3 cell) { return all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(grid.cells))); }

uint cell_index(GridPlace grid, ivec3 cell) { return uint((cell.z * int(grid.cells.y) + cell.y) * int(grid.cells.x) + cell.x); }

ivec3 cell_of(GridPlace grid, vec3 place) { return ivec3(floor((place - grid.origin) / grid.cell)); }

// The same bits wherever a cell's middle is asked for: on a blocker's plane it lies on one side, whoever asks.
vec3 middle_of(GridPlace grid, ivec3 cell) {
    precise const vec3 middle = grid.origin + (vec3(cell) + 0.5) * grid.cell;
    return middle;
}

vec3 in_view(vec3 place) {
    precise const vec3 p = place.x * vec3(view.to_world[0].x, view.to_world[1].x, view.to_world[2].x) +
                           place.y * vec3(view.to_world[0].y, view.to_world[1].y, view.to_world[2].y) +
                           place.z * vec3(view.to_world[0].z, view.to_world[1].z, view.to_world[2].z);
    return p;
}

#endif
