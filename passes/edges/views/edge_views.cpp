#include "passes/edges/views/edge_views.h"

#include "passes/edges/mark.h"
#include "passes/edges/plain_pixels.h"
#include "passes/edges/views/views.shared.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"

namespace strata::edges {
namespace {

ComputeStep bound(Graph& graph, const FrameImages& frame, std::string shader) {
    return sample_edges(sample_words(graph.compute(std::move(shader)), frame), frame).samples("emission", frame.emission);
}

template <std::uint32_t shown>
Image picture(Graph& graph, FrameImages& frame, const Settings&) {
    Image image = graph.create("edges view", {.extent = frame.extent, .format = Format::rgba32f});
    bound(graph, frame, "edges/views/picture.comp").stores("picture", image).fixes("shown", shown).over(frame.extent);
    return image;
}

Image histogram(Graph& graph, FrameImages& frame, const Settings&) {
    constexpr Extent rows{1, most_surfaces + 1};
    Buffer counts = graph.create("surfaces per pixel", sizeof(SurfaceCounts));
    graph.clear(counts, 0);
    bound(graph, frame, "edges/views/count.comp").updates("Counts", counts).over(frame.extent);
    Image numbers = graph.create("surfaces per pixel, rows", {.extent = rows, .format = Format::rgba32f});
    graph.compute("edges/views/table.comp").loads("Counts", counts).stores("numbers", numbers).over(rows);
    return numbers;
}

}  // namespace

std::vector<DebugView> edge_views() {
    return {
        {.name = "surfaces",
         .help = "number of different surfaces among a pixel's samples, told apart by their G-buffer words",
         .unit = "surfaces",
         .high = most_surfaces,
         .declare = picture<shows_surfaces>},
        {.name = "outcome",
         .help = "whether each pixel's mark is right by the G-buffer words of its samples; depth_rebuilt and compact store no "
                 "depth in them, so a step of depth alone is an edge in reports and none here",
         .unit = "",
         .declare = picture<shows_outcome>,
         .colors = {{{0, 0.1f, 0.3f}, "plain: shaded once"},
                    {{1, 1, 1}, "edge: shaded per sample"},
                    {{1, 0, 0}, "missed: an edge shaded once"},
                    {{1, 0.8f, 0}, "needless: plain, shaded per sample"}}}};
}

std::vector<DebugTable> edge_tables() {
    return {
        {.name = "surfaces per pixel",
         .help = "number of pixels by the number of surfaces among their samples, and how many of those are shaded per sample",
         .columns = {{"surfaces", ""}, {"pixels", ""}, {"shaded per sample", "pixels"}},
         .declare = histogram}};
}

}  // namespace strata::edges
