// What light propagation volumes' C++ and shaders share: settings, records, counters.
#ifndef PASSES_INDIRECT_LPV_SHARED_H
#define PASSES_INDIRECT_LPV_SHARED_H
#include "passes/indirect/light_grid.shared.h"
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
const uint occlusion_fuzzy = 3u;  // of surfaces
const uint occlusion_both = 4u;
const uint taps_all = 0u;
const uint taps_visible = 1u;  // those that no blocker hides from the surface

// Light that comes back to surfaces that face like its source.
const uint self_kept = 0u;
const uint self_uninjected = 1u;  // cells do not show what is injected into them
const uint self_facing = 2u;      // cells know which way sources face (channels.glsl)
const uint color_channels = 3u;
const uint facing_channels = 6u;

// Direction of the light that a face of a cell takes.
const uint lobes_face = 0u;  // across the face
const uint lobes_flow = 1u;  // away from the middle of the cell that sends it

const uint resolution_full = 0u;
const uint resolution_half = 1u;  // cells are read once per 2 x 2 pixels
const uint relight_always = 0u;   // in every frame
const uint relight_changed = 1u;  // where something that determines the light differs from the last time (kept/)

const uint cells_half = 0u;  // as wide as recorded, times a power of two
const uint cells_recorded = 1u;
const uint cells_double = 2u;

const uint storage_float = 0u;  // cells hold 32-bit floats, W
const uint storage_half = 1u;   // half floats in units of a power of two W (stored_cells.glsl)

// Vertices of a reflective shadow map.
struct MapPush {
    mat4 to_clip;    // of view space
    vec3 low, high;  // corners of a box that holds all from which a grid takes light, relative to the eye, along the world's axes
};

// Texels by which those of a map of parallel light lie beside borders of cells, along the two axes after the one that the map
// faces: scenes like to have their edges there, and rounding would decide what a texel sees.
const float map_shift_u = 0.2155f;
const float map_shift_v = 0.167f;

const uint injecting_group = 64u;  // threads of a group over the texels of a light's maps

// A light's maps and the grid that they are injected into.
struct InjectPush {
    GridPlace grid;
    uint light;
    vec2 slopes;       // of a map's sides; 0 for parallel light
    float texel_area;  // of parallel light, square meters across it
    float fixed_one;   // 1 in the fixed point of the grid's sums: a power of two
    float bias;
};

// Surfels (surfels/surfel.glsl): pieces of surfaces along a cell's side; cells around a grid whose surfaces count; texels by
// which their middles lie beside those of cells' quarters, where walls like to begin and end.
const uint surfels_a_side = 4u;
const uint surfel_margin = 1u;
// A device moves vertices by up to 1/512 of a texel: in cells of .4, .5 or 1 m no line through texels' middles lies as near to
// whole centimeters, where scenes have their edges. (With .139 two lines of four lay 1/1000 of a texel beside them: rows of
// texels of whole walls were covered on the device alone, and light differed by 4e-3.)
const float surfel_shift_u = 0.2155f;
const float surfel_shift_v = 0.167f;  // another one, because squares' diagonals lie where the two are equal

struct SurfelPush {
    GridPlace grid;
    uint axis;
};

// 1 in the fixed point of what surfaces cover of a cell's face: up to 2048 faces. Cells by which the corners of the geometry
// volume lie lower, so that a wall in the very middle of cells belongs to the corners on one side of it whatever rounding does.
const float cover_one = 1048576.0f;
const float cover_shift = 1e-3f;

// Fixed-point sums of l0 stay below this; those of l1 then below 2^31.
const int most_of_a_sum = 1 << 30;

struct ResolvePush {
    GridPlace grid;
    float fixed_one;
};

struct EnergyPush {
    GridPlace grid;
    uint step;
};

// W: held, absorbed, escaped, as a float and what it was rounded by.
struct EnergySum {
    vec3 sum, rest;
};

struct ApplyPush {
    GridPlace grid;
    float border;  // meters over which the grid fades at its border
    uint number;   // of the grid, from 1
};

// Groups of a dispatch over a list of tiles of 8 x 8 pixels.
struct TileDispatch {
    uint x, y, z;
    uint count;
};
const uint tile_dispatch_width = 4096u;  // x may be 65535 at most, and 8K has 518400 tiles

// With storage_half a unit is the power of two at which the brightest l0 that is injected into a grid lies between 2^7 and 2^8 in
// what is summed over steps, and between 2^12 and 2^13 in what one step holds: sums grow with the steps, steps do not. The sums'
// unit stands in the first words of their buffer.
const int total_exponent = 7;
const int step_exponent = 12;
const uint unit_words = 4u;

// What the image volume_light is given of a grid.
struct HandOnPush {
    GridPlace grid;
    float border;
    uint asks_taps;
    uint irradiance;
    uint number;  // of the grid, and of grids
    uint count;
    uint first_cell;  // the record of its first cell
    uint macro_row;   // 0: none
    float reading;    // cells before a surface
};
struct HandOnMacroPush {
    GridPlace grid;
    uint row;
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
    uint cells_relit;
    uint faces_rebuilt;
    uint overflowed;
    uint reflected;
    uint full_resolution_pixels;
    uint tiles;
    uint tiles_near_blockers;
    uint map_casters;
};

// Steps of a grid whose groups kept/decide.comp counts, with relight_changed. Steps of propagation follow.
const uint gate_cells = 0u;     // clears the sums and resolves them
const uint gate_faces = 1u;     // finds the links
const uint gate_barriers = 2u;  // notes what they were found with
const uint gate_show = 3u;      // shows what was lit in slices
const uint gate_first_step = 4u;

#ifdef __cplusplus
}
#endif
#endif
