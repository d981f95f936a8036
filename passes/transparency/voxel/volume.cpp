#include "passes/transparency/voxel/volume.h"

#include <cmath>

#include "passes/transparency/event_draw.h"
#include "passes/transparency/function_prepass.h"
#include "passes/transparency/voxel/column.h"
#include "passes/transparency/voxel/depth_curve.h"
#include "passes/transparency/voxel/model.h"

namespace strata::transparency {
namespace {

VoxelPush push_of(const VoxelParams& params, const ColumnFormat& format, const Extent& low, std::uint32_t channels) {
    const DepthCurve curve = depth_curve(params);
    return {.per_linear = static_cast<float>(1 / curve.linear),
            .slices_per_log2 = static_cast<float>(curve.slices / std::log2(1 + curve.farthest / curve.linear)),
            .slices = params.slices,
            .width = low.width,
            .height = low.height,
            .channels = channels,
            .full_code = format.full_code,
            .codes_per_depth = static_cast<float>(format.codes_per_depth()),
            .bias = static_cast<float>(sampling_bias(params.sampling)) + params.shift};
}

/// To a step that knows of overflows, too.
template <typename Pass>
Pass& bind_overflow(Volume& volume, const VoxelParams& params, Pass&& pass) {
    return pass.updates("Overflow", volume.overflow)
        .fixes("splat", params.splat)
        .fixes("field_bits", volume.field_bits)
        .push(volume.push);
}

}  // namespace

Volume integrated_volume(Graph& graph, const FrameImages& images, const VoxelParams& params) {
    const ColumnFormat format = column_format(params);
    const std::uint32_t channels = channel_count(params.channels, *images.features);
    const std::uint32_t divisor = voxel_divisor(params, images.extent, channels);
    const FrameImages low = prepass_images(graph, images, divisor);
    const Extent columns{low.extent.width, low.extent.height * channels};
    const std::uint64_t noted = params.splat == splat_overflow_minimum ? std::uint64_t{columns.width} * columns.height : 1;
    Volume volume{.voxels = graph.create("voxels", Shape{.extent = columns, .format = Format::r32ui, .layers = format.words()}),
                  .overflow = graph.create("nearest overflow", noted * sizeof(std::uint32_t)),
                  .divisor = divisor,
                  .field_bits = format.field_bits,
                  .push = push_of(params, format, low.extent, channels)};
    graph.clear(volume.voxels, {});
    graph.clear(volume.overflow, no_overflow);
    bind_overflow(volume, params, draw_events(graph, "transparency/voxel/splat", low.transparent, low))
        .updates("voxels", volume.voxels)
        .fixes("splatting", params.splatting)
        .fixes("rounding", params.rounding);
    bind_overflow(volume, params, graph.compute("transparency/voxel/integrate.comp"))
        .updates("voxels", volume.voxels)
        .over(columns);
    return volume;
}

Image volume_view(Graph& graph, const FrameImages& images, const VoxelParams& params, std::uint32_t shown) {
    // From the integral being full in one slice to all that a read weighs being full (transparency chapter 6.9).
    constexpr float empty_in_front[] = {1, 2.5, 4};
    Volume volume = integrated_volume(graph, images, params);
    Image picture = graph.create("voxel view", Shape{.extent = images.extent, .format = Format::rgba32f});
    bind_overflow(volume, params, graph.compute("transparency/voxel/view.comp"))
        .samples("voxels", volume.voxels)
        .stores("picture", picture)
        .fixes("shown", shown)
        .fixes("empty_in_front", empty_in_front[params.sampling] - params.shift)
        .over(images.extent);
    return picture;
}

}  // namespace strata::transparency
