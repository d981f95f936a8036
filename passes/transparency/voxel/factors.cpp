#include "passes/transparency/voxel/factors.h"

#include <cmath>

#include "passes/reference/triangles.h"
#include "passes/transparency/event_draw.h"
#include "passes/transparency/function_model.h"
#include "passes/transparency/voxel/sparse.h"

namespace strata::transparency {
namespace {

constexpr Format grey_formats[] = {Format::r8_unorm, Format::r16_unorm, Format::r16_unorm, Format::r32f};
constexpr Format color_formats[] = {Format::rgba8_unorm, Format::rgba16_unorm, Format::rgba16_unorm, Format::rgba32f};

/// The list with its places as indices: see splat_multiply.vert.
DrawList by_place(Graph& graph, DrawList list) {
    constexpr std::uint32_t row = 4096;  // in groups of 64: a dispatch has 65535 along an axis
    Buffer places = graph.create("places of indices", graph.record(list.indices).bytes);
    const auto count = static_cast<std::uint32_t>(graph.record(places).bytes / sizeof(std::uint32_t));
    graph.compute("transparency/voxel/places.comp").stores("Places", places).over({row, (count + row - 1) / row});
    list.indices = places;
    return list;
}

/// Of all three corners.
double mean_depth(const Frame& frame, const DrawSpace& space, std::uint32_t draw, std::uint32_t triangle) {
    const Corners corners = view_corners(frame, space, draw, triangle);
    const double offset = attributes_at(frame, draw, triangle, glm::dvec3(1. / 3)).depth_offset;
    return (corners[0].z + corners[1].z + corners[2].z) / 3 - offset;
}

}  // namespace

void splat_factors(Graph& graph, const FrameImages& low, const VoxelParams& params, Volume& volume) {
    const VoxelPush& push = volume.push;
    const Format format = push.channels == 1 ? grey_formats[params.bits] : color_formats[params.bits];
    Image factors = graph.create("factors", Shape{.extent = low.extent, .format = format, .layers = push.slices});
    graph.clear(factors, {{1, 1, 1, 1}});
    const bool by_vertex = has(low.capabilities, Capability::shader_output_layer);
    const DrawList list = by_vertex ? by_place(graph, low.transparent) : low.transparent;
    DrawPass draw = draw_events_untested(graph, "transparency/voxel/splat_multiply", list, low);
    if (!by_vertex) draw.geometry("transparency/voxel/choose_slice");
    draw.multiplies(factors).loads("DepthWarp", volume.warp).fixes("adaptive", is_adaptive(params) ? 1u : 0u).push(push);
    const Extent columns = graph.shape(volume.voxels).extent;
    graph.compute("transparency/voxel/factors_to_codes.comp")
        .samples("factors", factors)
        .stores("voxels", volume.voxels)
        .fixes("field_bits", volume.field_bits)
        .push(push)
        .over({columns.width, columns.height, push.words});
}

double multiplied(double stored, double factor, std::uint32_t bits) {
    if (bits == bits_32) return stored * factor;
    const double most = bits == bits_8 ? 255 : 65535;
    const auto to_code = [most](double x) { return std::nearbyint(x * most) / most; };
    return to_code(stored * to_code(factor));
}

std::vector<double> depths_of_triangles(const Frame& frame) {
    std::vector<double> depths;
    for (const std::uint32_t draw : transparent_draws(frame)) {
        const DrawSpace space = draw_space(frame, draw);
        for (std::uint32_t triangle = 0; triangle < triangle_count(frame, draw); ++triangle)
            depths.push_back(mean_depth(frame, space, draw, triangle));
    }
    return depths;
}

std::vector<Multiplication> multiplications(std::span<const Fragment> fragments, std::span<const std::uint32_t> slices,
                                            std::size_t channel, std::size_t channels) {
    std::vector<Multiplication> all;
    for (const Fragment& f : fragments) all.push_back({slices[f.submission], std::exp(-channel_depth(f, channel, channels))});
    return all;
}

Column column_of_factors(const ColumnFormat& format, std::span<const Multiplication> multiplications, std::uint32_t bits) {
    std::vector<double> factors(format.slices, 1);
    for (const Multiplication& m : multiplications) factors[m.slice] = multiplied(factors[m.slice], m.factor, bits);
    Column column(format);
    for (std::uint32_t slice = 0; slice < format.slices; ++slice)
        column.add(split_code(format, {slice}, format.codes(optical_depth_in_double(factors[slice])), .5));
    return column;
}

}  // namespace strata::transparency
