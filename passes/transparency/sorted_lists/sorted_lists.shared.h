// What the sorted lists' C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_SORTED_LISTS_SHARED_H
#define PASSES_TRANSPARENCY_SORTED_LISTS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

struct SortedListsParams {
    float pool;  // million fragments kept at a time
};

// Rows of the frame whose lists are made together: push constants of every step. A cell is a sample of a pixel of the band.
struct Band {
    uint first_row;
    uint rows;
    uint width;  // pixels
    uint samples;
    uint pool;  // nodes there are
};

// A fragment's place in the order, sorted in place; 16 bytes. Later submission is nearer at equal z.
struct ListKey {
    float z;
    uint draw;
    uint primitive;
    uint event;  // index into events
};

struct ListEvent {
    vec3 p;
    vec3 t;
    vec3 e;
};

struct SortedListsCounters {
    uint fragments;
    uint deepest;
    uint dropped;
};

// Cells whose counts one workgroup sums: 256 threads, 4 cells each.
const uint cells_per_group = 1024u;

#ifdef __cplusplus
}
#endif
#endif
