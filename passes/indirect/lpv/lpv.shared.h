// What light propagation volumes' C++ and shaders share: settings, records, counters.
#ifndef PASSES_INDIRECT_LPV_SHARED_H
#define PASSES_INDIRECT_LPV_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::indirect {
#endif

// Settings, in the order of their choices in lpv.cpp.
const uint propagation_linear = 0u;       // radiance of a face may be negative: the closed form
const uint propagation_clamped = 1u;      // it may not: adds energy (docs/algorithms/lighting.md 5.4)
const uint propagation_energy_true = 2u;  // clamped, and scaled so that a cell sends what it holds
const uint faces_centre = 0u;             // radiance at the middle of a face
const uint faces_exact = 1u;              // integrated over the face
const uint occlusion_recorded = 0u;       // as the capture's volume says
const uint occlusion_none = 1u;
const uint occlusion_axial = 2u;  // of blockers and portals
const uint taps_all = 0u;
const uint taps_visible = 1u;  // those that no blocker hides from the surface

const uint irradiance_face = 0u;  // as of a light half a cell away that sends what the cells do
const uint irradiance_cell = 1u;  // the mean over a cell of what travels through it

// Macro-cells: blocks of cells that share a list of the blockers near them (docs/algorithms/lighting.md 5.8).
const uint macro_side = 4u;  // cells

const uint resolution_full = 0u;
const uint resolution_half = 1u;  // cells are read once per 2 x 2 pixels

struct LpvParams {
    uint iterations;  // 0: as the capture's volume says
    uint propagation;
    uint faces;
    uint occlusion;
    uint taps;
    uint map_size;    // texels a side of reflective shadow maps
    float injection;  // cells along the normal of what is injected
    uint irradiance;
    uint macro_cells;  // whether taps ask only the blockers of their macro-cell
    uint apply_resolution;
    float damping;   // exponent; 0: off
    uint tap_tiles;  // whether tiles near no blocker have a shader that asks none
};

// A grid of cubic cells. Positions are relative to the eye, along the world's axes.
struct GridPlace {
    vec3 origin;  // the corner of cell (0, 0, 0)
    float cell;   // metres a side
    uvec3 cells;
};

// Vertices of a reflective shadow map.
struct MapPush {
    mat4 to_clip;  // of view space
};

// A light's maps and the grid that they are injected into.
struct InjectPush {
    GridPlace grid;
    uint light;
    vec2 slopes;       // of a map's sides; 0 for parallel light
    float texel_area;  // of parallel light, square metres across it
    float fixed_one;   // 1 in the fixed point of the grid's sums: a power of two
    float bias;
};

struct ResolvePush {
    GridPlace grid;
    float fixed_one;
};

struct EnergyPush {
    GridPlace grid;
    uint step;
};

struct ApplyPush {
    GridPlace grid;
    float border;  // metres over which the grid fades at its border
    uint number;   // of the grid, from 1
};

// Groups of a dispatch over a list of tiles of 8 x 8 pixels.
struct TileDispatch {
    uint x, y, z;
    uint count;
};
const uint tile_dispatch_width = 4096u;  // x may be 65535 at most, and 8K has 518400 tiles

// Light of a cell: l0 and l1 per channel, as Y = (Y0, Y1 x, Y1 y, Y1 z) in the world's axes, W.
struct LightCell {
    vec4 red, green, blue;
};

// The same of a step of propagation, with what each channel's clamped faces are multiplied by, so that the cell sends what it
// holds.
struct StepCell {
    LightCell light;
    vec3 share;
};

struct LpvCounters {
    uint injected;
    uint guarded;
    uint dropped;
    uint outside;
    uint hidden_taps;
    uint samples;
    uint unfinished;
    uint samples_near_blockers;
    uint blocker_tests;
    uint full_resolution_pixels;
    uint tiles;
    uint tiles_near_blockers;
};

#ifdef __cplusplus
}
#endif
#endif
