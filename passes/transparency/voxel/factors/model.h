// The products of factors.h in double: what blending makes of a texel's fragments, slice by slice.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/reference/fragments.h"
#include "passes/transparency/voxel/volume/column.h"

namespace strata::transparency {

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
