// How many transparent fragments a row of pixels can have at most, from the projected triangles and without a device: what a
// technique that stores every fragment sizes its memory by, so that none can be dropped.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/frame.h"
#include "passes/graph/graph.h"
#include "passes/scene/draw_lists.h"

namespace strata {

/// Per row of the extent: pixels each transparent triangle (each particle's quad) can touch in it, summed. Depth is not
/// tested and edges are widened by a quarter pixel for float transforms and snapping, so no device covers more.
std::vector<std::uint64_t> most_fragments_by_row(const Frame&, const DrawLists&, Extent);

/// Rows that are done together.
struct RowBand {
    std::uint32_t first_row = 0, rows = 0;
    std::uint64_t bound = 0;  ///< fragments it can have
};

/// The rows as few bands with at most `limit` fragments each. A band has an even number of rows but for the last, so no 2x2
/// quad straddles two; where a single pair of rows exceeds the limit, so does its band. Always at least one band.
std::vector<RowBand> row_bands(std::span<const std::uint64_t> most_fragments_by_row, std::uint64_t limit);

}  // namespace strata
