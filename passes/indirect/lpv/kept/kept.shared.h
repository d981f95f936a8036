// What C++ and shaders share about volumes that are kept over frames.
#ifndef PASSES_INDIRECT_LPV_KEPT_SHARED_H
#define PASSES_INDIRECT_LPV_KEPT_SHARED_H
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/shaders/map_casters.shared.h"
#ifdef __cplusplus
namespace strata::indirect {
inline uint starting_bit(uint grid);
inline uint starting_word(uint grid);
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

// Bits of the grids that are lit anew in this frame: from the second word on those of every grid, in the first word those that
// casters are asked about, where grids from the 32nd on share a bit.
uint starting_bit(uint grid) { return 1u << (grid < 31u ? grid : 31u); }
uint starting_word(uint grid) { return 1u + grid / 32u; }

// What a frame wants of a grid.
struct DecidePush {
    uvec2 light, place, linked, lattice;  // keys as in KeptState; linked is 0 without links
    uvec3 first, cells;
    uint iterations, slice;
    uint blockers, portals;
    uint grid;  // its number
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

// Groups of a light's maps over a grid, where that is lit anew.
struct MapGate {
    uint groups;
    uint grid;  // its number
};
const uint map_gates_per_push = 15u;
struct MapGatesPush {
    uint first, count;
    MapGate of[map_gates_per_push];
};

// Casters of one of a light's maps, where grids are lit anew by what they reflect.
struct LitCastersPush {
    MapCastersPush casters;
    uint grids;  // starting bits
};

#ifdef __cplusplus
}
#endif
#endif
