// Which lights a tile of 16 x 16 pixels has, which of their blockers and portals its pixels must ask, and what shading them
// needs: phases P0 to P6 of docs/algorithms/lighting.md 2.4 (Kircher, Rendering Technology in Agents of Mayhem, GDC 2018; the
// tiled list is Andersson's, GDC 2011). One group per tile; more than 64 lights are done in batches, each in a record of its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/lighting/blocker_cells.glsl"
#include "passes/lighting/tile_cell.glsl"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/shaders/brdf.glsl"
#include "passes/shaders/light_features.shared.h"

layout(local_size_x = 256) in;
layout(constant_id = 42) const uint half_z = 1u;
layout(constant_id = 43) const uint blocker_use = blockers_per_pixel;
layout(constant_id = 44) const uint classifies = 1u;
layout(constant_id = 45) const uint overflow_policy = overflow_batch;
layout(constant_id = 46) const uint is_prefiltered = 0u;
layout(constant_id = 47) const uint shadow_features = 0u;  // of shadows that shading looks up or filters

layout(set = 0, binding = 4, scalar) readonly buffer Candidates { uint candidates[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Records { TileRecord records[]; };
layout(set = 0, binding = 6, scalar) buffer UsedRecords { uint used_records; };
layout(set = 0, binding = 7, scalar) writeonly buffer Statistics { TileStatistics statistics[]; };
layout(set = 0, binding = 8, scalar) buffer Counters { TiledCounters counters; };
layout(push_constant, scalar) uniform Push { CullPush push; };

shared TileLists lists;

uint tile_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

#include "passes/lighting/tiled/ordered_append.glsl"
#include "passes/lighting/tiled/depth_bounds.glsl"
#include "passes/lighting/tiled/collect_lights.glsl"
#include "passes/lighting/tiled/classify_pairs.glsl"
#include "passes/lighting/tiled/keep_lights.glsl"
#include "passes/lighting/tiled/tile_header.glsl"

void main() {
    find_depths();
    if (lists.farthest == 0u) {
        write_empty_tile();
        return;
    }
    const TileCells cells = cells_of_tile();
    TileSum sum = no_lights_yet();
    uint record = tile_index();
    begin_tile();
    for (uint batch = 0u; lists.cursor < candidate_count(); ++batch) {
        begin_batch();
        collect_lights(cells);
        if (batch > 0u) {
            if (lists.lights == 0u) break;
            record = next_record(record);
            if (record == no_next) break;
        }
        take_masks();
        if (classifies != 0u && blocker_use != blockers_off) classify_pairs(cells);
        keep_lights(record, cells);
        add_batch(sum, batch);
    }
    write_tile(record, sum);
}
