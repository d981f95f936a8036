#include "passes/transparency/voxel/factors/factors.h"

#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/voxel/sparse/sparse.h"

namespace strata::transparency {
namespace {

constexpr Format gray_formats[] = {Format::r8_unorm, Format::r16_unorm, Format::r16_unorm, Format::r32f};
constexpr Format color_formats[] = {Format::rgba8_unorm, Format::rgba16_unorm, Format::rgba16_unorm, Format::rgba32f};

}  // namespace

void splat_factors(Graph& graph, const FrameImages& low, const VoxelParams& params, Volume& volume) {
    const VoxelPush& push = volume.push;
    const Format format = push.channels == 1 ? gray_formats[params.bits] : color_formats[params.bits];
    Image factors = graph.create("factors", Shape{.extent = low.extent, .format = format, .layers = push.slices});
    graph.clear(factors, {{1, 1, 1, 1}});
    const bool by_vertex = has(low.capabilities, Capability::shader_output_layer);
    const DrawList& list = by_vertex ? low.separate : low.transparent;
    DrawStep draw = draw_fragments_untested(graph, "transparency/voxel/factors/splat_multiply", list, low);
    if (!by_vertex) draw.geometry("transparency/voxel/factors/choose_slice");
    draw.multiplies(factors).loads("DepthWarp", volume.warp).fixes("adaptive", is_adaptive(params) ? 1u : 0u).push(push);
    const Extent columns = graph.shape(volume.voxels).extent;
    graph.compute("transparency/voxel/factors/factors_to_codes.comp")
        .samples("factors", factors)
        .stores("voxels", volume.voxels)
        .fixes("field_bits", volume.field_bits)
        .push(push)
        .over({columns.width, columns.height, push.words});
}

}  // namespace strata::transparency
