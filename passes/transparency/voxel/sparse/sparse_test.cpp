// Facts about the pool of blocks of a sparse volume, and what is noted of it.
#include "passes/transparency/voxel/sparse/sparse.h"

#include <gtest/gtest.h>

namespace strata::transparency {
namespace {

constexpr Extent one_tile{8, 8}, full_hd{1920, 1080};

VoxelParams sparse_params(std::uint32_t pool, std::uint32_t bits = bits_8) {
    return {.slices = 128,
            .volume = volume_sparse,
            .thinnest = 1e-5f,
            .pool = pool,
            .splat = splat_overflow_minimum,
            .bits = bits,
            .splatting = splatting_linear,
            .curve = curve_linear,
            .linear = 10};
}

TEST(VoxelSparsePool, HasALayerOf4096BlocksForEachMiB) {
    EXPECT_EQ(pool_blocks(sparse_params(1)), 4096u);
    EXPECT_EQ(tile_size * tile_size * sizeof(std::uint32_t) * pool_blocks(sparse_params(16)), 16u << 20);
}

TEST(VoxelSparsePool, CoversWhatTheImagesEdgesCutOff) {
    EXPECT_EQ(voxel_tiles(one_tile), (Extent{1, 1}));
    EXPECT_EQ(voxel_tiles({9, 16}), (Extent{2, 2}));
    EXPECT_EQ(voxel_tiles(full_hd), (Extent{240, 135}));
}

TEST(VoxelSparsePool, SufficesWhereEveryTileAndChannelGetsAWord) {
    EXPECT_TRUE(pool_suffices(sparse_params(16), full_hd, 1));   // 32400 of 65536
    EXPECT_FALSE(pool_suffices(sparse_params(16), full_hd, 3));  // 97200
    EXPECT_TRUE(pool_suffices(sparse_params(24), full_hd, 3));
    EXPECT_TRUE(pool_suffices(sparse_params(1), {512, 512}, 1));  // 4096 of 4096
    EXPECT_FALSE(pool_suffices(sparse_params(1), {513, 512}, 1));
}

TEST(VoxelSparseNotes, MarkEveryResolutionDownToOneWord) {
    // Of 2048 words, 1024 and so on: 64 + 32 + 16 + 8 + 4 + 2 + 6 x 1 times 32 bits, and for the finest 32 bits and a number.
    const SparseNotes notes = sparse_notes(sparse_params(16), 8192, one_tile);
    EXPECT_EQ(notes.marks, first_mark + 132u);
    EXPECT_EQ(notes.table, 128u);
    EXPECT_EQ(sparse_notes(sparse_params(16, bits_16), 8192, one_tile).marks, first_mark + 260u);
    EXPECT_EQ(sparse_notes(sparse_params(16, bits_32), 8192, one_tile).marks, first_mark + 516u);  // 14 resolutions
    EXPECT_EQ(sparse_notes(sparse_params(16, bits_10), 8192, {16, 8}).table, 2u * 2 * 86);         // 2731 words of three
    EXPECT_EQ(sparse_notes(sparse_params(16), 4, one_tile).marks, first_mark + 1u);
}

TEST(VoxelSparseNotes, AreNoLargerThanThePool) {
    constexpr DepthRange range{1, 50};
    const auto slices = [&](std::uint32_t pool, Extent columns) {
        return sparse_curve(sparse_params(pool), range, columns).slices;
    };
    EXPECT_EQ(slices(16, {160, 90}), 8192);
    EXPECT_EQ(slices(16, full_hd), 2048);  // 132 words of notes for a tile would be 17.1 MB
    EXPECT_EQ(slices(32, full_hd), 4096);
    EXPECT_GE(slices(1, {512, 512}), 4);  // whatever suffices has room for notes of one word
    VoxelParams thick = sparse_params(16);
    thick.thinnest = 10;
    EXPECT_EQ(sparse_curve(thick, range, one_tile).slices, 128);
}

TEST(VoxelSparse, IsAdaptiveWhereThereAreNoWords) {
    VoxelParams params = sparse_params(16);
    EXPECT_TRUE(is_sparse(params));
    EXPECT_FALSE(is_adaptive(params));
    params.splat = splat_multiply;
    EXPECT_FALSE(is_sparse(params));
    EXPECT_TRUE(is_adaptive(params));
    params.volume = volume_dense;
    EXPECT_FALSE(is_adaptive(params));
}

}  // namespace
}  // namespace strata::transparency
