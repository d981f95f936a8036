#include "passes/transparency/voxel/volume/column.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strata::transparency {
namespace {

constexpr double biases[] = {-1, -2, -2.5};

/// Of the values around a place: from the one before k, where the place is k + f.
std::array<double, 4> weights(std::uint32_t sampling, double f) {
    if (sampling == sampling_linear) return {0, 1 - f, f, 0};
    const double g = 1 - f;
    return {g * g * g / 6, (4 - 6 * f * f + 3 * f * f * f) / 6, (4 - 6 * g * g + 3 * g * g * g) / 6, f * f * f / 6};
}

}  // namespace

double ColumnFormat::codes_per_depth() const { return full_code / std::log(double(full_code)); }

double ColumnFormat::codes(double optical_depth) const { return std::min(optical_depth * codes_per_depth(), double(full_code)); }

double ColumnFormat::transmittance(double codes) const {
    return codes >= full_code * double(full_share) ? 0 : std::exp(-codes / codes_per_depth());
}

ColumnFormat column_format(const VoxelParams& params) {
    constexpr std::uint32_t field_bits[] = {8, 10, 16, 32}, full_codes[] = {255, 1023, 65535, (1u << 20) - 1};
    return {.slices = params.slices,
            .splat = params.splat,
            .field_bits = params.splat == splat_words ? 32 : field_bits[params.bits],
            .full_code = full_codes[params.bits]};
}

SlicePlace slice_place(double s, std::uint32_t slices, std::uint32_t splatting) {
    const double center = std::clamp(splatting == splatting_linear ? s - .5 : std::floor(s), 0., slices - 1.);
    return {static_cast<std::uint32_t>(center), center - std::floor(center)};
}

SplitCode split_code(const ColumnFormat& format, SlicePlace place, double codes, double rounding) {
    const auto whole = std::min(static_cast<std::uint32_t>(codes + rounding), format.full_code);
    const auto farther = std::min(static_cast<std::uint32_t>(codes * place.share + rounding), whole);
    return {place.slice, whole - farther, farther};
}

void Column::add(std::uint32_t slice, std::uint32_t code) {
    const std::uint32_t shift = slice % format_.slices_per_word() * format_.field_bits;
    const std::uint32_t room = (0xffffffffu >> (32 - format_.field_bits)) - field(slice);
    if (format_.splat == splat_saturating) code = std::min(code, room);
    if (format_.splat == splat_overflow_minimum && code > room) overflow_ = std::min(overflow_, slice);
    words_[slice / format_.slices_per_word()] += code << shift;
}

void Column::add(SplitCode split) {
    add(split.slice, split.nearer);
    if (split.farther > 0) add(split.slice + 1, split.farther);
}

std::uint32_t Column::field(std::uint32_t slice) const {
    const std::uint32_t word = words_[slice / format_.slices_per_word()];
    return word >> slice % format_.slices_per_word() * format_.field_bits & 0xffffffffu >> (32 - format_.field_bits);
}

std::vector<std::uint32_t> Column::integral() const {
    std::vector<std::uint32_t> sums;
    std::uint32_t sum = 0;
    for (std::uint32_t slice = 0; slice < format_.slices; ++slice) {
        const std::uint32_t left = format_.full_code - sum;
        sum += slice >= overflow_ ? left : std::min(field(slice), left);
        sums.push_back(sum);
    }
    return sums;
}

double sampling_bias(std::uint32_t sampling) { return biases[sampling]; }

double sampled_integral(const std::function<double(int)>& value, double at, std::uint32_t sampling) {
    if (sampling == sampling_point) return value(static_cast<int>(std::floor(at)));
    const double k = std::floor(at - .5);
    const std::array<double, 4> w = weights(sampling, at - .5 - k);
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += w[static_cast<std::size_t>(i)] * value(static_cast<int>(k) - 1 + i);
    return sum;
}

double sampled_integral(std::span<const double> integral, double at, std::uint32_t sampling) {
    const auto value = [&](int slice) {
        return slice < 0 ? 0. : integral[std::min(static_cast<std::size_t>(slice), integral.size() - 1)];
    };
    return sampled_integral(value, at, sampling);
}

}  // namespace strata::transparency
