#include "passes/transparency/wavelet/model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame_features.h"
#include "passes/reference/ordering.h"
#include "passes/stage_input.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/rounding.h"
#include "passes/transparency/wavelet/wavelet_params.h"

namespace strata::transparency {
namespace {

double noise(glm::uvec2 texel) { return double((texel.x * 3242174889u + texel.y * 2447445414u) >> 8) / 16777216 - .5; }

/// Of a texel: where its cells begin and end, in ln z, and how far they are shifted.
struct Cells {
    std::uint32_t count = 8;
    double first = 0, last = 1, jitter = 0;

    double place(double z) const {
        const double d = std::clamp((std::log(z) - first) / (last - first), 0., 1.);
        return std::clamp(d * (count - 1) + jitter * (1 - std::pow(2 * d - 1, 6)), 0., count - 1.);
    }
};

double depth_of(const Fragment& f, std::size_t channel, std::size_t channels) {
    return std::min(channel_depth(f, channel, channels), double(largest_wavelet_depth));
}

/// The whole frame's, or those of a texel's fragments.
Cells cells_of(const WaveletParams& params, const DepthRange& range, std::span<const Fragment> fragments, glm::uvec2 texel) {
    Cells cells{2u << params.rank, std::log(double(range.nearest)), std::log(double(range.farthest)),
                double(params.jitter) * noise(texel)};
    if (params.bounds == bounds_frame || fragments.empty()) return cells;
    const auto [nearest, farthest] = std::ranges::minmax_element(fragments, {}, &Fragment::depth);
    cells.first = std::log(nearest->depth) - double(bounds_margin);
    cells.last = std::log(farthest->depth) + double(bounds_margin);
    return cells;
}

}  // namespace

std::vector<double> haar_coefficients(std::uint32_t rank, std::span<const CellFragment> projected, std::optional<Rounding> half) {
    const std::size_t count = std::size_t{2} << rank;
    std::vector<double> coefficients(count, 0.);
    const auto add = [&](double& sum, double term) { sum = in_half(sum + term, half); };
    for (const CellFragment& fragment : projected) {
        if (fragment.optical_depth <= 0) continue;
        const double x = fragment.place / double(count);
        for (std::uint32_t p = 0; p <= rank; ++p) {
            const double wavelets = std::ldexp(1., int(p)), k = std::floor(x * wavelets);
            const double tent = std::min(x - k / wavelets, (k + 1) / wavelets - x);
            add(coefficients[(std::size_t{1} << p) - 1 + std::size_t(k)], fragment.optical_depth * std::sqrt(wavelets) * tent);
        }
        add(coefficients.back(), fragment.optical_depth * (1 - x));
    }
    return coefficients;
}

double haar_depth(std::span<const double> coefficients, double place) {
    const auto cell_value = [&](std::size_t cell) {
        double value = coefficients.back();
        for (std::size_t first = 1; 2 * first <= coefficients.size(); first *= 2) {
            const std::size_t width = coefficients.size() / first, k = cell / width;
            const double wavelet = std::sqrt(double(first)) * coefficients[first - 1 + k];
            value += cell % width < width / 2 ? -wavelet : wavelet;
        }
        return value;
    };
    const auto cell = std::size_t(place);
    const double before = cell > 0 ? cell_value(cell - 1) : 0;
    return before + (cell_value(cell) - before) * (place - double(cell));
}

double voxel_column_depth(std::uint32_t slices, std::span<const CellFragment> projected, double place) {
    std::vector<double> column(slices + 1, 0.);
    for (const CellFragment& fragment : projected) {
        const auto slice = std::size_t(fragment.place);
        const double share = fragment.place - double(slice);
        column[slice] += fragment.optical_depth * (1 - share);
        column[slice + 1] += fragment.optical_depth * share;
    }
    for (std::size_t i = 1; i < column.size(); ++i) column[i] += column[i - 1];
    const auto slice = std::size_t(place);
    const double before = slice > 0 ? column[slice - 1] : 0;
    return before + (column[slice] - before) * (place - double(slice));
}

ImageSet wavelet_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<WaveletParams>();
    const std::size_t channels = channel_count(params.channels, frame_features(input.frame));
    const std::size_t numbers = std::size_t{2} << params.rank;
    const DepthRange range = transparent_depth_range(input.frame);
    const auto half = params.storage == storage_half_float ? std::optional(input.rounding.half) : std::nullopt;

    PrepassModel prepass{.divisor = divisor_of(params.resolution)};
    if (params.bounds == bounds_pixel) prepass.filter = PrepassModel::Filter::nearest;
    // The texel's range comes first, then the coefficients of each channel.
    prepass.project = [=](std::span<const Fragment> fragments, glm::uvec2 texel) {
        const Cells cells = cells_of(params, range, fragments, texel);
        std::vector<double> all{cells.first, cells.last};
        for (std::size_t channel = 0; channel < channels; ++channel) {
            std::vector<CellFragment> projected;
            for (const Fragment& f : fragments) projected.push_back({cells.place(f.depth), depth_of(f, channel, channels)});
            const std::vector<double> coefficients = haar_coefficients(params.rank, projected, half);
            all.insert(all.end(), coefficients.begin(), coefficients.end());
        }
        return all;
    };
    prepass.function = [=](std::span<const double> kept, glm::uvec2 texel) -> Transmittance {
        const Cells cells{2u << params.rank, kept[0], kept[1], double(params.jitter) * noise(texel)};
        return [=](const Fragment& f) {
            glm::dvec3 through(0);
            for (std::size_t channel = 0; channel < channels; ++channel) {
                const double place = cells.place(f.depth), share = place - std::floor(place);
                double depth = haar_depth(kept.subspan(2 + channel * numbers, numbers), place);
                if (params.correction == correction_own) depth -= share * (1 - share) * depth_of(f, channel, channels);
                through[static_cast<int>(channel)] = std::exp(-std::max(depth, 0.));
            }
            return channels == 1 ? glm::dvec3(through.x) : through;
        };
    };
    return function_model(input, params.accumulation, prepass);
}

}  // namespace strata::transparency
