#include "passes/transparency/voxel/volume/volume.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/scene_facts.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/voxel/factors/factors.h"
#include "passes/transparency/voxel/slices/depth_curve.h"
#include "passes/transparency/voxel/sparse/sparse.h"
#include "passes/transparency/voxel/volume/color_column.h"
#include "passes/transparency/voxel/volume/column.h"
#include "passes/transparency/voxel/volume/dimensions.h"

namespace strata::transparency {
namespace {

/// All but the interfaces.
VoxelPush push_of(const VoxelParams& params, const DepthCurve& curve, const Extent& low, std::uint32_t channels) {
    ColumnFormat format = column_format(params);
    if (is_sparse(params)) format.slices = static_cast<std::uint32_t>(curve.slices);
    const double range = curve.farthest - curve.nearest;
    return {.nearest = static_cast<float>(curve.nearest),
            .per_linear = static_cast<float>(1 / curve.linear),
            .slices_per_log2 = static_cast<float>(curve.slices / std::log2(1 + range / curve.linear)),
            .finest_slices = static_cast<std::uint32_t>(curve.slices),
            .slices = format.slices,
            .words = format.words(),
            .width = low.width,
            .height = low.height,
            .channels = channels,
            .full_code = format.full_code,
            .codes_per_depth = static_cast<float>(format.codes_per_depth()),
            .bias = static_cast<float>(sampling_bias(params.sampling)) + params.shift,
            .color_codes_per_depth = static_cast<float>(color_format(params).codes_per_depth()),
            .color_scale = color_scale(format),
            .interfaces = 0};
}

std::uint32_t flag(bool set) { return set ? 1u : 0u; }

/// What multiplies puts a triangle's fragments where the triangle's center is, which is not where tiles know of it.
bool skips(const VoxelParams& params) { return is_sparse(params) || (params.skipping != 0 && params.splat != splat_multiply); }

Buffer zeros(Graph& graph, const char* name, std::uint64_t words) {
    Buffer buffer = graph.create(name, words * sizeof(std::uint32_t));
    graph.clear(buffer, 0);
    return buffer;
}

/// To a step that knows where slices are.
template <typename Builder>
Builder& bind_warp(const Volume& volume, const VoxelParams& params, Builder&& builder) {
    return builder.loads("DepthWarp", volume.warp)
        .fixes("adaptive", flag(is_adaptive(params)))
        .fixes("sparse", flag(is_sparse(params)));
}

/// To a step that knows how slices lie in words.
template <typename Builder>
Builder& bind_format(const Volume& volume, Builder&& builder) {
    return builder.fixes("field_bits", volume.field_bits).fixes("packs_colors", flag(volume.packs)).push(volume.push);
}

/// To a step that knows what is in a column.
template <typename Builder>
Builder& bind_columns(Volume& volume, const VoxelParams& params, Builder&& builder) {
    return bind_format(volume, builder).updates("Overflow", volume.overflow).fixes("splat", params.splat);
}

/// To a step over tiles of columns.
ComputeStep& bind_tiles(Volume& volume, const VoxelParams& params, ComputeStep& builder) {
    return bind_warp(volume, params, bind_columns(volume, params, builder))
        .updates("Tiles", volume.tiles)
        .fixes("skips", flag(skips(params)));
}

/// A step with a row of groups for each transparent draw, each for so many of its triangles at a time.
ComputeStep over_triangles(Graph& graph, const FrameImages& images, const char* shader, std::uint32_t triangles_per_group) {
    std::uint32_t most = 1;
    for (const std::uint32_t index : images.facts->lists().transparent)
        most = std::max(most, triangles_drawn(*images.recorded, index));
    const std::uint32_t groups = std::min((most + triangles_per_group - 1) / triangles_per_group, 1024u);
    const DrawList& list = images.transparent;
    ComputeStep builder = graph.compute(shader);
    builder.loads("Commands", list.commands)
        .loads("Indices", list.indices)
        .fixes("first_command", list.first)
        .groups({groups, std::max(list.count, 1u), 1});
    return builder;
}

void find_slices(Graph& graph, const FrameImages& images, const VoxelParams& params, Volume& volume) {
    Buffer halves = zeros(graph, "voxel coverage", 2 * most_virtual_slices / 32);
    over_triangles(graph, images, "transparency/voxel/slices/coverage.comp", 64)
        .updates("Halves", halves)
        .fixes("thickness", volume.thickness)
        .push(volume.push);
    constexpr std::uint64_t bytes = sizeof(VoxelHistory);
    Buffer history = params.hysteresis > 0 ? graph.remember("voxel history", bytes) : graph.create("no history", bytes);
    graph.compute("transparency/voxel/slices/warp.comp")
        .stores("DepthWarp", volume.warp)
        .push(volume.push)
        .loads("Halves", halves)
        .updates("History", history)
        .fixes("splatting", params.splatting)
        .fixes("hysteresis", params.hysteresis)
        .groups({1, 1, 1});
}

void find_tiles(Graph& graph, const FrameImages& images, const VoxelParams& params, Volume& volume) {
    ComputeStep builder = over_triangles(graph, images, "transparency/voxel/volume/tiles.comp", 1);
    bind_warp(volume, params, bind_format(volume, builder))
        .updates("Tiles", volume.tiles)
        .fixes("thickness", volume.thickness)
        .fixes("splatting", params.splatting)
        .fixes("sampling", params.sampling);
}

constexpr const char* voxels_name = "voxels";
constexpr const char* warp_name = "depth warp";

/// The tiles' marks must have been found.
void give_blocks(Graph& graph, const VoxelParams& params, Volume& volume) {
    const Extent columns{volume.push.width, volume.push.height};
    const std::uint64_t table = sparse_notes(params, volume.push.finest_slices, columns).table;
    volume.warp = graph.create(warp_name, sizeof(WarpHeader) + table * sizeof(std::uint32_t));
    graph.compute("transparency/voxel/sparse/blocks.comp")
        .updates("Tiles", volume.tiles)
        .stores("DepthWarp", volume.warp)
        .push(volume.push)
        .fixes("field_bits", volume.field_bits)
        .fixes("pool_blocks", pool_blocks(params))
        .groups(voxel_tiles(columns));
}

/// Soft particles of the world are as deep as they fade over before opaque surfaces.
DepthRange range_of(const VoxelParams& params, const SceneFacts& facts) {
    const Frame& frame = facts.frame();
    float deepest = 0;
    if (has_segments(params))
        for (const std::uint32_t index : facts.lists().transparent) {
            if (index < frame.draws.size()) continue;
            const Emitter& emitter = frame.emitters[index - frame.draws.size()];
            if (emitter.layer == 0) deepest = std::max(deepest, emitter.soft_depth_fade);
        }
    return voxel_range(params, facts.world_depths(), double(deepest), frame.view.near);
}

/// All but images and buffers.
Volume described(const FrameImages& images, const VoxelParams& params) {
    const std::uint32_t channels = channel_count(params.channels, *images.features);
    const VoxelParams all = of_volume(params, *images.facts), world = of_world(params, *images.facts);
    const std::uint32_t divisor = voxel_divisor(all, images.extent, channels);
    const Extent columns = prepass_extent(images.extent, divisor);
    const DepthRange range = range_of(params, *images.facts);
    const DepthCurve curve = is_sparse(params) ? sparse_curve(params, range, columns) : depth_curve(world, range);
    Volume volume{.divisor = divisor,
                  .field_bits = column_format(params).field_bits,
                  .packs = packs_colors(params, channels),
                  .push = push_of(all, curve, columns, channels)};
    volume.push.interfaces = all.slices - world.slices;
    const bool is_thick = has_segments(params) && images.features->has(Feature::soft_particles);
    volume.thickness = is_thick ? thickness_segment : thickness_point;
    return volume;
}

void create_parts(Graph& graph, const VoxelParams& params, Volume& volume) {
    const VoxelPush& push = volume.push;
    const std::uint32_t planes = volume.packs ? 1 : push.channels, sources = volume.packs ? 2 : 1;
    const std::uint64_t texels = std::uint64_t{push.width} * push.height;
    const Extent tiles = voxel_tiles({push.width, push.height});
    const std::uint64_t noted = params.splat == splat_overflow_minimum ? texels * (volume.packs ? 4 : planes) : 1;
    const std::uint64_t marks = is_sparse(params)
                                    ? sparse_notes(params, push.finest_slices, {push.width, push.height}).marks
                                    : std::uint64_t{sources} * tiles.width * tiles.height * ((push.words + 31) / 32);
    constexpr std::uint64_t header = sizeof(WarpHeader) / sizeof(std::uint32_t), entries = most_virtual_slices;
    const std::uint64_t warp = is_adaptive(params) ? header + entries + params.slices : header + 1;
    const auto words_of = [&](std::uint32_t channels, std::uint32_t layers) {
        return Shape{.extent = {push.width, push.height * channels}, .format = Format::r32ui, .layers = layers};
    };
    constexpr std::uint32_t across = pool_blocks_across * tile_size;
    const Shape pool{.extent = {across, across}, .format = Format::r32ui, .layers = params.pool};
    const auto in_columns = [&] { return words_of(planes, voxel_words(params, push.channels) / planes); };
    volume.voxels = graph.create(voxels_name, is_sparse(params) ? pool : in_columns());
    volume.overflow = graph.create("nearest overflow", noted * sizeof(std::uint32_t));
    if (!volume.warp) volume.warp = zeros(graph, is_sparse(params) ? "no depth warp" : warp_name, warp);
    volume.tiles = zeros(graph, "voxel tiles", skips(params) ? marks : 1);
    volume.zero_slices = graph.create("zero slices", words_of(push.channels, 1));
}

DrawStep fragments_of_columns(Graph& graph, const FrameImages& images, const VoxelParams& params, std::uint32_t divisor) {
    const std::string shader = "transparency/voxel/volume/splat";
    if (images.depth) {
        const FrameImages low = prepass_images(graph, images, divisor);
        return draw_fragments(graph, shader, drawn_triangles(low, params), low);
    }
    FrameImages low = images;
    low.extent = prepass_extent(images.extent, divisor);
    low.samples = 1;
    return draw_fragments_untested(graph, shader, drawn_triangles(low, params), low).within(low.extent);
}

void splat_codes(Graph& graph, const FrameImages& images, const VoxelParams& params, Volume& volume) {
    bind_warp(volume, params, bind_columns(volume, params, fragments_of_columns(graph, images, params, volume.divisor)))
        .updates("voxels", volume.voxels)
        .fixes("thickness", volume.thickness)
        .fixes("splatting", params.splatting)
        .fixes("rounding", params.rounding)
        .fixes("tells_helpers", tells_helpers(images));
}

}  // namespace

const DrawList& drawn_triangles(const FrameImages& images, const VoxelParams& params) {
    return params.rounding == rounding_stochastic ? images.numbered : images.transparent;
}

Volume earlier_volume(const Graph& graph, const FrameImages& images, const VoxelParams& params) {
    Volume volume = described(images, params);
    volume.voxels = graph.find_image(voxels_name);
    volume.warp = graph.find_buffer(warp_name);
    return volume;
}

Volume integrated_volume(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    Volume volume = described(images, params);
    // A frame's history moves on once, however many volumes are made to be looked at.
    if (params.hysteresis > 0) volume.warp = graph.find_buffer(warp_name);
    const bool finds = is_adaptive(params) && !volume.warp;
    create_parts(graph, of_volume(params, *images.facts), volume);
    const Extent columns{volume.push.width, volume.push.height, volume.packs ? 1 : volume.push.channels};

    if (finds) find_slices(graph, images, params, volume);
    if (skips(params)) find_tiles(graph, images, params, volume);
    if (is_sparse(params)) give_blocks(graph, params, volume);
    ComputeStep clear = graph.compute("transparency/voxel/volume/clear.comp");
    bind_tiles(volume, params, clear).stores("voxels", volume.voxels).over(columns);
    if (params.splat == splat_multiply) splat_factors(graph, prepass_images(graph, images, volume.divisor), params, volume);
    else splat_codes(graph, images, params, volume);
    ComputeStep integrate = graph.compute(volume.packs ? "transparency/voxel/volume/integrate_colors.comp"
                                                       : "transparency/voxel/volume/integrate.comp");
    bind_tiles(volume, params, integrate)
        .updates("voxels", volume.voxels)
        .stores("zero_slices", volume.zero_slices)
        .over(columns);
    return volume;
}

DrawStep& read_volume(DrawStep& draw, const Volume& volume, const VoxelParams& params, Resolution drawn) {
    return bind_warp(volume, params, bind_format(volume, draw))
        .samples("voxels", volume.voxels)
        .fixes("filters", flag(volume.divisor > 1 || drawn == Resolution::low))
        .fixes("sampling", params.sampling)
        .fixes("thickness", volume.thickness)
        .fixes("splatting", params.splatting)
        .fixes("rounding", params.rounding);
}

ComputeStep& read_slices(ComputeStep& builder, const Volume& volume, const VoxelParams& params) {
    return bind_warp(volume, params, builder).push(volume.push);
}

double slices_to_zero(const VoxelParams& params) {
    constexpr double by_sampling[] = {1, 2.5, 4};
    return by_sampling[params.sampling] - double(params.shift);
}

ComputeStep& look_into(ComputeStep& builder, Volume& volume, const VoxelParams& params) {
    return bind_tiles(volume, params, builder).samples("voxels", volume.voxels);
}

}  // namespace strata::transparency
