#include "passes/transparency/voxel/volume.h"

#include <algorithm>
#include <cmath>

#include "passes/reference/triangles.h"
#include "passes/transparency/event_draw.h"
#include "passes/transparency/function_prepass.h"
#include "passes/transparency/voxel/column.h"
#include "passes/transparency/voxel/depth_curve.h"
#include "passes/transparency/voxel/factors.h"
#include "passes/transparency/voxel/model.h"

namespace strata::transparency {
namespace {

VoxelPush push_of(const VoxelParams& params, const DepthCurve& curve, const Extent& low, std::uint32_t channels) {
    const ColumnFormat format = column_format(params);
    const double range = curve.farthest - curve.nearest;
    return {.nearest = static_cast<float>(curve.nearest),
            .per_linear = static_cast<float>(1 / curve.linear),
            .slices_per_log2 = static_cast<float>(curve.slices / std::log2(1 + range / curve.linear)),
            .finest_slices = static_cast<std::uint32_t>(curve.slices),
            .slices = params.slices,
            .words = format.words(),
            .width = low.width,
            .height = low.height,
            .channels = channels,
            .full_code = format.full_code,
            .codes_per_depth = static_cast<float>(format.codes_per_depth()),
            .bias = static_cast<float>(sampling_bias(params.sampling)) + params.shift};
}

std::uint32_t flag(bool set) { return set ? 1u : 0u; }

/// What multiplies puts a triangle's fragments where the triangle's center is, which is not where tiles know of it.
bool skips(const VoxelParams& params) { return params.skipping != 0 && params.splat != splat_multiply; }

Buffer zeros(Graph& graph, const char* name, std::uint64_t words) {
    Buffer buffer = graph.create(name, words * sizeof(std::uint32_t));
    graph.clear(buffer, 0);
    return buffer;
}

/// To a step that knows where slices are.
template <typename Pass>
Pass& bind_warp(const Volume& volume, const VoxelParams& params, Pass&& pass) {
    return pass.loads("DepthWarp", volume.warp).fixes("adaptive", flag(params.volume == volume_adaptive));
}

/// To a step that knows what is in a column.
template <typename Pass>
Pass& bind_columns(Volume& volume, const VoxelParams& params, Pass&& pass) {
    return pass.updates("Overflow", volume.overflow)
        .fixes("splat", params.splat)
        .fixes("field_bits", volume.field_bits)
        .push(volume.push);
}

/// To a step over tiles of columns.
ComputePass& bind_tiles(Volume& volume, const VoxelParams& params, ComputePass& pass) {
    return bind_columns(volume, params, pass).updates("Tiles", volume.tiles).fixes("skips", flag(skips(params)));
}

/// A step with a row of groups for each transparent draw, for at most `groups` of its triangles at once.
ComputePass over_triangles(Graph& graph, const FrameImages& images, const char* shader, std::uint32_t triangles_per_group) {
    std::uint32_t most = 1;
    for (const std::uint32_t draw : transparent_draws(*images.recorded))
        most = std::max(most, triangle_count(*images.recorded, draw));
    const std::uint32_t groups = std::min((most + triangles_per_group - 1) / triangles_per_group, 1024u);
    const DrawList& list = images.transparent;
    ComputePass pass = graph.compute(shader);
    pass.loads("Commands", list.commands)
        .loads("Indices", list.indices)
        .fixes("first_command", list.first)
        .groups({groups, std::max(list.count, 1u), 1});
    return pass;
}

void find_slices(Graph& graph, const FrameImages& images, const VoxelParams& params, Volume& volume) {
    Buffer halves = zeros(graph, "voxel coverage", 2 * most_virtual_slices / 32);
    over_triangles(graph, images, "transparency/voxel/coverage.comp", 64).updates("Halves", halves).push(volume.push);
    graph.compute("transparency/voxel/warp.comp")
        .stores("DepthWarp", volume.warp)
        .push(volume.push)
        .loads("Halves", halves)
        .fixes("splatting", params.splatting)
        .groups({1, 1, 1});
}

void find_tiles(Graph& graph, const FrameImages& images, const VoxelParams& params, Volume& volume) {
    ComputePass pass = over_triangles(graph, images, "transparency/voxel/tiles.comp", 1);
    bind_warp(volume, params, pass)
        .push(volume.push)
        .updates("Tiles", volume.tiles)
        .fixes("field_bits", volume.field_bits)
        .fixes("splatting", params.splatting)
        .fixes("sampling", params.sampling);
}

Volume create_volume(Graph& graph, const VoxelParams& params, const Extent& low, const DepthCurve& curve,
                     std::uint32_t channels) {
    const ColumnFormat format = column_format(params);
    const Extent columns{low.width, low.height * channels};
    const auto tiles_along = [](std::uint32_t length) { return std::uint64_t{(length + tile_size - 1) / tile_size}; };
    const std::uint64_t noted = params.splat == splat_overflow_minimum ? std::uint64_t{columns.width} * columns.height : 1;
    const std::uint64_t marks = tiles_along(low.width) * tiles_along(low.height) * ((format.words() + 31) / 32);
    constexpr std::uint64_t header = sizeof(WarpHeader) / sizeof(std::uint32_t), entries = most_virtual_slices;
    const std::uint64_t warp = params.volume == volume_adaptive ? header + entries + params.slices : header + 1;
    return {.voxels = graph.create("voxels", Shape{.extent = columns, .format = Format::r32ui, .layers = format.words()}),
            .overflow = graph.create("nearest overflow", noted * sizeof(std::uint32_t)),
            .warp = zeros(graph, "depth warp", warp),
            .tiles = zeros(graph, "voxel tiles", skips(params) ? marks : 1),
            .field_bits = format.field_bits,
            .push = push_of(params, curve, low, channels)};
}

void splat_codes(Graph& graph, const FrameImages& low, const VoxelParams& params, Volume& volume) {
    bind_warp(volume, params, bind_columns(volume, params, draw_events(graph, "transparency/voxel/splat", low.transparent, low)))
        .updates("voxels", volume.voxels)
        .fixes("splatting", params.splatting)
        .fixes("rounding", params.rounding);
}

}  // namespace

Volume integrated_volume(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    const std::uint32_t channels = channel_count(params.channels, *images.features);
    const std::uint32_t divisor = voxel_divisor(params, images.extent, channels);
    const FrameImages low = prepass_images(graph, images, divisor);
    const DepthCurve curve = depth_curve(params, voxel_range(params, *images.recorded));
    Volume volume = create_volume(graph, params, low.extent, curve, channels);
    volume.divisor = divisor;
    const Extent columns{low.extent.width, low.extent.height, channels};

    if (params.volume == volume_adaptive) find_slices(graph, images, params, volume);
    if (skips(params)) find_tiles(graph, images, params, volume);
    ComputePass clear = graph.compute("transparency/voxel/clear.comp");
    bind_tiles(volume, params, clear).stores("voxels", volume.voxels).over(columns);
    if (params.splat == splat_multiply) splat_factors(graph, low, params, volume);
    else splat_codes(graph, low, params, volume);
    ComputePass integrate = graph.compute("transparency/voxel/integrate.comp");
    bind_tiles(volume, params, integrate).updates("voxels", volume.voxels).over(columns);
    return volume;
}

DrawPass& read_volume(DrawPass& draw, const Volume& volume, const VoxelParams& params) {
    return bind_warp(volume, params, draw)
        .samples("voxels", volume.voxels)
        .push(volume.push)
        .fixes("field_bits", volume.field_bits)
        .fixes("sampling", params.sampling);
}

Image volume_view(Graph& graph, const FrameImages& images, const VoxelParams& params, std::uint32_t shown) {
    // From the integral being full in one slice to all that a read weighs being full (transparency chapter 6.9).
    constexpr float empty_in_front[] = {1, 2.5, 4};
    Volume volume = integrated_volume(graph, images, params);
    Image picture = graph.create("voxel view", Shape{.extent = images.extent, .format = Format::rgba32f});
    ComputePass pass = graph.compute("transparency/voxel/view.comp");
    bind_warp(volume, params, bind_tiles(volume, params, pass))
        .samples("voxels", volume.voxels)
        .stores("picture", picture)
        .fixes("shown", shown)
        .fixes("empty_in_front", empty_in_front[params.sampling] - params.shift)
        .over(images.extent);
    return picture;
}

}  // namespace strata::transparency
