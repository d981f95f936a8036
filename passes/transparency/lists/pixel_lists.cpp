#include "passes/transparency/lists/pixel_lists.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "passes/frame_images.h"
#include "passes/scene/fragment_bounds.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/layers_beyond.h"

namespace strata::transparency {
namespace {

std::uint32_t cells(const Band& band) { return band.width * band.rows * band.samples; }
std::uint32_t groups(const Band& band) { return (cells(band) + cells_per_group - 1) / cells_per_group; }

const FragmentBounds& bounds(const FrameImages& images) { return images.facts->fragment_bounds(images.extent, images.samples); }

std::vector<Band> bands_within(const FrameImages& images, float pool_millions, std::uint64_t cell_limit) {
    const auto limit = static_cast<std::uint64_t>(double(pool_millions) * 1e6);
    const auto most_rows = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(cell_limit / (std::uint64_t{images.extent.width} * images.samples), images.extent.height));
    std::vector<Band> bands;
    std::uint64_t pool = 1;
    for (const RowBand& rows : row_bands(bounds(images).by_row, limit, most_rows)) {
        pool = std::max(pool, rows.bound);
        bands.push_back({rows.first_row, rows.rows, images.extent.width, images.samples, 0});
    }
    // A row of more fragments than that fits on no device, and the allocation says so.
    pool = std::min<std::uint64_t>(pool, std::numeric_limits<std::uint32_t>::max());
    for (Band& band : bands) band.pool = static_cast<std::uint32_t>(pool);
    return bands;
}

void count(Graph& graph, const FrameImages& images, PixelLists& lists, const Band& band) {
    graph.clear(lists.ends, 0);
    DrawStep draw = graph.draw("transparency/lists/count", images.transparent);
    fix_positions(draw, images, Surfaces::transparent)
        .tests_depth(images.depth)
        .culls(hidden_side(images))
        .in_rows(rows_of(band))
        .updates("Ends", lists.ends)
        .push(band);
}

void fill(Graph& graph, const FrameImages& images, PixelLists& lists, const Band& band) {
    draw_fragments(graph, "transparency/lists/fill", images.numbered, images)
        .in_rows(rows_of(band))
        .updates("Ends", lists.ends)
        .loads("Starts", lists.starts)
        .stores("Keys", lists.keys)
        .stores("Submissions", lists.submissions)
        .stores("Fragments", lists.fragments)
        .stores("Offsets", lists.offsets)
        .push(band);
}

const Band& largest_band(const PixelLists& lists) { return *std::ranges::max_element(lists.bands, {}, &Band::rows); }

bool has_long_lists(const PixelLists& lists) { return lists.layers > chunk_keys; }

/// A list of more than chunk_keys keys fills its chunks by more than a half.
std::uint64_t bytes_of_chunks(std::uint64_t keys) { return sizeof(ListChunks) + (2 * keys / chunk_keys + 1) * sizeof(ListChunk); }

/// Binds and fixes what passes/transparency/lists/order.glsl declares.
ComputeStep order_lists(ComputeStep builder, const PixelLists& lists, std::uint32_t order) {
    return builder.loads("Submissions", lists.submissions).fixes("list_order", order);
}

void merge_runs(Graph& graph, PixelLists& lists, Buffer& from, Buffer& to, std::uint32_t run, std::uint32_t order) {
    order_lists(graph.compute("transparency/lists/merge_chunks.comp"), lists, order)
        .loads("Chunks", lists.chunks)
        .loads("From", from)
        .updates("To", to)
        .push(run)
        .indirect(lists.chunks);
}

/// Sorts what sort.comp left. Runs are merged in pairs of steps, so that the keys end where they began.
void sort_long_lists(Graph& graph, PixelLists& lists, std::uint32_t order) {
    order_lists(graph.compute("transparency/lists/sort_chunks.comp"), lists, order)
        .loads("Chunks", lists.chunks)
        .updates("Keys", lists.keys)
        .indirect(lists.chunks);
    for (std::uint32_t run = chunk_keys; run < lists.layers; run *= 4) {
        merge_runs(graph, lists, lists.keys, lists.merged_keys, run, order);
        merge_runs(graph, lists, lists.merged_keys, lists.keys, 2 * run, order);
    }
}

}  // namespace

std::uint64_t most_cells(const PixelLists& lists) { return cells(largest_band(lists)); }

void create_keys(Graph& graph, PixelLists& lists, std::uint32_t keys) {
    lists.keys = graph.create("list keys", std::uint64_t{keys} * sizeof(ListKey));
    lists.submissions = graph.create("list submissions", std::uint64_t{keys} * sizeof(ListSubmission));
    lists.chunks = graph.create("list chunks", bytes_of_chunks(has_long_lists(lists) ? keys : 0));
    if (has_long_lists(lists)) lists.merged_keys = graph.create("list keys merged", std::uint64_t{keys} * sizeof(ListKey));
}

PixelLists create_lists(Graph& graph, const FrameImages& images, float pool, std::uint64_t cell_limit) {
    PixelLists lists{.bands = bands_within(images, pool, cell_limit), .layers = bounds(images).layers};
    const Band& largest = largest_band(lists);
    const std::uint64_t words = std::uint64_t{cells(largest)} * sizeof(std::uint32_t);
    lists.starts = graph.create("list starts", words);
    lists.ends = graph.create("list ends", words);
    lists.group_starts = graph.create("list group starts", groups(largest) * sizeof(std::uint32_t));
    create_keys(graph, lists, largest.pool);
    lists.fragments = graph.create("list fragments", std::uint64_t{largest.pool} * sizeof(ListFragment));
    const bool distorts = images.features->has(Feature::distortion);
    lists.offsets = graph.create("list offsets", std::uint64_t{distorts ? largest.pool : 1} * 2 * sizeof(float));
    return lists;
}

void make_lists(Graph& graph, const FrameImages& images, PixelLists& lists, const Band& band, std::uint32_t order) {
    count(graph, images, lists, band);
    place_lists(graph, lists, band);
    fill(graph, images, lists, band);
    sort_lists(graph, lists, band, order);
}

void place_lists(Graph& graph, PixelLists& lists, const Band& band) {
    graph.compute("transparency/lists/sum_cells.comp")
        .loads("Ends", lists.ends)
        .stores("GroupStarts", lists.group_starts)
        .push(band)
        .groups({groups(band), 1, 1});
    graph.compute("transparency/lists/scan_groups.comp").updates("GroupStarts", lists.group_starts).push(band).groups({1, 1, 1});
    graph.compute("transparency/lists/place_lists.comp")
        .loads("GroupStarts", lists.group_starts)
        .updates("Ends", lists.ends)
        .stores("Starts", lists.starts)
        .push(band)
        .groups({groups(band), 1, 1});
}

void sort_lists(Graph& graph, PixelLists& lists, const Band& band, std::uint32_t order) {
    if (has_long_lists(lists)) graph.clear(lists.chunks, 0);
    order_lists(graph.compute("transparency/lists/sort.comp"), lists, order)
        .loads("Starts", lists.starts)
        .loads("Ends", lists.ends)
        .updates("Keys", lists.keys)
        .updates("Chunks", lists.chunks)
        .fixes("sorts_chunks", has_long_lists(lists) ? 1u : 0u)
        .push(band)
        .over(over(band));
    if (has_long_lists(lists)) sort_long_lists(graph, lists, order);
}

std::uint32_t fragments_per_iteration(const PixelLists& lists) {
    constexpr std::uint64_t most_iterations = 32768;
    return static_cast<std::uint32_t>(std::bit_ceil((lists.layers + most_iterations - 1) / most_iterations));
}

std::vector<Counter> list_counters() {
    return {
        counter<&ListCounters::fragments>({.name = "fragments", .help = "visible transparent fragments stored"}),
        counter<&ListCounters::deepest>({.name = "deepest", .help = "length of the longest list, in fragments"}),
        counter<&ListCounters::dropped>(
            {.name = "dropped", .help = "fragments lost because the pool was full; expected: 0", .is_fatal = true}),
        counter<&ListCounters::miscounted>({.name = "miscounted",
                                            .help = "fragments lost because the draw that counts did not cover them; expected: 0",
                                            .is_fatal = true}),
        counter<&ListCounters::unfinished>(unfinished_row),
        counter<&ListCounters::atomics>(atomics_row),
    };
}

Image layers_view(Graph& graph, FrameImages& images, const Settings&) { return layers_beyond(graph, images, 0, "layers view"); }

}  // namespace strata::transparency
