#include "passes/transparency/voxel/factors/model.h"

#include <cmath>

#include "passes/reference/triangles.h"
#include "passes/transparency/functions/model.h"

namespace strata::transparency {
namespace {

/// Of all three corners.
double mean_depth(const Frame& frame, const DrawSpace& space, std::uint32_t draw, std::uint32_t triangle) {
    const Corners corners = view_corners(frame, space, draw, triangle);
    const double offset = attributes_at(frame, draw, triangle, glm::dvec3(1. / 3)).depth_offset;
    return (corners[0].z + corners[1].z + corners[2].z) / 3 - offset;
}

}  // namespace

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
