// What culling found in the tile of each pixel, as a picture: see the rows in views.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/lighting/tiled/views.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint shown = view_modes;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;
layout(set = 0, binding = 1, scalar) readonly buffer Records { TileRecord records[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Statistics { TileStatistics statistics[]; };
layout(push_constant, scalar) uniform Push { ModeOrder order; };

uint mode_of(uint tile) { return records[tile].counts >> 16 & 255u; }

bool is_empty(uint tile) { return mode_of(tile) == empty_tile_mode; }

// Black where nothing is shaded.
vec3 color_of_mode(uint tile) {
    if (is_empty(tile)) return vec3(0.0);
    const uint mode = mode_of(tile);
    return vec3(mode_channel(mode, most_modes, 0), mode_channel(mode, most_modes, 1), mode_channel(mode, most_modes, 2));
}

// Of the LDS that culling's lists have, what the largest batch of this tile uses.
uint bytes_used(TileStatistics s) {
    const uint slots = min(s.touching, most_tile_lights), pairs = min(max(s.blocker_pairs, s.portal_pairs), most_tile_pairs);
    return 4u * (slots + min(s.kept, slots)) + 2u * pairs + 12u * (s.blocker_pairs + s.portal_pairs > 0u ? slots : 0u);
}

vec3 overflow_color(uint overflow) { return vec3(overflow & 1u, overflow >> 1 & 1u, overflow >> 2 & 1u); }

// -1 where nothing is shaded.
float number_of_mode(uint tile) { return is_empty(tile) ? -1.0 : float(mode_of(tile)); }

vec3 shown_of(uint tile) {
    const TileStatistics s = statistics[tile];
    if (shown == view_mode_numbers) return vec3(number_of_mode(tile));
    if (shown == view_spectrum) return vec3(is_empty(tile) ? -1.0 : float((records[tile].spectrum | order.force) & 0xffffu));
    if (shown == view_modes) return color_of_mode(tile);
    if (shown == view_bytes) return vec3(bytes_used(s));
    if (shown == view_overflow) return overflow_color(s.overflow);
    if (shown == view_lights) return vec3(s.kept, s.touching, 0.0);
    if (shown == view_pixel_tests) return vec3(s.pixel_blockers);
    if (shown == view_culled) return vec3(s.touching - s.kept, s.candidates - s.touching, 0.0);
    if (shown == view_features) return s.records > 0u ? vec3(bitCount(records[tile].spectrum)) : vec3(0.0);
    return vec3(s.touching, s.blocker_pairs, s.portal_pairs) / vec3(most_tile_lights, most_tile_pairs, most_tile_pairs);
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy, extent = uvec2(imageSize(picture).xy);
    if (any(greaterThanEqual(pixel, extent))) return;
    const uvec2 tile = pixel / tile_size;
    const uint across = (extent.x + tile_size - 1u) / tile_size;
    imageStore(picture, ivec3(pixel, 0), vec4(shown_of(tile.y * across + tile.x), 1.0));
}
