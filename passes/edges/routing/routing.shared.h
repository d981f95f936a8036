// How threads find the samples that are shaded: what C++ and shaders share.
#ifndef PASSES_EDGES_ROUTING_SHARED_H
#define PASSES_EDGES_ROUTING_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::edges {
#endif

// routing=threads: a thread for every sample, which returns where its pixel is plain. routing=list: a thread for every pixel,
// then one for every further sample of the pixels in a list of edges.
const uint routing_threads = 0u;
const uint routing_list = 1u;

// Which threads a step runs.
const uint threads_of_samples = 0u;
const uint threads_of_pixels = 1u;
const uint threads_of_list = 2u;

const uint threads_per_group = 64u;
const uint groups_per_row = 4096u;  // of the dispatch over the list: Vulkan guarantees 65535 groups each way

// Arguments of the dispatch over the list, and how long the list is.
struct EdgeDispatch {
    uint x;
    uint y;
    uint z;
    uint count;
};

#ifdef __cplusplus
}
#endif
#endif
