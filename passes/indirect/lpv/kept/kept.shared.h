// What C++ and shaders share about volumes that are kept over frames.
#ifndef PASSES_INDIRECT_LPV_KEPT_SHARED_H
#define PASSES_INDIRECT_LPV_KEPT_SHARED_H
#include "passes/indirect/lpv/lpv.shared.h"
#ifdef __cplusplus
namespace strata::indirect {
#endif

// What a grid leaves to the next frame, beside its light and links. Keys are hashes of 64 bits; 0: there is none.
struct KeptState {
    uvec2 shown;    // of the light that surfaces read
    uvec2 coming;   // of the light that is lit in slices
    uvec2 place;    // of the grid and the rules that both were lit by
    uvec2 linked;   // of what the links were found with
    uvec2 lattice;  // of the cells that the links lie between, wherever the grid's first cell is
    uvec3 first;    // the grid's first cell in the lattice, in two's complement, when the links were found
    uint steps;     // of propagation that the coming light has done
    uint blockers;
    uint portals;
};

// The state before a frame and after it.
struct KeptWork {
    KeptState before, after;
};

// What a frame wants of a grid.
struct DecidePush {
    uvec2 light, place, linked, lattice;  // keys as in KeptState; linked is 0 without links
    uvec3 first, cells;
    uint iterations, slice;
    uint map_size, one_map_size;  // texels a side of six maps, and of one: as many as parallel light has
    uint blockers, portals;
    uint starting_bit;
};

// Hashes of this frame's blockers, then of its portals, as many as a push has room for.
const uint identities_per_push = 15u;
struct IdentityPush {
    uint first, count;
    uvec2 of[identities_per_push];
};

// A blocker, or a portal on its blocker, as rounds that hold it.
struct KeptBarrier {
    uvec2 identity;
    vec3 center;  // meters from the corner of the grid's first cell, along the world's axes
    float radius;
    vec3 normal;
};

struct FacesPush {
    GridPlace grid;
    uvec2 lattice;
    uvec3 first;  // cell in the lattice, in two's complement
    uvec3 turn;   // the same, modulo the grid's cells
};

struct CastersPush {
    uint first, count;
    uint grids;  // starting bits of those that are lit by what the casters reflect
};

#ifdef __cplusplus
}
#endif
#endif
