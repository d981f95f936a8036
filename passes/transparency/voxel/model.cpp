#include "passes/transparency/voxel/model.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "capture_format/frame/frame.h"
#include "capture_format/frame_features.h"
#include "passes/reference/ordering.h"
#include "passes/reference/triangles.h"
#include "passes/shaders/hash.shared.h"
#include "passes/stage_input.h"
#include "passes/transparency/functions/model.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/voxel/factors/model.h"
#include "passes/transparency/voxel/slices/depth_curve.h"
#include "passes/transparency/voxel/slices/depth_warp_model.h"
#include "passes/transparency/voxel/sparse/sparse_model.h"
#include "passes/transparency/voxel/thick_fragments/segment_model.h"
#include "passes/transparency/voxel/volume/color_column.h"
#include "passes/transparency/voxel/volume/column.h"
#include "passes/transparency/voxel/zero_depth/zero_depth.h"

namespace strata::transparency {
namespace {

/// Whether three channels share a word (docs/algorithms/transparency.md 6.4): only where words are sums, and not in a sparse
/// volume.
bool shares_words(const VoxelParams& params, std::uint32_t channels) {
    const bool adds_in_fields = params.splat != splat_words && params.splat != splat_multiply;
    return channels == 3 && params.packing == packing_rgb10 && adds_in_fields && params.volume != volume_sparse;
}

/// What a column takes (docs/algorithms/transparency.md 6.4): planes of words of 32 bits with 4, 3 or 2 slices of 8, 10 or 16
/// bits each, or one. Where three channels share words there is a word for every slice, and a plane of what is gray.
std::uint64_t bytes_of_column(const VoxelParams& params, std::uint32_t channels) {
    static constexpr std::uint32_t slices_of_a_word[] = {4, 3, 2, 1};
    const std::uint32_t together = params.splat == splat_words ? 1 : slices_of_a_word[params.bits];
    const std::uint64_t plane = 4 * ((params.slices + together - 1) / together);
    return shares_words(params, channels) ? 4 * params.slices + plane : channels * plane;
}

/// The frame's volume, by the numbers of docs/algorithms/transparency.md and not by what the device is given
/// (volume/dimensions.h).
struct ModelVolume {
    VoxelParams params;  ///< slices: the world's, behind those of interface layers
    std::uint32_t interfaces = 0, divisor = 1;
    Extent columns;

    VoxelParams of_world() const {
        VoxelParams world = params;
        world.slices -= interfaces;
        return world;
    }
    /// At most 512 MiB; a sparse one's pool has a block of 256 bytes for each tile of 8 x 8 columns and each channel.
    bool fits(std::uint32_t channels) const {
        const std::uint64_t width = columns.width, height = columns.height, mebibyte = 1 << 20;
        if (is_sparse(params)) return (width + 7) / 8 * ((height + 7) / 8) * channels * 256 <= params.pool * mebibyte;
        return width * height * bytes_of_column(params, channels) <= 512 * mebibyte;
    }
};

ModelVolume model_volume(VoxelParams params, const Frame& frame, std::uint32_t channels) {
    ModelVolume volume{.params = params, .interfaces = highest_layer(frame), .columns = {}};
    // An interface layer is a slice, and blocks have none for them.
    volume.params.slices = std::min(params.slices + volume.interfaces, 1024u);
    if (volume.interfaces > 0 && params.volume == volume_sparse) volume.params.volume = volume_adaptive;
    const auto ceiled = [](std::uint32_t pixels, std::uint32_t divisor) { return (pixels + divisor - 1) / divisor; };
    for (volume.divisor = 1u << params.resolution;; volume.divisor *= 2) {
        volume.columns = {ceiled(frame.view.width, volume.divisor), ceiled(frame.view.height, volume.divisor)};
        if (volume.fits(channels)) return volume;
    }
}

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

const Origin& origin_of(std::span<const Origin> origins, const Fragment& f) {
    return *--std::ranges::upper_bound(origins, f.submission, {}, &Origin::first_triangle);
}

double rounding_of(const VoxelParams& params, std::span<const Origin> origins, const Fragment& f, glm::uvec2 texel) {
    if (params.rounding == rounding_nearest) return .5;
    const Origin& origin = origin_of(origins, f);
    return random_rounding(texel, origin.draw, f.submission - origin.first_triangle);
}

/// Of a column's channel, by slice.
using SumsOfSlices = std::function<double(std::size_t)>;

/// Depth to virtual slices, these to physical ones.
struct Slices {
    DepthCurve curve;
    DepthWarp warp;
    std::uint32_t interfaces = 0;  ///< slices in front

    /// Slice coordinate within the volume.
    double place_of(double depth) const {
        const double s = curve.slice_of(std::max(depth, curve.nearest)) * std::exp2(-double(warp.halvings));
        return std::min(s, warp.virtual_slices() - double(end_margin));
    }
    /// The physical slice of a virtual one, or the next in front that is there; -1: none is.
    int physical(int slice) const { return warp.physical(slice) + static_cast<int>(interfaces); }
    /// The first slice where there is none.
    std::uint32_t splatted(double place) const {
        return static_cast<std::uint32_t>(std::max(physical(static_cast<int>(place)), 0));
    }
    std::uint32_t of_layer(std::uint32_t layer) const { return interfaces - layer; }
    /// Of what is in front of an interface layer.
    double before(const SumsOfSlices& integral, std::uint32_t layer) const {
        return layer < interfaces ? integral(of_layer(layer) - 1) : 0;
    }
    double up_to(const SumsOfSlices& integral, int slice) const {
        const int there = physical(slice);
        return there < 0 ? 0 : integral(static_cast<std::size_t>(there));
    }
    DepthCurve curve_of_virtual() const {
        DepthCurve halved = curve;
        halved.slices = warp.virtual_slices();
        return halved;
    }
};

Slices slices_of(const VoxelParams& params, const Frame& frame) {
    const DepthCurve curve = depth_curve(params, voxel_range(params, frame));
    return {curve, depth_warp(params, frame, curve), highest_layer(frame)};
}

/// All virtual slices are there, tile by tile.
Slices sparse_slices_of(const VoxelParams& params, const Frame& frame, Extent columns, std::uint32_t channels) {
    Slices slices{.curve = sparse_curve(params, voxel_range(params, frame), columns), .warp = {}};
    const std::uint32_t halvings = sparse_halvings(params, frame, columns, channels);
    slices.warp = unwarped(static_cast<std::uint32_t>(slices.curve.slices) >> halvings);
    slices.warp.halvings = halvings;
    return slices;
}

/// Where sums rise, and by how much: place, rise, place, rise... Of thousands of slices few hold something. `slices` sums are a
/// channel's.
std::vector<double> rises_of(std::span<const double> sums, std::size_t slices) {
    std::vector<double> rises;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double rise = sums[i] - (i % slices == 0 ? 0 : sums[i - 1]);
        if (rise > 0) rises.insert(rises.end(), {double(i), rise});
    }
    return rises;
}

void add_rises(std::vector<double>& sum, std::span<const double> rises, double share) {
    for (std::size_t i = 0; i < rises.size(); i += 2) sum.insert(sum.end(), {rises[i], share * rises[i + 1]});
}

double risen(std::span<const double> rises, std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = 0; i < rises.size(); i += 2)
        if (rises[i] >= double(first) && rises[i] <= double(last)) sum += rises[i + 1];
    return sum;
}

/// By Fragment::submission, what each triangle is multiplied into.
std::vector<std::uint32_t> slices_of_triangles(const Frame& frame, const Slices& slices) {
    std::vector<std::uint32_t> all;
    for (const double depth : depths_of_triangles(frame)) all.push_back(slices.splatted(slices.place_of(depth)));
    for (const Origin& origin : origins_of(frame)) {
        const std::uint32_t layer = layer_of(frame, origin.draw);
        if (layer > 0)
            std::fill_n(all.begin() + origin.first_triangle, triangle_count(frame, origin.draw), slices.of_layer(layer));
    }
    return all;
}

/// Fills columns from the fragments of a texel.
struct Splatter {
    const Frame* frame;
    VoxelParams params;
    std::size_t channels;
    bool packs;  ///< colors, three to a word
    Slices slices;
    std::vector<Origin> origins;
    std::vector<std::uint32_t> of_triangles;  ///< with splat_multiply

    SlicePlace place_of(const Fragment& f) const {
        if (f.layer > 0) return {slices.of_layer(f.layer)};
        SlicePlace place = slice_place(slices.place_of(f.depth), slices.warp.virtual_slices(), params.splatting);
        place.slice = slices.splatted(place.slice);
        return place;
    }

    SplitCode split(const ColumnFormat& format, const Fragment& f, glm::uvec2 texel, std::size_t channel) const {
        const SlicePlace place = place_of(f);
        const double codes = format.codes(channel_depth(f, channel, channels));
        return split_code(format, place, codes, rounding_of(params, origins, f, texel));
    }

    std::optional<Segment> segment_of(const Fragment& f) const {
        return segment_at(slices.curve_of_virtual(), f.depth, thickness_of(params, f), params.splatting);
    }

    /// Thick fragments are gray.
    double gray_codes(const Fragment& f, std::size_t channel) const {
        return column_format(params).codes(channel_depth(f, channel, channels));
    }

    void add(Column& column, const Fragment& f, glm::uvec2 texel, std::size_t channel) const {
        const std::optional<Segment> segment = segment_of(f);
        if (!segment) return column.add(split(column.format(), f, texel, channel));
        std::uint32_t slice = slices.splatted(segment->first);
        for (const std::uint32_t code : segment->codes_of_slices(gray_codes(f, channel), rounding_of(params, origins, f, texel)))
            column.add(slice++, code);
    }

    /// What is in front of a fragment, of a channel's integral.
    double codes_before(const Fragment& f, glm::uvec2 texel, std::size_t channel, const SumsOfSlices& integral) const {
        if (f.layer > 0) return slices.before(integral, f.layer);
        const std::optional<Segment> segment = segment_of(f);
        const ColumnFormat gray = column_format(params), format = packs ? color_format(params) : gray;
        const double codes = gray_codes(f, channel), rounding = rounding_of(params, origins, f, texel);
        const auto value = [&](int slice) {
            const double sum = slices.up_to(integral, slice);
            if (!segment) return sum;
            const std::uint32_t own =
                segment->code_behind(segment->first, codes, rounding) - segment->code_behind(slice + 1, codes, rounding);
            return without_own(format, sum, own * format.codes_per_depth() / gray.codes_per_depth());
        };
        const double at = slices.place_of(f.depth) + sampling_bias(params.sampling) + double(params.shift);
        return sampled_integral(value, at, params.sampling);
    }

    Column column_of(std::span<const Fragment> fragments, glm::uvec2 texel, std::size_t channel) const {
        const ColumnFormat format = column_format(params);
        if (params.splat == splat_multiply)
            return column_of_factors(format, multiplications(fragments, of_triangles, channel, channels), params.bits);
        Column column(format);
        for (const Fragment& f : fragments) add(column, f, texel, channel);
        return column;
    }

    /// Of the slices of a channel, then of those of the next.
    std::vector<double> planes(std::span<const Fragment> fragments, glm::uvec2 texel) const {
        std::vector<double> all;
        for (std::size_t channel = 0; channel < channels; ++channel) {
            const std::vector<std::uint32_t> integral = column_of(fragments, texel, channel).integral();
            all.insert(all.end(), integral.begin(), integral.end());
        }
        return all;
    }

    /// The same, of what is gray and of words of three channels.
    std::vector<double> packed(std::span<const Fragment> fragments, glm::uvec2 texel) const {
        Column gray(column_format(params));
        ColorColumn colors(color_format(params));
        for (const Fragment& f : fragments) {
            if (source_of(*frame, origin_of(origins, f).draw) == source_gray) {
                add(gray, f, texel, 0);
                continue;
            }
            glm::uvec3 nearer, farther;
            SplitCode code;
            for (int c = 0; c < 3; ++c) {
                code = split(color_format(params), f, texel, static_cast<std::size_t>(c));
                nearer[c] = code.nearer, farther[c] = code.farther;
            }
            colors.add(code.slice, nearer);
            if (farther != glm::uvec3(0)) colors.add(code.slice + 1, farther);
        }
        std::vector<double> all;
        const std::vector<glm::uvec3> integral = colors.integral(gray);
        for (int c = 0; c < 3; ++c)
            for (const glm::uvec3& sums : integral) all.push_back(sums[c]);
        return all;
    }
};

}  // namespace

double random_rounding(glm::uvec2 texel, std::uint32_t draw, std::uint32_t triangle) {
    // Pairs of triangles share a number: the halves of a particle meet without a seam.
    const std::uint32_t key = hashed(hashed(0, glm::uvec3(texel, draw)) ^ triangle / 2);
    return (key >> 8) * 0x1p-24;
}

ImageSet voxel_model(const StageInput& input, const Settings& settings) {
    const Features features = frame_features(input.frame);
    const auto asked = settings.as<VoxelParams>();
    const std::uint32_t channels = channel_count(asked.channels, features);
    const ModelVolume volume = model_volume(asked, input.frame, channels);
    VoxelParams params = volume.params;
    const bool packs = shares_words(params, channels), sparse = is_sparse(params);
    const Slices slices =
        sparse ? sparse_slices_of(params, input.frame, volume.columns, channels) : slices_of(volume.of_world(), input.frame);
    if (sparse) params.slices = slices.warp.virtual_slices();
    const ColumnFormat format = packs ? color_format(params) : column_format(params);
    Splatter splatter{&input.frame, params, channels, packs, slices, origins_of(input.frame), {}};
    if (params.splat == splat_multiply) splatter.of_triangles = slices_of_triangles(input.frame, slices);

    PrepassModel prepass{
        .divisor = volume.divisor, .unseen = Unseen::adds_nothing, .tint = channels == 1 ? params.tint : tint_total};
    if (is_made_before_opaque(params, features)) prepass.tested = PrepassModel::Tested::against_nothing;
    if (sparse) prepass.add = add_rises;
    prepass.project = [=, &splatter](std::span<const Fragment> fragments, glm::uvec2 texel) {
        if (sparse) return rises_of(splatter.planes(fragments, texel), format.slices);
        return packs ? splatter.packed(fragments, texel) : splatter.planes(fragments, texel);
    };
    prepass.function = [=, &splatter](std::span<const double> integrals, glm::uvec2 texel) -> Transmittance {
        return [=, &splatter](const Fragment& f) {
            glm::dvec3 through(0);
            for (std::size_t channel = 0; channel < channels; ++channel) {
                const std::size_t first = channel * format.slices;
                const SumsOfSlices integral = [&](std::size_t slice) {
                    return sparse ? risen(integrals, first, first + slice) : integrals[first + slice];
                };
                through[static_cast<int>(channel)] = format.transmittance(splatter.codes_before(f, texel, channel, integral));
            }
            return channels == 1 ? glm::dvec3(through.x) : through;
        };
    };
    return function_model(input, params.accumulation, prepass);
}

}  // namespace strata::transparency
