#include "passes/transparency/function_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "passes/transparency/function_prepass.h"
#include "passes/transparency/rounding.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

/// Adds and rounds as blending into the format does.
double blended(double sum, double term, std::uint32_t accumulation, SmallFloat format) {
    return accumulation == accumulation_single ? sum + term : rounded(sum + term, format);
}

SmallFloat color_format(std::uint32_t accumulation, int channel) {
    if (accumulation != accumulation_packed) return half_float;
    return channel == 2 ? float10 : float11;
}

bool is_chromatic(const Frame& frame) { return frame_features(frame).has(Feature::chromatic); }

struct Sums {
    glm::dvec3 color{0}, extinction{0}, normalizer{0}, emission{0};
};

Sums sums_of(std::span<const Fragment> fragments, const Transmittance& transmittance, std::uint32_t accumulation,
             bool chromatic) {
    Sums sums;
    for (const Fragment& fragment : fragments) {
        const glm::dvec3 through = transmittance(fragment);
        for (int c = 0; c < 3; ++c) {
            // Grey extinction and weights are one half float each, whatever the color's format.
            const SmallFloat color = color_format(accumulation, c), weight = chromatic ? color : half_float;
            const auto add = [&](double& sum, double term, SmallFloat format) { sum = blended(sum, term, accumulation, format); };
            add(sums.color[c], std::min(fragment.color[c], double(largest_radiance)) * through[c], color);
            add(sums.extinction[c], optical_depth_in_double(fragment.transmittance[c]), weight);
            add(sums.normalizer[c], (1 - fragment.transmittance[c]) * through[c], weight);
            add(sums.emission[c], std::min(fragment.emission[c], double(largest_radiance)) * through[c], color);
        }
    }
    return sums;
}

glm::dvec3 resolved(const Sums& sums, glm::dvec3 behind) {
    glm::dvec3 radiance(0);
    for (int c = 0; c < 3; ++c) {
        const double n = sums.normalizer[c];
        const double factor = n > double(least_normalizer) ? -std::expm1(-sums.extinction[c]) / n : 1;
        radiance[c] = behind[c] * std::exp(-sums.extinction[c]) + sums.color[c] * factor + sums.emission[c];
    }
    return radiance;
}

/// The farthest opaque depth of every texel of the prepass.
ReferenceImage farthest_depth(const ReferenceImage& fine, std::uint32_t width, std::uint32_t height) {
    ReferenceImage coarse(width, height, 1);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            double farthest = 1;
            const std::uint32_t end_x = ((x + 1) * fine.width + width - 1) / width,
                                end_y = ((y + 1) * fine.height + height - 1) / height;
            for (std::uint32_t s = 0; s < fine.layers; ++s)
                for (std::uint32_t fy = y * fine.height / height; fy < end_y; ++fy)
                    for (std::uint32_t fx = x * fine.width / width; fx < end_x; ++fx)
                        farthest = std::min(farthest, fine.at(fx, fy, s).x);
            coarse.at(x, y, 0) = glm::dvec4(farthest);
        }
    return coarse;
}

/// The numbers of every texel, and whether its coverage hangs on rounding.
struct Projected {
    std::uint32_t width = 0, height = 0;
    std::vector<std::vector<double>> texels;
    std::vector<bool> undecided;
};

Projected project(const StageInput& input, const PrepassModel& model) {
    Frame low = input.frame;
    const Extent extent = prepass_extent({low.view.width, low.view.height}, model.divisor);
    low.view.width = extent.width;
    low.view.height = extent.height;
    low.view.samples = 1;
    const auto depth = input.before.find("depth_layers");
    const ReferenceImage opaque = depth != input.before.end() ? farthest_depth(depth->second, low.view.width, low.view.height)
                                                              : ReferenceImage(low.view.width, low.view.height, 1);
    const FragmentLists lists = transparent_fragments(low, opaque);
    Projected projected{low.view.width, low.view.height, {}, {}};
    for (std::uint32_t y = 0; y < low.view.height; ++y)
        for (std::uint32_t x = 0; x < low.view.width; ++x) {
            projected.texels.push_back(model.project(lists.at(x, y), glm::uvec2(x, y)));
            projected.undecided.push_back(lists.undecided(x, y));
        }
    return projected;
}

/// What is read at a pixel's center.
struct Read {
    std::vector<double> numbers;
    glm::uvec2 texel{0};  ///< the nearest
    bool undecided = false;
};

/// Bilinear, clamped at the edges, or the nearest texel.
Read read_at(const Projected& projected, const PrepassModel& model, glm::uvec2 extent, glm::uvec2 pixel) {
    const glm::dvec2 place =
        glm::dvec2(pixel.x + .5, pixel.y + .5) / glm::dvec2(extent) * glm::dvec2(projected.width, projected.height);
    Read read{.texel = glm::uvec2(place)};
    const bool linear = model.filter == PrepassModel::Filter::linear;
    const glm::dvec2 at = linear ? place - .5 : glm::floor(place);
    const glm::dvec2 corner = glm::floor(at), share = at - corner;
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            const double weight = (dx ? share.x : 1 - share.x) * (dy ? share.y : 1 - share.y);
            if (weight == 0) continue;
            const auto clamped = [](double i, std::uint32_t count) { return std::size_t(std::clamp(i, 0., double(count - 1))); };
            const std::size_t texel =
                clamped(corner.y + dy, projected.height) * projected.width + clamped(corner.x + dx, projected.width);
            const std::vector<double>& numbers = projected.texels[texel];
            read.numbers.resize(numbers.size());
            for (std::size_t i = 0; i < numbers.size(); ++i) read.numbers[i] += weight * numbers[i];
            read.undecided = read.undecided || projected.undecided[texel];
        }
    return read;
}

}  // namespace

double optical_depth_in_double(double t) {
    return t > 0 ? std::min(-std::log(t), double(largest_optical_depth)) : double(largest_optical_depth);
}

double channel_depth(const Fragment& f, std::size_t channel, std::size_t channels) {
    const glm::dvec3 t = f.transmittance;
    return optical_depth_in_double(channels == 3 ? t[static_cast<int>(channel)] : .2126 * t.x + .7152 * t.y + .0722 * t.z);
}

glm::dvec3 function_blend(std::span<const Fragment> fragments, glm::dvec3 behind, const Transmittance& transmittance,
                          std::uint32_t accumulation) {
    return resolved(sums_of(fragments, transmittance, accumulation, false), behind);
}

ImageSet function_model(const StageInput& input, std::uint32_t accumulation, const FunctionOfSample& function) {
    const bool chromatic = is_chromatic(input.frame);
    const SampleBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind) {
        return resolved(sums_of(fragments, function(fragments), accumulation, chromatic), behind);
    };
    return {{"color", blended(input.before.at("color"), input.frame, input.before, blend)}};
}

ImageSet function_model(const StageInput& input, std::uint32_t accumulation, const PrepassModel& model) {
    const bool chromatic = is_chromatic(input.frame);
    const Projected projected = project(input, model);
    ReferenceImage color = input.before.at("color");
    const glm::uvec2 extent(color.width, color.height);
    const PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3 at) -> BlendedSample {
        if (fragments.empty()) return {behind};
        const Read read = read_at(projected, model, extent, glm::uvec2(at));
        const Sums sums = sums_of(fragments, model.function(read.numbers, read.texel), accumulation, chromatic);
        return {resolved(sums, behind), read.undecided};
    };
    return {{"color", blended(std::move(color), input.frame, input.before, blend)}};
}

}  // namespace strata::transparency
