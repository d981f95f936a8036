// Every transparent fragment of a frame in a list per sample, on the device: counted, then stored, then sorted. Done in bands of
// rows whose fragments fit the memory whatever the device covers, so that none is ever dropped. llvmpipe ends the loops of an
// invocation after 65,535 iterations: long lists are sorted in chunks, and loops over a list take several fragments per
// iteration.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "passes/debug_views.h"
#include "passes/graph/step.h"
#include "passes/settings.h"
#include "passes/transparency/lists/pixel_lists.shared.h"

namespace strata::transparency {

struct PixelLists {
    std::vector<Band> bands;  ///< at least one
    Buffer starts, ends;      ///< of every sample's list; first `ends` are counts
    Buffer group_starts, keys, submissions, fragments;
    Buffer chunks, merged_keys;  ///< for lists of more than chunk_keys keys
    std::uint64_t layers = 0;    ///< fragments that one list can have
    Buffer offsets;              ///< d of every fragment, in a frame with materials that distort; else of none
};

/// Memory for the largest band. pool: million fragments kept at a time; cell_limit: samples of a band, for a technique that keeps
/// something for each.
PixelLists create_lists(Graph&, const FrameImages&, float pool,
                        std::uint64_t cell_limit = std::numeric_limits<std::uint64_t>::max());

/// Samples of the largest band.
std::uint64_t most_cells(const PixelLists&);

/// Declares what makes the lists of a band, sorted by `order` (pixel_lists.shared.h). Counts into ListCounters.
void make_lists(Graph&, const FrameImages&, PixelLists&, const Band&, std::uint32_t order);

/// Parts of make_lists: counts in `ends` become empty lists, one after the other.
void place_lists(Graph&, PixelLists&, const Band&);

/// The parts of create_lists and make_lists that are about keys; lists.layers says how long a list can be.
void create_keys(Graph&, PixelLists&, std::uint32_t keys);
void sort_lists(Graph&, PixelLists&, const Band&, std::uint32_t order);

/// Fragments that a loop over a list has to take per iteration (a power of two), so that no list of the frame needs more than
/// 32,768 turns: a shader's specialization constant. 1 for all but very deep frames.
std::uint32_t fragments_per_iteration(const PixelLists&);

/// Binds what passes/transparency/lists/places.glsl declares, and pushes the band.
template <typename Builder>
Builder& read_places(Builder&& builder, const PixelLists& lists, const Band& band) {
    return builder.loads("Starts", lists.starts).loads("Ends", lists.ends).push(band);
}

/// The same, and what fragments.glsl declares.
template <typename Builder>
Builder& read_lists(Builder&& builder, const PixelLists& lists, const Band& band) {
    return read_places(builder, lists, band).loads("Keys", lists.keys).loads("Fragments", lists.fragments);
}

/// The rows a draw is restricted to, so that it meets no fragment of another band; of images at half the extent with `divisor` 2.
inline Rows rows_of(const Band& band, std::uint32_t divisor = 1) {
    return {band.first_row / divisor, (band.rows + divisor - 1) / divisor};
}

/// Threads of a step over a band: one per cell.
inline Extent over(const Band& band) { return {band.width, band.rows, band.samples}; }

/// The row of the `pool` parameter.
inline constexpr Param pool_row = {
    .name = "pool",
    .low = 0.01,
    .high = 64,
    .fallback = 2,
    .help =
        "fragments stored at a time, in millions (52 to 60 bytes each); a frame that may have more is rendered in bands of rows",
    .scale = Scale::logarithmic};

/// The row of a count of atomic operations; a technique without one has none but those that count.
inline constexpr Counter atomics_row = {.name = "atomics", .help = "atomic operations on stored fragment data"};

/// The rows of ListCounters, which a technique's counters begin with.
std::vector<Counter> list_counters();

/// Visible fragments per pixel, the deepest sample's.
Image layers_view(Graph&, FrameImages&, const Settings&);
inline constexpr DebugView layers_view_row = {.name = "layers",
                                              .help = "visible fragments per pixel, in the sample that has the most",
                                              .unit = "fragments",
                                              .low = 0,
                                              .high = 32,
                                              .declare = layers_view};

}  // namespace strata::transparency
