// What the lists of fragments' C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_LISTS_SHARED_H
#define PASSES_TRANSPARENCY_LISTS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// Rows of the frame whose lists are made together: push constants of every step. A cell is a sample of a pixel of the band.
struct Band {
    uint first_row;
    uint rows;
    uint width;  // pixels
    uint samples;
    uint pool;  // nodes there are
};

// A fragment's place in the order, sorted in place. Small, because llvmpipe moves it lane by lane and word by word.
struct ListKey {
    float z;
    uint fragment;  // index into fragments and submissions
};

// Later is nearer at equal z.
struct ListSubmission {
    uint draw;  // in the order of submission
    uint primitive;
};

// A list of more keys is sorted in chunks of so many, which are merged then: a driver may end loops that turn too often.
const uint chunk_keys = 512u;

// The head of the list of chunks: arguments of an indirect dispatch, one workgroup per chunk up to the limit of a dispatch.
struct ListChunks {
    uvec3 groups;
    uint count;
};
const uint most_chunk_groups = 65535u;  // maxComputeWorkGroupCount that every device has

struct ListChunk {
    uint list;   // first key
    uint keys;   // of the list
    uint place;  // of the chunk within its list
};

struct ListFragment {
    vec3 p;
    vec3 t;
    vec3 e;
};

// The counters of a technique that makes lists begin with these.
struct ListCounters {
    uint fragments;
    uint deepest;
    uint dropped;
    uint miscounted;
    uint unfinished;
    uint atomics;
};

// What a list is sorted by: near to far, or in the order of submission.
const uint list_order_depth = 0u;
const uint list_order_submission = 1u;

// Cells whose counts one workgroup of 256 threads sums.
const uint cells_per_thread = 16u;
const uint cells_per_group = 256u * cells_per_thread;

#ifdef __cplusplus
}
#endif
#endif
