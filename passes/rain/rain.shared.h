// Sizes of what rain makes on surfaces: rings, streams and puddles. C++ and GLSL. Cells have sides of a power of two meters, up
// to 4 m, so that the world's position can be told in whole cells and a rest.
#ifndef PASSES_RAIN_SHARED_H
#define PASSES_RAIN_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::rain {
#endif

// wet_form
const uint form_porosity = 0u;
const uint form_xray = 1u;

// A drop falls into every cell of 25 cm once a turn. Its ring widens to ring_radius while the turn lasts and is a wave of
// 2 ring_width from end to end: together at most half a cell, so that only the 2 x 2 nearest cells reach a point.
const float ring_cells = 4.0f;  // per meter
const float ring_radius = 0.095f;
const float ring_width = 0.03f;
const float ring_rate = 2.0f;  // turns per second
// Streams of flow_cells per meter across, flow_lengths per meter down. They move in steps of flow_rate per second.
const float flow_cells = 16.0f;
const float flow_lengths = 2.0f;
const float flow_rate = 0.1f;  // in lengths; a vertical face has 10 steps: .5 m/s
// Puddles are where a sum of two noises is low: two shares of puddle_cells per meter, one of fine_puddle_cells.
const float puddle_cells = 0.5f;
const float fine_puddle_cells = 2.0f;
const float puddle_rim = 0.06f;   // of the noise's range, over which a puddle ends
const float puddle_share = 0.8f;  // of the noise's range that puddles=1 and wetness=1 fill
const float puddle_gloss = 0.97f;

// Keys of hashes.
const uint tap_key = 0x7a9u;
const uint drop_key = 0xd309u;
const uint turn_key = 0x70b2u;
const uint flow_x_key = 0xf10u;
const uint flow_z_key = 0xf11u;
const uint puddle_key = 0x9d1u;
const uint fine_puddle_key = 0x9d2u;

#ifdef __cplusplus
}
#endif
#endif
