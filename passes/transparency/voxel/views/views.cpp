#include "passes/transparency/voxel/views/views.h"

#include "passes/frame_images.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/voxel/volume/dimensions.h"
#include "passes/transparency/voxel/volume/volume.h"

namespace strata::transparency {
namespace {

Image picture_of(Graph& graph, const FrameImages& images) {
    return graph.create("voxel view", Shape{.extent = images.extent, .format = Format::rgba32f});
}

std::uint32_t most_rows(std::uint32_t shown, const VoxelPush& push) {
    if (shown == table_divider) return 1;
    return shown == table_histogram ? push.finest_slices : push.slices;
}

template <std::uint32_t shown>
Image table(Graph& graph, FrameImages& images, const Settings& settings) {
    const auto params = voxel_params(settings, *images.facts);
    Volume volume = integrated_volume(graph, images, params);
    Buffer counts = graph.create("slice counts", volume.push.slices * sizeof(SliceCounts));
    graph.clear(counts, 0);
    ComputeStep counting = graph.compute("transparency/voxel/views/slice_counts.comp");
    look_into(counting, volume, params)
        .updates("Counts", counts)
        .over({volume.push.width, volume.push.height, volume.push.channels});
    const std::uint32_t rows = most_rows(shown, volume.push);
    Image numbers = graph.create("slice table", Shape{.extent = {1, rows}, .format = Format::rgba32f});
    ComputeStep writing = graph.compute("transparency/voxel/views/slice_table.comp");
    read_slices(writing, volume, params).loads("Counts", counts).stores("numbers", numbers).fixes("shown", shown).over({1, rows});
    return numbers;
}

}  // namespace

Image volume_view(Graph& graph, const FrameImages& images, const VoxelParams& params, std::uint32_t shown) {
    Volume volume = integrated_volume(graph, images, params);
    Image picture = picture_of(graph, images);
    ComputeStep builder = graph.compute("transparency/voxel/views/view.comp");
    look_into(builder, volume, params)
        .stores("picture", picture)
        .fixes("shown", shown)
        .fixes("shown_slice", params.shown_slice)
        .fixes("empty_in_front", static_cast<float>(slices_to_zero(params)))
        .over(images.extent);
    return picture;
}

Image warp_view(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    const Volume volume = integrated_volume(graph, images, params);
    Image picture = picture_of(graph, images);
    ComputeStep builder = graph.compute("transparency/voxel/views/warp_view.comp");
    read_slices(builder, volume, params).stores("picture", picture).over(images.extent);
    return picture;
}

Image self_occlusion_view(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    const Volume volume = integrated_volume(graph, images, params);
    Image least = graph.create("least read", Shape{.extent = images.extent, .format = Format::r32ui});
    graph.clear(least, {{double(reads_nothing)}});
    // Against the depth of what is opaque: nothing is culled, what is wholly hidden by itself counts.
    DrawStep draw = draw_fragments(graph, "transparency/voxel/views/least_read", drawn_triangles(images, params), images);
    read_volume(draw, volume, params, Resolution::full).updates("least_read", least).drops_other_colors();
    Image picture = picture_of(graph, images);
    graph.compute("transparency/voxel/views/self_occlusion_view.comp")
        .samples("least_read", least)
        .stores("picture", picture)
        .over(images.extent);
    return picture;
}

std::vector<DebugTable> voxel_tables() {
    return {
        {.name = "slices",
         .help = "occupied physical slices: begin and end (0 for those of an interface layer), virtual slice, tiles that use it",
         .columns = {{"begins", "m"}, {"ends", "m"}, {"virtual slice", ""}, {"tiles", ""}},
         .declare = table<table_slices>},
        {.name = "runs",
         .help = "runs of occupied slices: begin, end, first physical slice, number of slices",
         .columns = {{"begins", "m"}, {"ends", "m"}, {"first slice", ""}, {"slices", ""}},
         .declare = table<table_runs>},
        {.name = "histogram",
         .help = "all virtual slices: begin, end, physical slice (-1: none), columns occupied, summed over channels",
         .columns = {{"begins", "m"}, {"ends", "m"}, {"slice", ""}, {"filled", "columns"}},
         .declare = table<table_histogram>},
        {.name = "overflows",
         .help = "occupied physical slices: begin, number, and the columns, summed over channels, in which it is the first to "
                 "overflow or to saturate",
         .columns = {{"begins", "m"}, {"slice", ""}, {"overflowed", "columns"}, {"saturated", "columns"}},
         .declare = table<table_overflows>},
        {.name = "divider",
         .help = "halvings of the finest number of slices, those that this frame needs without hysteresis, virtual slices left, "
                 "occupied ones among them",
         .columns = {{"halvings", ""}, {"needed", ""}, {"virtual slices", ""}, {"used", ""}},
         .declare = table<table_divider>}};
}

}  // namespace strata::transparency
