// What tiled lighting's C++ and its shaders share: settings, limits, what culling keeps of a tile, counters.
#ifndef PASSES_LIGHTING_TILED_SHARED_H
#define PASSES_LIGHTING_TILED_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
#include <cstddef>
namespace strata::lighting {
#endif

// 256 threads: one per pixel, and one per pair; 64 lights are a wave of GCN (docs/algorithms/lighting.md 1.6).
const uint tile_size = 16u;
const uint tile_threads = 256u;
const uint most_tile_lights = 64u;
const uint most_tile_pairs = 256u;
const uint macro_size = 128u;     // pixels: 8 x 8 tiles share a list of candidates
const uint most_listed = 65536u;  // lights: a record's are 16 bits; what is beyond is shaded without a list

// Settings, in the order of their choices in tiled.cpp.
const uint blockers_per_pixel = 0u;
const uint blockers_tile_only = 1u;
const uint blockers_off = 2u;
const uint overflow_batch = 0u;
const uint overflow_drop = 1u;
const uint prefilter_automatic = 0u;
const uint prefilter_off = 1u;
const uint prefilter_on = 2u;
const uint shadows_image = 0u;
const uint shadows_inline = 1u;
const uint branches_specialized = 0u;
const uint branches_uniform = 1u;

// 16 by settings, and the one of all features where they lack it.
const uint most_modes = 17u;
// Of a tile nothing is shaded in.
const uint empty_tile_mode = 255u;

// From cheap to dear: the first that has all of a tile's features is the one to shade it with. The last serves every tile.
struct ModeOrder {
    uint count;
    uint force;              // features that every tile is said to have
    uint modes[most_modes];  // features in the lower, number in the upper half
};

struct CullPush {
    ModeOrder order;
    uint spare_records;  // beside the one that each tile has; not a constant, which would compile anew for every number of lights
};

// Why a tile's record may hold less than there is; the image is the same but for the first, with overflow=drop.
const uint overflow_lights = 1u;
const uint overflow_blocker_pairs = 2u;
const uint overflow_portal_pairs = 4u;

// Up to 64 lights of a tile (docs/algorithms/lighting.md 2.9): 16 bytes and 640. More are in the next record, and so on; what no
// record is left for begins at light `next` and is shaded with every test.
const uint next_is_light = 0x80000000u;
const uint no_next = 0xffffffffu;
struct TileRecord {
    uint next;
    uint counts;                         // lights: 8 bits; overflow: 3; mode: 8, from bit 16
    uint spectrum;                       // features that its surfaces and lights need
    uint depths;                         // nearest and farthest as half floats, for the eye alone: rounded
    uint lights[most_tile_lights / 2u];  // 16 bits each, by index
    uint blockers[most_tile_lights];     // of the light's: those that its pixels test
    uint portals[most_tile_lights];      // of the light's: those that its pixels test
};

// What views show of a tile. Numbers go on counting beyond their limits.
struct TileStatistics {
    uint candidates;     // lights that were asked whether they reach the tile
    uint touching;       // of these those that do, blockers left aside
    uint kept;           // of these those that a blocker does not hide from all of the tile
    uint blocker_pairs;  // the most of a batch
    uint portal_pairs;
    uint pixel_blockers;  // (light, blocker) that its pixels test
    uint overflow;
    uint records;
};

// LDS of culling, at the offsets of docs/algorithms/lighting.md 1.6. With a bit per thread for places in order (32 bytes) it is
// 2048 at most.
struct TileLists {
    uint initial[most_tile_lights];    // light indices, ascending
    uint final[most_tile_lights];      // before P6: pairs of each light
    uint pairs[most_tile_pairs / 2u];  // slot << 5 | local in 16 bits
    uint portals_full[most_tile_lights];
    uint portals_part[most_tile_lights];
    uint blockers_part[most_tile_lights];
    uint nearest, farthest;            // bits of view depth
    uint near_end, far_begin;          // of the gap in the middle that half-Z leaves out
    uint models;                       // features of the surfaces
    uint cursor;                       // first candidate of the next batch
    uint touching, lights, kept;       // of the batch: what reaches the tile, has a slot, is not killed
    uint portal_pairs, blocker_pairs;  // of the batch
    uint killed[2];
    uint spectrum;
    uint overflow;
    uint record;          // where the batch is written
    uint pixel_blockers;  // of the batch
    uint classes[6];      // none, partial, full: portals, blockers
};

// Groups of a dispatch, and where its tiles begin in the list.
struct ModeDispatch {
    uint x, y, z;
    uint first;
    uint count;
};
const uint dispatch_width = 4096u;  // x may be 65535 at most, and 8K has 129600 tiles

struct TiledCounters {
    uint tiles;
    uint empty_tiles;
    uint lights_touching;
    uint lights_kept;
    uint lights_killed;
    uint portals_none, portals_partial, portals_full;
    uint blockers_none, blockers_partial, blockers_full;
    uint tiles_over_lights, tiles_over_blocker_pairs, tiles_over_portal_pairs;
    uint tiles_testing_pixels;
    uint unlisted_tiles;
    uint most_lights;
    uint most_blocker_pairs, most_portal_pairs;
    uint modes_compiled, modes_used, tiles_unserved;
    uint samples_shaded;
    uint evaluations;
    uint blocker_tests;
    uint unfinished;
};

#ifdef __cplusplus
static_assert(sizeof(TileRecord) == 656);
static_assert(offsetof(TileLists, pairs) == 512 && offsetof(TileLists, portals_full) == 1024 &&
              offsetof(TileLists, portals_part) == 1280 && offsetof(TileLists, blockers_part) == 1536 &&
              offsetof(TileLists, nearest) == 1792);
static_assert(sizeof(TileLists) + tile_threads / 8 <= 2048);
}
#endif
#endif
