// Exclusive prefix sum over a workgroup of 256 threads (Hillis and Steele 1986). Integers: the same on every device.
#ifndef PASSES_TRANSPARENCY_LISTS_SCAN_GLSL
#define PASSES_TRANSPARENCY_LISTS_SCAN_GLSL
#include "passes/transparency/lists/pixel_lists.shared.h"

const uint scan_threads = 256u;
shared uint scan_sums[scan_threads];

struct Scanned {
    uint before;  // sum of the values of earlier threads
    uint total;
};

// Every thread of the group must call it.
Scanned scan_group(uint value) {
    const uint i = gl_LocalInvocationIndex;
    scan_sums[i] = value;
    barrier();
    for (uint reach = 1u; reach < scan_threads; reach *= 2u) {
        const uint other = i >= reach ? scan_sums[i - reach] : 0u;
        barrier();
        scan_sums[i] += other;
        barrier();
    }
    const Scanned result = Scanned(scan_sums[i] - value, scan_sums[scan_threads - 1u]);
    barrier();  // before the next call overwrites the sums
    return result;
}

// The first cell of this invocation, where a workgroup has cells_per_group of them.
uint first_cell() { return gl_WorkGroupID.x * cells_per_group + gl_LocalInvocationIndex * cells_per_thread; }

#endif
