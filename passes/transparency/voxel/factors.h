// Volumes whose slices hold products and not sums: layers of an array that triangles are blended into, a whole one into one slice
// (transparency chapter 6.4). The products become the codes that atomics would have added up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/frame_images.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/voxel/column.h"
#include "passes/transparency/voxel/volume.h"

namespace strata::transparency {

/// Multiplies the low frame's transmittances into the layers of an array of `bits` and writes them into the volume as words.
void splat_factors(Graph&, const FrameImages& low, const VoxelParams&, Volume&);

/// One blend into a texel of 8 or 16 bits or a float. Vulkan leaves the rounding open: here to nearest, of the factor and of the
/// product.
double multiplied(double stored, double factor, std::uint32_t bits);

/// By Fragment::submission: the mean depth of every transparent triangle's corners, which decides about its slice.
std::vector<double> depths_of_triangles(const Frame&);

struct Multiplication {
    std::uint32_t slice = 0;
    double factor = 1;
};
/// What a texel's fragments do to one of its channels, 3 or 1, in order of submission.
std::vector<Multiplication> multiplications(std::span<const Fragment>, std::span<const std::uint32_t> slices_of_triangles,
                                            std::size_t channel, std::size_t channels);
/// Blends them one after the other and encodes what is left in each slice.
Column column_of_factors(const ColumnFormat&, std::span<const Multiplication>, std::uint32_t bits);

}  // namespace strata::transparency
