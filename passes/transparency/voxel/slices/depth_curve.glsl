// Slices of depth_curve.h in float, and which of them are there (depth_warp_model.h). A shader that includes this declares `VoxelPush
// push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_DEPTH_CURVE_GLSL
#define PASSES_TRANSPARENCY_VOXEL_DEPTH_CURVE_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(constant_id = 15) const uint adaptive = 0u;  // 1: there is a table
layout(constant_id = 18) const uint sparse = 0u;    // 1: there is a table of blocks (sparse/pool.glsl); all virtual slices are physical
// Entries of virtual slices, then, from most_virtual_slices on, the virtual slice of each physical one.
layout(set = 0, binding = 12, scalar) readonly buffer DepthWarp {
    WarpHeader warp;
    uint warp_entries[];
};

bool is_halved() { return adaptive != 0u || sparse != 0u; }

uint virtual_slices() { return is_halved() ? warp.virtual_slices : push.finest_slices; }
uint physical_slices() { return sparse != 0u ? warp.virtual_slices : push.slices; }

// Of the finest slices, to those that are left after halving.
float halved() { return is_halved() ? exp2(-float(warp.halvings)) : 1.0; }

// Of the finest, not clamped behind.
float finest_slice_of_depth(float z) { return log2(1.0 + max(z - push.nearest, 0.0) * push.per_linear) * push.slices_per_log2; }

// Virtual, clamped to the volume.
float slice_of_depth(float z) {
    return min(finest_slice_of_depth(z) * halved(), float(virtual_slices()) - end_margin);
}

float depth_of_slice(float s) {
    return push.nearest + (exp2(s / (push.slices_per_log2 * halved())) - 1.0) / push.per_linear;
}

// dz / ds.
float thickness_at(float z) {
    return (z - push.nearest + 1.0 / push.per_linear) * log(2.0) / (push.slices_per_log2 * halved());
}

// The physical slice whose integral is that of a virtual one: its own or the last in front of it, which may be an interface's; -1
// if there is none.
int physical_slice(int slice) {
    const int inside = min(slice, int(virtual_slices()) - 1), interfaces = int(push.interfaces);
    if (inside < 0) return interfaces - 1;
    return interfaces + (adaptive != 0u ? int(warp_entries[inside] & warp_count_mask) - 1 : inside);
}

// An interface layer has a slice of its own, which nothing else is added to, and reads the one in front of it.
int slice_of_layer(uint layer) { return int(push.interfaces - layer); }

// Of an interface's slice the world's first.
uint virtual_slice(uint physical) {
    const uint slice = max(physical, push.interfaces) - push.interfaces;
    return adaptive != 0u ? warp_entries[most_virtual_slices + slice] : slice;
}

#endif
