#include "passes/transparency/lists/event_lists.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "passes/scene/fragments_by_row.h"
#include "passes/scene/scene_facts.h"
#include "passes/transparency/event_draw.h"
#include "passes/transparency/layers_beyond.h"

namespace strata::transparency {
namespace {

std::uint32_t cells(const Band& band) { return band.width * band.rows * band.samples; }
std::uint32_t groups(const Band& band) { return (cells(band) + cells_per_group - 1) / cells_per_group; }

std::vector<Band> bands_within(const FrameImages& images, float pool_millions) {
    const double limit = double(pool_millions) * 1e6 / images.samples;
    const std::vector<std::uint64_t>& most_fragments_by_row = images.facts->most_fragments_by_row(images.extent);
    std::vector<Band> bands;
    std::uint64_t pool = 1;
    for (const RowBand& rows : row_bands(most_fragments_by_row, static_cast<std::uint64_t>(limit))) {
        pool = std::max(pool, rows.bound * images.samples);
        bands.push_back({rows.first_row, rows.rows, images.extent.width, images.samples, 0});
    }
    assert(pool <= std::numeric_limits<std::uint32_t>::max());
    for (Band& band : bands) band.pool = static_cast<std::uint32_t>(pool);
    return bands;
}

void count_and_scan(Graph& graph, const FrameImages& images, EventLists& lists, const Band& band) {
    graph.clear(lists.counts, 0);
    graph.draw("transparency/lists/count", images.transparent)
        .tests_depth(images.depth)
        .updates("Counts", lists.counts)
        .push(band);
    graph.compute("transparency/lists/scan_cells.comp")
        .loads("Counts", lists.counts)
        .stores("Starts", lists.starts)
        .stores("GroupStarts", lists.group_starts)
        .push(band)
        .groups({groups(band), 1, 1});
    graph.compute("transparency/lists/scan_groups.comp").updates("GroupStarts", lists.group_starts).push(band).groups({1, 1, 1});
}

void fill(Graph& graph, const FrameImages& images, EventLists& lists, const Band& band) {
    graph.clear(lists.counts, 0);
    draw_events(graph, "transparency/lists/fill", images.transparent, images)
        .updates("Counts", lists.counts)
        .loads("Starts", lists.starts)
        .loads("GroupStarts", lists.group_starts)
        .stores("Keys", lists.keys)
        .stores("Events", lists.events)
        .stores("Offsets", lists.offsets)
        .push(band);
}

}  // namespace

EventLists create_lists(Graph& graph, const FrameImages& images, float pool) {
    EventLists lists{.bands = bands_within(images, pool)};
    const Band& largest = *std::ranges::max_element(lists.bands, {}, &Band::rows);
    const std::uint64_t words = std::uint64_t{cells(largest)} * sizeof(std::uint32_t);
    lists.counts = graph.create("list counts", words);
    lists.starts = graph.create("list starts", words);
    lists.group_starts = graph.create("list group starts", groups(largest) * sizeof(std::uint32_t));
    lists.keys = graph.create("list keys", std::uint64_t{largest.pool} * sizeof(ListKey));
    lists.events = graph.create("list events", std::uint64_t{largest.pool} * sizeof(ListEvent));
    const bool distorts = images.features->has(Feature::distortion);
    lists.offsets = graph.create("list offsets", std::uint64_t{distorts ? largest.pool : 1} * 2 * sizeof(float));
    return lists;
}

void make_lists(Graph& graph, const FrameImages& images, EventLists& lists, const Band& band, std::uint32_t order) {
    count_and_scan(graph, images, lists, band);
    fill(graph, images, lists, band);
    graph.compute("transparency/lists/sort.comp")
        .loads("Counts", lists.counts)
        .loads("Starts", lists.starts)
        .loads("GroupStarts", lists.group_starts)
        .updates("Keys", lists.keys)
        .fixes("list_order", order)
        .push(band)
        .over(over(band));
}

std::vector<Counter> list_counters() {
    return {
        counter<&ListCounters::fragments>({.name = "fragments", .help = "visible transparent fragments stored"}),
        counter<&ListCounters::deepest>({.name = "deepest", .help = "fragments of the longest list"}),
        counter<&ListCounters::dropped>({.name = "dropped", .help = "fragments without room", .is_fatal = true}),
        counter<&ListCounters::unfinished>({.name = "unfinished",
                                            .help = "threads whose loops the driver ended early: their lists are too long",
                                            .is_fatal = true}),
        counter<&ListCounters::atomics>(atomics_row),
    };
}

Image layers_view(Graph& graph, FrameImages& images, const Settings&) { return layers_beyond(graph, images, 0, "layers view"); }

}  // namespace strata::transparency
