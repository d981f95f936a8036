#include "passes/transparency/voxel/views.h"

#include "passes/transparency/voxel/model.h"
#include "passes/transparency/voxel/volume.h"

namespace strata::transparency {
namespace {

Image picture_of(Graph& graph, const FrameImages& images) {
    return graph.create("voxel view", Shape{.extent = images.extent, .format = Format::rgba32f});
}

enum class Rows { slices, runs };

template <Rows rows>
Image table(Graph& graph, FrameImages& images, const Settings& settings) {
    const auto params = voxel_params(settings, *images.recorded);
    Volume volume = integrated_volume(graph, images, params);
    Buffer counts = graph.create("slice counts", volume.push.slices * sizeof(SliceCounts));
    graph.clear(counts, 0);
    ComputePass counting = graph.compute("transparency/voxel/slice_counts.comp");
    look_into(counting, volume, params)
        .updates("Counts", counts)
        .over({volume.push.width, volume.push.height, volume.push.channels});
    Image numbers = graph.create("slice table", Shape{.extent = {1, volume.push.slices}, .format = Format::rgba32f});
    ComputePass writing = graph.compute("transparency/voxel/slice_table.comp");
    read_slices(writing, volume, params)
        .loads("Counts", counts)
        .stores("numbers", numbers)
        .fixes("shows_runs", rows == Rows::runs ? 1u : 0u)
        .over({1, volume.push.slices});
    return numbers;
}

}  // namespace

Image volume_view(Graph& graph, const FrameImages& images, const VoxelParams& params, std::uint32_t shown) {
    Volume volume = integrated_volume(graph, images, params);
    Image picture = picture_of(graph, images);
    ComputePass pass = graph.compute("transparency/voxel/view.comp");
    look_into(pass, volume, params)
        .stores("picture", picture)
        .fixes("shown", shown)
        .fixes("empty_in_front", static_cast<float>(slices_to_zero(params)))
        .over(images.extent);
    return picture;
}

Image warp_view(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    const Volume volume = integrated_volume(graph, images, params);
    Image picture = picture_of(graph, images);
    ComputePass pass = graph.compute("transparency/voxel/warp_view.comp");
    read_slices(pass, volume, params).stores("picture", picture).over(images.extent);
    return picture;
}

std::vector<DebugTable> voxel_tables() {
    return {{.name = "slices",
             .help = "the physical slices that hold something: where each begins (an interface layer's at 0), how many tiles use "
                     "it, in how many columns it is "
                     "the first to overflow or to be full",
             .columns = {{"begins", "m"}, {"tiles", ""}, {"overflowed", "columns"}, {"saturated", "columns"}},
             .add = table<Rows::slices>},
            {.name = "runs",
             .help = "what the depth warp leaves: stretches of depth with something in them, their first physical slice and how "
                     "many they have",
             .columns = {{"begins", "m"}, {"ends", "m"}, {"first slice", ""}, {"slices", ""}},
             .add = table<Rows::runs>}};
}

}  // namespace strata::transparency
