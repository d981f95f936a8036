#include "passes/transparency/voxel/zero_depth/zero_depth.h"

#include <algorithm>
#include <string>

#include "passes/frame_images.h"
#include "passes/scene/scene_facts.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/voxel/zero_depth/zero_depth.shared.h"

namespace strata::transparency {
namespace {

struct ZeroTiles {
    Image depth;  ///< r32f, of each tile: reversed, 0 where something is always seen
    Buffer quads, draw;
    std::uint32_t edge = 16;
};

bool draws_quads(const VoxelParams& params) { return params.culling == culling_quads_16 || params.culling == culling_quads_32; }

ZeroTiles zero_tiles(Graph& graph, const FrameImages& images, const Volume& volume, const VoxelParams& params) {
    const std::uint32_t edge = params.culling == culling_quads_32 ? 32 : 16;
    const Extent tiles{(images.extent.width + edge - 1) / edge, (images.extent.height + edge - 1) / edge};
    const std::uint64_t most = draws_quads(params) ? std::uint64_t{tiles.width} * tiles.height : 1;
    ZeroTiles zero{.depth = graph.create("zero depth", Shape{.extent = tiles, .format = Format::r32f}),
                   .quads = graph.create("zero quads", most * sizeof(ZeroQuad)),
                   .draw = graph.create("zero draw", sizeof(ZeroDraw)),
                   .edge = edge};
    graph.clear(zero.draw, 0);
    ComputeStep builder = graph.compute("transparency/voxel/zero_depth/zero_depth.comp");
    read_slices(builder, volume, params)
        .samples("zero_slices", volume.zero_slices)
        .stores("zero_depth", zero.depth)
        .stores("Quads", zero.quads)
        .updates("QuadDraw", zero.draw)
        .fixes("tile_edge", edge)
        .fixes("slices_to_zero", static_cast<float>(slices_to_zero(params)))
        .fixes("farthest_offset", images.facts->farthest_depth_offset())
        .fixes("reach", volume.divisor == 1 ? 0u : 1u)
        .fixes("draws_quads", draws_quads(params) ? 1u : 0u)
        .groups(tiles);
    return zero;
}

constexpr const char* culling_depth_name = "depth that culls";

void draw_zero_depth(Graph& graph, Image& depth, const ZeroTiles& zero, const VoxelParams& params) {
    if (draws_quads(params)) {
        graph.draw("transparency/voxel/zero_depth/quads", DrawList{zero.draw, zero.draw, 0, 1})
            .loads("Quads", zero.quads)
            .fixes("tile_edge", zero.edge)
            .writes_depth(depth);
    } else {
        graph.fullscreen("transparency/voxel/zero_depth/full_screen")
            .samples("zero_depth", zero.depth)
            .fixes("tile_edge", zero.edge)
            .writes_depth(depth);
    }
}

Image counted_fragments(Graph& graph, const FrameImages& images, const std::string& name) {
    Image layers = graph.create(name, Shape{.extent = images.extent, .format = Format::r32ui, .layers = images.samples});
    graph.clear(layers, {});
    for (const DrawList& list : drawn_at(images, Resolution::full))
        draw_fragments(graph, "transparency/count_layers", list, images).updates("layers", layers);
    return layers;
}

}  // namespace

Image culled_depth(Graph& graph, const FrameImages& images, const Volume& volume, const VoxelParams& params) {
    const bool has_interfaces = images.features->has(Feature::interface_layers);
    if (params.culling == culling_off || has_interfaces || drawn_at(images, Resolution::full).empty()) return images.depth;
    const ZeroTiles zero = zero_tiles(graph, images, volume, params);
    Image depth = graph.create(culling_depth_name, graph.shape(images.depth));
    graph.copy(images.depth, depth);
    draw_zero_depth(graph, depth, zero, params);
    return depth;
}

bool is_made_before_opaque(const VoxelParams& params, const Features& features) {
    return params.prepared == prepared_before_opaque && params.culling != culling_off && params.splat != splat_multiply &&
           !features.has(Feature::soft_particles) && !features.has(Feature::distortion) &&
           !features.has(Feature::interface_layers);
}

Image depth_to_draw_opaque_into(Graph& graph, const FrameImages& images, const Volume& volume, const VoxelParams& params) {
    const ZeroTiles zero = zero_tiles(graph, images, volume, params);
    Image depth =
        graph.create(culling_depth_name, Shape{.extent = images.extent, .format = Format::d32f, .samples = images.samples});
    graph.clear(depth, {});
    draw_zero_depth(graph, depth, zero, params);
    return depth;
}

Image earlier_culled_depth(const Graph& graph) { return graph.find_image(culling_depth_name); }

Image zero_depth_view(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    const ZeroTiles zero = zero_tiles(graph, images, integrated_volume(graph, images, params), params);
    Image picture = graph.create("zero depth view", Shape{.extent = images.extent, .format = Format::rgba32f});
    graph.compute("transparency/voxel/views/zero_depth_view.comp")
        .samples("zero_depth", zero.depth)
        .stores("picture", picture)
        .fixes("tile_edge", zero.edge)
        .over(images.extent);
    return picture;
}

Image culled_view(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    FrameImages culled = images;
    culled.depth = culled_depth(graph, images, integrated_volume(graph, images, params), params);
    const Image drawn = counted_fragments(graph, images, "fragments drawn"),
                shaded = counted_fragments(graph, culled, "fragments shaded");
    const Image depth = spread(graph, culled.depth, "depth that culls, by sample");
    Image picture = graph.create("culled view", Shape{.extent = images.extent, .format = Format::rgba32f});
    graph.compute("transparency/voxel/views/culled_view.comp")
        .samples("drawn", drawn)
        .samples("shaded", shaded)
        .samples("opaque", images.depth_layers)
        .samples("culling", depth)
        .stores("picture", picture)
        .over(images.extent);
    return picture;
}

}  // namespace strata::transparency
