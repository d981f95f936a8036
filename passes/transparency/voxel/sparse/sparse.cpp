#include "passes/transparency/voxel/sparse/sparse.h"

#include <vector>

#include "passes/transparency/voxel/volume/column.h"

namespace strata::transparency {
namespace {

std::uint32_t words_for(const VoxelParams& params, std::uint32_t slices) {
    ColumnFormat format = column_format(params);
    format.slices = slices;
    return format.words();
}

/// From the finest, halved until there is a single word.
std::vector<std::uint32_t> resolutions_down_from(const VoxelParams& params, std::uint32_t finest) {
    std::vector<std::uint32_t> slices{finest};
    while (words_for(params, slices.back()) > 1) slices.push_back(slices.back() / 2);
    return slices;
}

}  // namespace

bool is_sparse(const VoxelParams& params) { return params.volume == volume_sparse && params.splat != splat_multiply; }

bool is_adaptive(const VoxelParams& params) { return params.volume != volume_dense && !is_sparse(params); }

Extent voxel_tiles(Extent columns) {
    return {(columns.width + tile_size - 1) / tile_size, (columns.height + tile_size - 1) / tile_size};
}

std::uint32_t pool_blocks(const VoxelParams& params) { return params.pool * pool_blocks_per_layer; }

bool pool_suffices(const VoxelParams& params, Extent columns, std::uint32_t channels) {
    const Extent tiles = voxel_tiles(columns);
    return std::uint64_t{tiles.width} * tiles.height * channels <= pool_blocks(params);
}

SparseNotes sparse_notes(const VoxelParams& params, std::uint32_t slices, Extent columns) {
    const Extent tiles = voxel_tiles(columns);
    const std::uint64_t count = std::uint64_t{tiles.width} * tiles.height;
    const auto groups = [&](std::uint32_t n) { return (words_for(params, n) + 31) / 32; };
    SparseNotes notes{.marks = first_mark, .table = count * 2 * groups(slices)};
    for (const std::uint32_t n : resolutions_down_from(params, slices)) notes.marks += count * groups(n);
    return notes;
}

DepthCurve sparse_curve(const VoxelParams& params, DepthRange range, Extent columns) {
    constexpr std::uint64_t words_per_layer = (1 << 20) / sizeof(std::uint32_t);
    DepthCurve curve = depth_curve(params, range);
    const auto too_many = [&] {
        const SparseNotes notes = sparse_notes(params, static_cast<std::uint32_t>(curve.slices), columns);
        return notes.marks + notes.table > params.pool * words_per_layer;
    };
    while (curve.slices > 1 && too_many()) curve.slices /= 2;
    return curve;
}

}  // namespace strata::transparency
