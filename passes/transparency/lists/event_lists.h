// Every transparent fragment of a frame in a list per sample, on the device: counted, then stored, then sorted. Done in bands of
// rows whose fragments fit the memory whatever the device covers, so that none is ever dropped.
#pragma once

#include <span>
#include <vector>

#include "passes/technique.h"
#include "passes/transparency/lists/event_lists.shared.h"

namespace strata::transparency {

struct EventLists {
    std::vector<Band> bands;  ///< at least one
    Buffer counts, starts, group_starts, keys, events;
    Buffer offsets;  ///< d of every event, in a frame with materials that distort; else of none
};

/// Memory for the largest band. pool: million fragments kept at a time (52 bytes each).
EventLists create_lists(Graph&, const FrameImages&, float pool);

/// Declares what makes the lists of a band, sorted by `order` (event_lists.shared.h). Counts into ListCounters.
void make_lists(Graph&, const FrameImages&, EventLists&, const Band&, std::uint32_t order);

/// Binds what passes/transparency/lists/event_lists.glsl and events.glsl declare, and pushes the band.
template <typename Pass>
Pass& read_lists(Pass&& pass, const EventLists& lists, const Band& band) {
    return pass.loads("Counts", lists.counts)
        .loads("Starts", lists.starts)
        .loads("GroupStarts", lists.group_starts)
        .loads("Keys", lists.keys)
        .loads("Events", lists.events)
        .push(band);
}

/// Threads of a step over a band: one per cell.
inline Extent over(const Band& band) { return {band.width, band.rows, band.samples}; }

/// The row of the `pool` parameter.
inline constexpr Param pool_row = {
    .name = "pool",
    .low = 0.01,
    .high = 64,
    .fallback = 2,
    .help = "million fragments kept at a time (52 bytes each); a frame that can have more is done in bands of rows",
    .scale = Scale::logarithmic};

/// The row of a count of atomic operations; a technique without one has none but those that count.
inline constexpr Counter atomics_row = {.name = "atomics", .help = "atomic operations on what is kept of fragments"};

/// The rows of ListCounters, which a technique's counters begin with.
std::vector<Counter> list_counters();

/// Visible fragments per pixel, the deepest sample's.
Image layers_view(Graph&, FrameImages&, const Settings&);
inline constexpr DebugView layers_view_row = {.name = "layers",
                                              .help = "visible fragments per pixel, the deepest sample's",
                                              .unit = "fragments",
                                              .low = 0,
                                              .high = 32,
                                              .declare = layers_view};

}  // namespace strata::transparency
