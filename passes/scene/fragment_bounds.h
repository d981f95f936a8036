// How many transparent fragments rows and samples can have at most, from the projected triangles and without a device: a
// technique that stores every fragment sizes its memory and its loops by these bounds, so that no fragment can be dropped.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "passes/graph/step.h"
#include "passes/scene/draw_lists.h"

namespace strata {

/// Depth is not tested, and edges are widened by what a device rounds in float and by its snapping, so no device covers more.
struct FragmentBounds {
    /// Per row of the extent: samples that each transparent triangle (each particle's quad) can cover in the row, summed.
    std::vector<std::uint64_t> by_row;
    /// Fragments that one sample can have: the largest number of bounding rectangles that overlap in a pixel.
    std::uint64_t layers = 0;
};
/// samples: per pixel; a single one lies in its middle, several may lie anywhere in it.
FragmentBounds fragment_bounds(const Frame&, const DrawLists&, Extent, std::uint32_t samples);

/// Rows that are done together.
struct RowBand {
    std::uint32_t first_row = 0, rows = 0;
    std::uint64_t bound = 0;  ///< fragments it can have
};

/// The rows as few bands with at most `limit` fragments and `most_rows` rows each. A band has an even number of rows but for the
/// last, so no 2x2 quad straddles two; where a single pair of rows exceeds a limit, so does its band. Always at least one band.
std::vector<RowBand> row_bands(std::span<const std::uint64_t> fragments_by_row, std::uint64_t limit,
                               std::uint32_t most_rows = std::numeric_limits<std::uint32_t>::max());

}  // namespace strata
