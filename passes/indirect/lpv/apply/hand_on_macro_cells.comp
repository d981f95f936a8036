// The lists of blockers near a grid's macro-cells, for stages after this one: texels of the image volume_light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/indirect/macro_cells.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { HandOnMacroPush push; };

layout(set = 0, binding = 0, scalar) readonly buffer MacroCells { uint macro_cells[]; };
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D volume_light;

vec2 halves(uint list, uint word) {
    const uint bits = word < blocker_words ? macro_cells[list * blocker_words + word] : 0u;
    return vec2(bits & 0xffffu, bits >> 16u);
}

void main() {
    const uvec3 macro = uvec3(gl_GlobalInvocationID.xy, gl_GlobalInvocationID.z / texels_per_list);
    if (any(greaterThanEqual(macro, macro_extent(push.grid)))) return;
    const uint list = macro_index(push.grid, macro), texel = gl_GlobalInvocationID.z % texels_per_list, word = texel * list_words_per_texel;
    const uint place = list * texels_per_list + texel;
    imageStore(volume_light, ivec2(place % volume_texels_per_row, push.row + place / volume_texels_per_row),
               vec4(halves(list, word), halves(list, word + 1u)));
}
