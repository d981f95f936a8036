// What frames leave to the next, so that slices do not pop (docs/algorithms/transparency.md 6.11): a coarser volume is held. A
// shader that includes this declares `VoxelPush push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_HISTORY_GLSL
#define PASSES_TRANSPARENCY_VOXEL_HISTORY_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(constant_id = 1) const uint hysteresis = 0u;
layout(set = 0, binding = 4, scalar) buffer History { VoxelHistory history; };

// Of the finest slices to those that are as thick as the frame before had them: its range may have been another. 0 in the first.
uint halvings_held(float finest_thickness) {
    if (history.thickness <= 0.0) return 0u;
    const float halvings = round(log2(history.thickness / finest_thickness));
    return uint(clamp(halvings, 0.0, float(findMSB(push.finest_slices))));
}

// At least so many as make this frame fit. More while the frames before needed them: one less once it fitted for `hysteresis`
// frames in a row. One thread's, once a frame.
uint kept_halvings(uint fitting) {
    if (hysteresis == 0u) return fitting;
    const float finest_thickness = log(2.0) / (push.per_linear * push.slices_per_log2);
    const uint held = halvings_held(finest_thickness);
    uint kept = max(fitting, held);
    history.finer_frames = fitting < held ? history.finer_frames + 1u : 0u;
    if (history.finer_frames > hysteresis) {
        history.finer_frames = 0u;
        --kept;
    }
    history.thickness = finest_thickness * exp2(float(kept));
    return kept;
}

#endif
