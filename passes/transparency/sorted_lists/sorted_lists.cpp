// Every fragment in a list of its sample, sorted, composited: the reference on the device. Exact but for float.
#include <algorithm>
#include <cassert>
#include <limits>

#include "passes/technique.h"
#include "passes/transparency/event_draw.h"
#include "passes/transparency/row_bounds.h"
#include "passes/transparency/sorted_lists/model.h"
#include "passes/transparency/sorted_lists/sorted_lists.shared.h"

namespace strata::transparency {

Image sorted_lists_layers_view(Graph&, FrameImages&, const Settings&);  // views.cpp

namespace {

struct Lists {
    Buffer counts, starts, group_starts, keys, events;
};

std::uint32_t cells(const Band& band) { return band.width * band.rows * band.samples; }
std::uint32_t groups(const Band& band) { return (cells(band) + cells_per_group - 1) / cells_per_group; }

/// Bands of rows whose fragments fit the pool whatever the device covers, so that none is ever dropped.
std::vector<Band> bands(const FrameImages& images, const Settings& settings) {
    const double limit = double(settings.as<SortedListsParams>().pool) * 1e6 / images.samples;
    const auto row_bounds = transparent_row_bounds(*images.recorded, images.extent);
    std::vector<Band> listed;
    std::uint64_t pool = 1;
    for (const RowBand& rows : row_bands(row_bounds, static_cast<std::uint64_t>(limit))) {
        pool = std::max(pool, rows.bound * images.samples);
        listed.push_back({rows.first_row, rows.rows, images.extent.width, images.samples, 0});
    }
    assert(pool <= std::numeric_limits<std::uint32_t>::max());
    for (Band& band : listed) band.pool = static_cast<std::uint32_t>(pool);
    return listed;
}

Lists create_lists(Graph& graph, std::span<const Band> listed) {
    const Band& largest = *std::ranges::max_element(listed, {}, [](const Band& band) { return band.rows; });
    const std::uint64_t words = std::uint64_t{cells(largest)} * sizeof(std::uint32_t);
    return {
        .counts = graph.create("sorted_lists counts", words),
        .starts = graph.create("sorted_lists starts", words),
        .group_starts = graph.create("sorted_lists group starts", groups(largest) * sizeof(std::uint32_t)),
        .keys = graph.create("sorted_lists keys", std::uint64_t{largest.pool} * sizeof(ListKey)),
        .events = graph.create("sorted_lists events", std::uint64_t{largest.pool} * sizeof(ListEvent)),
    };
}

void count_and_scan(Graph& graph, const FrameImages& images, Lists& lists, const Band& band) {
    graph.clear(lists.counts, 0);
    graph.draw("transparency/sorted_lists/count", images.transparent)
        .tests_depth(images.depth)
        .updates("Counts", lists.counts)
        .push(band);
    graph.compute("transparency/sorted_lists/scan_cells.comp")
        .loads("Counts", lists.counts)
        .stores("Starts", lists.starts)
        .stores("GroupStarts", lists.group_starts)
        .push(band)
        .groups({groups(band), 1, 1});
    graph.compute("transparency/sorted_lists/scan_groups.comp")
        .updates("GroupStarts", lists.group_starts)
        .push(band)
        .groups({1, 1, 1});
}

void fill(Graph& graph, const FrameImages& images, Lists& lists, const Band& band) {
    graph.clear(lists.counts, 0);
    draw_events(graph, "transparency/sorted_lists/fill", images.transparent, images)
        .updates("Counts", lists.counts)
        .loads("Starts", lists.starts)
        .loads("GroupStarts", lists.group_starts)
        .stores("Keys", lists.keys)
        .stores("Events", lists.events)
        .push(band);
}

void sort_and_resolve(Graph& graph, FrameImages& images, Lists& lists, const Band& band) {
    const Extent threads{band.width, band.rows, band.samples};
    graph.compute("transparency/sorted_lists/sort.comp")
        .loads("Counts", lists.counts)
        .loads("Starts", lists.starts)
        .loads("GroupStarts", lists.group_starts)
        .updates("Keys", lists.keys)
        .push(band)
        .over(threads);
    graph.compute("transparency/sorted_lists/resolve.comp")
        .loads("Counts", lists.counts)
        .loads("Starts", lists.starts)
        .loads("GroupStarts", lists.group_starts)
        .loads("Keys", lists.keys)
        .loads("Events", lists.events)
        .updates("color", images.color)
        .push(band)
        .over(threads);
}

void add(Graph& graph, FrameImages& images, const Settings& settings) {
    const std::vector<Band> listed = bands(images, settings);
    Lists lists = create_lists(graph, listed);
    for (const Band& band : listed) {
        count_and_scan(graph, images, lists, band);
        fill(graph, images, lists, band);
        sort_and_resolve(graph, images, lists, band);
    }
}

}  // namespace

Technique sorted_lists() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/sorted_lists",
        .title = "Sorted lists",
        .source = "Yang, Hensley, Gruen and Thibieroz 2010, EGSR; Carpenter 1984 (A-buffer)",
        .summary =
            "Stores every fragment, sorts and composites: exact; memory and time grow with depth complexity without limit.",
        .params = {param<&SortedListsParams::pool>(
            {.name = "pool",
             .low = 0.01,
             .high = 64,
             .fallback = 2,
             .help = "million fragments kept at a time (52 bytes each); a frame that can have more is done in bands of rows",
             .scale = Scale::logarithmic})},
        .counters = {counter<&SortedListsCounters::fragments>(
                         {.name = "fragments", .help = "visible transparent fragments stored"}),
                     counter<&SortedListsCounters::deepest>({.name = "deepest", .help = "fragments of the longest list"}),
                     counter<&SortedListsCounters::dropped>({.name = "dropped", .help = "fragments without room: always 0"})},
        .counter_bytes = sizeof(SortedListsCounters),
        .views = {{.name = "layers",
                   .help = "covered fragments per pixel, the deepest sample's",
                   .unit = "fragments",
                   .low = 0,
                   .high = 32,
                   .add = sorted_lists_layers_view}},
        .stands_in_for_truth = true,
        .add = add,
        .model = sorted_lists_model,
        .tolerance =
            {.rmse = 1e-5,
             .worst = 5e-3,
             .because =
                 "lit, filtered and composited in float: 4e-7 and 1.4e-5 measured on lavapipe; a highlight of alpha 0.002, clear "
                 "glass, turns the 1e-6 of an interpolated normal into 2e-3 (GlassVaseFlowers at 640 x 360: 2.2e-3)"},
    };
}

}  // namespace strata::transparency
