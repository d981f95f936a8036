#include "passes/transparency/voxel/model.h"

#include <algorithm>
#include <cmath>

#include "passes/reference/triangles.h"
#include "passes/transparency/function_model.h"
#include "passes/transparency/function_prepass.h"
#include "passes/transparency/hash.shared.h"
#include "passes/transparency/voxel/column.h"
#include "passes/transparency/voxel/depth_curve.h"
#include "passes/transparency/voxel/depth_warp.h"
#include "passes/transparency/voxel/factors.h"

namespace strata::transparency {
namespace {

/// Where a draw's fragments begin among the numbers of all triangles.
struct Origin {
    std::uint32_t draw = 0, first_triangle = 0;
};

std::vector<Origin> origins_of(const Frame& frame) {
    std::vector<Origin> origins;
    std::uint32_t first = 0;
    for (const std::uint32_t draw : transparent_draws(frame)) {
        origins.push_back({draw, first});
        first += triangle_count(frame, draw);
    }
    return origins;
}

double rounding_of(const VoxelParams& params, std::span<const Origin> origins, const Fragment& f, glm::uvec2 texel) {
    if (params.rounding == rounding_nearest) return .5;
    const Origin& origin = *--std::ranges::upper_bound(origins, f.submission, {}, &Origin::first_triangle);
    return random_rounding(texel, origin.draw, f.submission - origin.first_triangle);
}

/// Depth to virtual slices, these to physical ones.
struct Slices {
    DepthCurve curve;
    DepthWarp warp;

    /// Slice coordinate within the volume.
    double place_of(double depth) const {
        const double s = curve.slice_of(std::max(depth, curve.nearest)) * std::exp2(-double(warp.halvings));
        return std::min(s, warp.virtual_slices() - double(end_margin));
    }
    /// The physical slice of a virtual one, or the next in front that is there.
    std::uint32_t physical(std::uint32_t slice) const {
        return static_cast<std::uint32_t>(std::max(warp.physical(static_cast<int>(slice)), 0));
    }
    double sampled(std::span<const double> integral, double at, std::uint32_t sampling) const {
        const auto value = [&](int slice) {
            const int physical = warp.physical(slice);
            return physical < 0 ? 0 : integral[static_cast<std::size_t>(physical)];
        };
        return sampled_integral(value, at, sampling);
    }
};

Slices slices_of(const VoxelParams& params, const Frame& frame) {
    const DepthCurve curve = depth_curve(params, voxel_range(params, frame));
    return {curve, depth_warp(params, frame, curve)};
}

/// By Fragment::submission, what each triangle is multiplied into.
std::vector<std::uint32_t> slices_of_triangles(const Frame& frame, const Slices& slices) {
    std::vector<std::uint32_t> all;
    for (const double depth : depths_of_triangles(frame))
        all.push_back(slices.physical(static_cast<std::uint32_t>(slices.place_of(depth))));
    return all;
}

}  // namespace

std::uint32_t voxel_divisor(const VoxelParams& params, Extent extent, std::uint32_t channels) {
    constexpr std::uint64_t largest = 512 << 20;
    std::uint32_t divisor = divisor_of(params.resolution);
    const auto bytes = [&](const Extent& low) {
        return std::uint64_t{low.width} * low.height * channels * column_format(params).words() * sizeof(std::uint32_t);
    };
    while (bytes(prepass_extent(extent, divisor)) > largest) divisor *= 2;
    return divisor;
}

double random_rounding(glm::uvec2 texel, std::uint32_t draw, std::uint32_t triangle) {
    // Pairs of triangles share a number: the halves of a particle meet without a seam.
    const std::uint32_t key = hashed(hashed(0, glm::uvec3(texel, draw)) ^ triangle / 2);
    return (key >> 8) * 0x1p-24;
}

ImageSet voxel_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<VoxelParams>();
    const std::size_t channels = channel_count(params.channels, frame_features(input.frame));
    const ColumnFormat format = column_format(params);
    const Slices slices = slices_of(params, input.frame);
    const std::vector<Origin> origins = origins_of(input.frame);
    const Extent extent{input.frame.view.width, input.frame.view.height};

    const std::vector<std::uint32_t> of_triangles = slices_of_triangles(input.frame, slices);
    PrepassModel prepass{.divisor = voxel_divisor(params, extent, static_cast<std::uint32_t>(channels))};
    prepass.project = [=, &origins, &of_triangles](std::span<const Fragment> fragments, glm::uvec2 texel) {
        std::vector<double> all;
        for (std::size_t channel = 0; channel < channels; ++channel) {
            Column column(format);
            const bool multiplies = params.splat == splat_multiply;
            if (multiplies)
                column = column_of_factors(format, multiplications(fragments, of_triangles, channel, channels), params.bits);
            for (const Fragment& f : multiplies ? std::span<const Fragment>{} : fragments) {
                SlicePlace place = slice_place(slices.place_of(f.depth), slices.warp.virtual_slices(), params.splatting);
                place.slice = slices.physical(place.slice);
                const double codes = format.codes(channel_depth(f, channel, channels));
                column.add(split_code(format, place, codes, rounding_of(params, origins, f, texel)));
            }
            const std::vector<std::uint32_t> integral = column.integral();
            all.insert(all.end(), integral.begin(), integral.end());
        }
        return all;
    };
    prepass.function = [=](std::span<const double> integrals, glm::uvec2) -> Transmittance {
        return [=](const Fragment& f) {
            const double at = slices.place_of(f.depth) + sampling_bias(params.sampling) + double(params.shift);
            glm::dvec3 through(0);
            for (std::size_t channel = 0; channel < channels; ++channel) {
                const auto integral = integrals.subspan(channel * format.slices, format.slices);
                through[static_cast<int>(channel)] = format.transmittance(slices.sampled(integral, at, params.sampling));
            }
            return channels == 1 ? glm::dvec3(through.x) : through;
        };
    };
    return function_model(input, params.accumulation, prepass);
}

}  // namespace strata::transparency
