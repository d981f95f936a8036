#include "replay/measure/flip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

#include "capture_format/srgb.h"
#include "passes/luminance.h"
#include "replay/measure/observer.h"

namespace strata {
namespace {

// The larger root of curve(x) = 0.85.
double light_that_shows_as_85_percent(ToneMapper mapper) {
    constexpr double t = .85;
    const ToneCurve curve = tone_curve(mapper);
    const double square = double(curve.above[0]) - t * double(curve.below[0]);
    const double linear = double(curve.above[1]) - t * double(curve.below[1]);
    const double constant = double(curve.above[2]) - t * double(curve.below[2]);
    if (square == 0) return -constant / linear;
    const double middle = -linear / (2 * square), apart = std::sqrt(middle * middle - constant / square);
    return middle + apart;
}

// A picture of a range beyond this is mostly darkness that no display shows.
constexpr double most_exposures = 32;
// Light below this is black: its exposures would leave the range of a float.
constexpr float darkest = 1e-30f;

std::vector<float> luminances(const ColorPlanes& picture) {
    std::vector<float> all(picture.rgb[0].size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = std::max(
            0.f, luminance(std::max(0.f, picture.rgb[0][i]), std::max(0.f, picture.rgb[1][i]), std::max(0.f, picture.rgb[2][i])));
    return all;
}

float median_of(std::vector<float>& values) {
    if (values.size() == 1) return values[0];
    const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, upper);
    return .5f * (*std::max_element(values.begin(), upper) + *upper);
}

std::optional<ExposureRange> exposures_of(const ColorPlanes& picture, ToneMapper mapper) {
    std::vector<float> light = luminances(picture);
    const float brightest = light.empty() ? 0 : *std::ranges::max_element(light);
    if (brightest <= darkest) return {};
    float median = median_of(light);
    if (median <= darkest) {
        std::erase_if(light, [](float v) { return v <= darkest; });
        median = median_of(light);
    }
    const double shown = light_that_shows_as_85_percent(mapper);
    const double start = std::log2(shown / double(brightest)), stop = std::log2(shown / double(median));
    return exposure_range(start, std::min(stop, start + most_exposures));
}

/// Where only one picture has a number, they could not differ more.
void mark_broken(const ColorPlanes& reference, const ColorPlanes& test, std::vector<float>& map) {
    const auto broken = [](const ColorPlanes& picture, std::size_t i) { return !picture.broken.empty() && picture.broken[i]; };
    if (reference.broken.empty() && test.broken.empty()) return;
    for (std::size_t i = 0; i < map.size(); ++i)
        if (broken(reference, i) != broken(test, i)) map[i] = 1;
}

/// Floats from 0 up are ordered as their bits are: three passes over 11 bits each take a fifth of what a comparing sort takes.
std::vector<float> ascending(std::vector<float> values) {
    std::vector<float> ordered(values.size());
    for (const int shift : {0, 11, 22}) {
        const auto digit = [shift](float value) { return std::bit_cast<std::uint32_t>(value) >> shift & 0x7ff; };
        std::array<std::size_t, 0x800> counts{}, next;
        for (const float value : values) ++counts[digit(value)];
        std::exclusive_scan(counts.begin(), counts.end(), next.begin(), std::size_t{0});
        for (const float value : values) ordered[next[digit(value)]++] = value;
        values.swap(ordered);
    }
    return values;
}

void pool(Flip& flip) {
    const std::vector<float> sorted = ascending(flip.map);
    const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.);
    flip.mean = sum / double(std::max<std::size_t>(1, sorted.size()));
    if (sorted.empty()) return;
    flip.low = double(sorted.front());
    flip.high = double(sorted.back());
    struct Quantile {
        double share;
        double Flip::*at;
    };
    double below = 0;
    std::size_t next = 0;
    for (const Quantile& quantile : {Quantile{.25, &Flip::first_quartile}, {.5, &Flip::median}, {.75, &Flip::third_quartile}}) {
        while (next + 1 < sorted.size() && below + double(sorted[next]) < quantile.share * sum) below += double(sorted[next++]);
        flip.*quantile.at = double(sorted[next]);
    }
}

Flip empty_flip(const ColorPlanes& reference, [[maybe_unused]] const ColorPlanes& test) {
    assert(reference.width == test.width && reference.height == test.height);
    return {.width = reference.width, .height = reference.height, .map = std::vector<float>(reference.rgb[0].size())};
}

}  // namespace

ColorPlanes color_planes(const HostImage& image) {
    ColorPlanes planes = color_planes(in_double(image));
    const FormatRow& format = row(image.shape.format);
    if (format.bytes != format.channels) return planes;
    for (std::vector<float>& plane : planes.rgb)
        for (float& value : plane) value = decode_srgb(value);
    return planes;
}

ColorPlanes color_planes(const ReferenceImage& image) {
    ColorPlanes planes{image.width, image.height, {}, {}};
    const std::size_t count = std::size_t(image.width) * image.height;
    for (std::vector<float>& plane : planes.rgb) plane.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec3 sum(0);
        for (std::size_t layer = 0; layer < image.layers; ++layer) sum += glm::dvec3(image.texels[layer * count + i]);
        if (image.channels == 1) sum = glm::dvec3(sum.x);
        if (!std::isfinite(sum.x + sum.y + sum.z)) {
            if (planes.broken.empty()) planes.broken.resize(count);
            planes.broken[i] = true;
            continue;
        }
        for (std::size_t c = 0; c < 3; ++c)
            planes.rgb[c][i] = static_cast<float>(sum[static_cast<glm::length_t>(c)] / image.layers);
    }
    return planes;
}

std::string_view name(ToneMapper mapper) { return tone_mapper_names[static_cast<std::size_t>(mapper)]; }

ExposureRange exposure_range(double start, double stop) {
    return {start, stop, static_cast<std::uint32_t>(std::max(2., std::ceil(stop - start)))};
}

ExposureRange exposures_of(const ColorPlanes& reference, const ColorPlanes& test, ToneMapper mapper) {
    if (const auto range = exposures_of(reference, mapper)) return *range;
    return exposures_of(test, mapper).value_or(ExposureRange{.count = 1});
}

Flip display_flip(const ColorPlanes& reference, const ColorPlanes& test, double pixels_per_degree) {
    Flip flip = empty_flip(reference, test);
    Observer observer(flip.width, flip.height, pixels_per_degree);
    std::ranges::copy(observer.compare(reference, test, {}), flip.map.begin());
    mark_broken(reference, test, flip.map);
    pool(flip);
    return flip;
}

Flip radiance_flip(const ColorPlanes& reference, const ColorPlanes& test, const FlipOptions& options) {
    Flip flip = empty_flip(reference, test);
    flip.exposures = options.exposures ? *options.exposures : exposures_of(reference, test, options.tone_mapper);
    flip.exposure.resize(flip.map.size());
    Observer observer(flip.width, flip.height, options.pixels_per_degree);
    for (std::uint32_t i = 0; i < flip.exposures.count; ++i) {
        const auto& [start, stop, count] = flip.exposures;
        const std::span<const float> map =
            observer.compare(reference, test, Exposed{start + (stop - start) * i / std::max(1u, count - 1), options.tone_mapper});
        for (std::size_t p = 0; p < map.size(); ++p) {
            if (map[p] <= flip.map[p]) continue;
            flip.map[p] = map[p];
            flip.exposure[p] = static_cast<std::uint8_t>(i);
        }
    }
    mark_broken(reference, test, flip.map);
    pool(flip);
    return flip;
}

}  // namespace strata
