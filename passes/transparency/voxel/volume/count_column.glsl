// What integration counts of a column, added up over a subgroup first: an atomic per column costs as much as the column. A shader
// that includes this declares `VoxelCounters counters` first.
#ifndef PASSES_TRANSPARENCY_VOXEL_COUNT_COLUMN_GLSL
#define PASSES_TRANSPARENCY_VOXEL_COUNT_COLUMN_GLSL
#extension GL_KHR_shader_subgroup_arithmetic : require

void count_column(uint integrated, bool has_overflowed, bool is_saturated) {
    const uvec4 counted = subgroupAdd(uvec4(1u, integrated, uint(has_overflowed), uint(is_saturated)));
    if (!subgroupElect()) return;
    atomicAdd(counters.columns, counted.x);
    if (counted.y > 0u) atomicAdd(counters.integrated, counted.y);
    if (counted.z > 0u) atomicAdd(counters.overflowed, counted.z);
    if (counted.w > 0u) atomicAdd(counters.saturated, counted.w);
}

#endif
