#include "passes/transparency/voxel/volume/dimensions.h"

#include <algorithm>

#include "passes/scene/scene_facts.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/voxel/sparse/sparse.h"
#include "passes/transparency/voxel/volume/color_column.h"
#include "passes/transparency/voxel/volume/column.h"

namespace strata::transparency {
VoxelParams voxel_params(const Settings& settings, const SceneFacts& facts) {
    auto params = settings.as<VoxelParams>();
    if (params.volume == volume_sparse && facts.highest_interface_layer() > 0) params.volume = volume_adaptive;
    return params;
}

VoxelParams of_world(VoxelParams params, const SceneFacts& facts) {
    params.slices = std::min(params.slices, most_slices - facts.highest_interface_layer());
    return params;
}

VoxelParams of_volume(VoxelParams params, const SceneFacts& facts) {
    params.slices = of_world(params, facts).slices + facts.highest_interface_layer();
    return params;
}

std::uint32_t voxel_words(const VoxelParams& params, std::uint32_t channels) {
    const std::uint32_t words = column_format(params).words();
    return packs_colors(params, channels) ? params.slices + words : channels * words;
}

std::uint32_t voxel_divisor(const VoxelParams& params, Extent extent, std::uint32_t channels) {
    constexpr std::uint64_t largest = 512 << 20;
    std::uint32_t divisor = divisor_of(params.resolution);
    const auto fits = [&](const Extent& low) {
        if (is_sparse(params)) return pool_suffices(params, low, channels);
        return std::uint64_t{low.width} * low.height * voxel_words(params, channels) * sizeof(std::uint32_t) <= largest;
    };
    while (!fits(prepass_extent(extent, divisor))) divisor *= 2;
    return divisor;
}

bool has_segments(const VoxelParams& params) { return params.thickness == thickness_segment && params.splat != splat_multiply; }

std::uint32_t voxel_tint(const VoxelParams& params, const Features& features) {
    return channel_count(params.channels, features) == 1 ? params.tint : tint_total;
}

}  // namespace strata::transparency
