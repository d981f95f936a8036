// Sorts the lights by the nearest depth they reach (bitonic: Batcher 1968) and writes the largest farthest depth up to each.
// One group: 4096 lights are 78 steps of 8 pairs per thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/lighting/z_binned/bins.glsl"
#include "passes/shaders/scene.glsl"

layout(local_size_x = 256) in;

layout(set = 0, binding = 0, scalar) coherent buffer Sorted { ZLight sorted[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Header { ZHeader header; };
layout(push_constant, scalar) uniform Push { ZBinsPush push; };

shared float reach[256];
shared uint everywhere;

bool after(ZLight a, ZLight b) { return a.nearest > b.nearest || (a.nearest == b.nearest && a.light > b.light); }

// Compares element pairs `apart` from each other in runs of `run`, rising and falling in turn.
void exchange(uint run, uint apart) {
    for (uint pair = gl_LocalInvocationIndex; pair < push.padded / 2u; pair += 256u) {
        const uint low = 2u * pair - (pair & (apart - 1u)), high = low + apart;
        const ZLight a = sorted[low], b = sorted[high];
        if (after(a, b) == ((low & run) == 0u)) {
            sorted[low] = b;
            sorted[high] = a;
        }
    }
}

void everyone() {
    memoryBarrierBuffer();
    barrier();
}

// The running maximum: each thread's chunk, then what all chunks before it reach.
void write_reach() {
    const uint thread = gl_LocalInvocationIndex, chunk = (push.padded + 255u) / 256u;
    const uint begin = min(thread * chunk, push.lights), end = min(begin + chunk, push.lights);
    float most = -z_largest;
    for (uint i = begin; i < end; ++i) {
        most = max(most, sorted[i].farthest);
        if (sorted[i].nearest == -z_largest) atomicAdd(everywhere, 1u);
    }
    reach[thread] = most;
    barrier();
    float before = -z_largest;
    for (uint i = 0u; i < thread; ++i) before = max(before, reach[i]);
    for (uint i = begin; i < end; ++i) {
        before = max(before, sorted[i].farthest);
        sorted[i].reached = before;
    }
}

void write_header() {
    const bool any = everywhere < push.lights;
    const float near = any ? max(sorted[everywhere].nearest, view.near) : view.near;
    const float far = any ? max(sorted[push.lights - 1u].reached, near * 1.001) : near * 2.0;
    const float way = push.spacing == spacing_logarithmic ? log(far / near) : far - near;
    header = ZHeader(everywhere, near, far, float(push.bins) / way);
}

void main() {
    const uint thread = gl_LocalInvocationIndex;
    if (thread == 0u) everywhere = 0u;
    barrier();
    for (uint run = 2u; run <= push.padded; run <<= 1u) {
        for (uint apart = run >> 1u; apart > 0u; apart >>= 1u) {
            exchange(run, apart);
            everyone();
        }
    }
    write_reach();
    everyone();
    if (thread == 0u) write_header();
}
