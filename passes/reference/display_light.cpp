#include "passes/reference/display_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

#include "passes/error_sums.h"
#include "passes/reference/difference.h"
#include "passes/reference/textures.h"
#include "passes/tone_curve.h"

namespace strata {
namespace {

double encoded(double linear) { return linear_to_srgb(std::clamp(linear, 0., 1.)); }

/// Whether a picture of 8 bits shows encoded light as white, or as black.
bool is_clipped(const glm::dvec3& color) {
    constexpr double half_a_step = .5 / 255;
    return glm::all(glm::greaterThanEqual(color, glm::dvec3(1 - half_a_step))) ||
           glm::all(glm::lessThanEqual(color, glm::dvec3(half_a_step)));
}

double concentration_of(std::vector<double> squares) {
    constexpr std::size_t of_worst = 1000;
    const double all = std::accumulate(squares.begin(), squares.end(), 0.);
    if (!(all > 0) || !std::isfinite(all)) return 0;
    const auto worst = squares.begin() + std::ptrdiff_t(std::max<std::size_t>(1, squares.size() / of_worst));
    std::ranges::nth_element(squares, worst - 1, std::greater{});
    return std::accumulate(squares.begin(), worst, 0.) / all;
}

}  // namespace

ReferenceImage tone_mapped(ReferenceImage radiance, double exposure, double white) {
    for (glm::dvec4& texel : radiance.texels)
        for (int c = 0; c < 3; ++c) texel[c] = tone_mapped(texel[c] * exposure, white);
    radiance.alternatives.clear();
    return radiance;
}

ReferenceImage srgb_encoded(ReferenceImage display) {
    const auto encode = [](glm::dvec4& texel) {
        for (int c = 0; c < 3; ++c) texel[c] = encoded(texel[c]);
    };
    std::ranges::for_each(display.texels, encode);
    std::ranges::for_each(display.alternatives, encode, &Alternative::value);
    return display;
}

DisplayError display_error(const ReferenceImage& got, const ReferenceImage& wanted, const std::vector<bool>& changed) {
    assert(got.width == wanted.width && got.height == wanted.height && got.layers == wanted.layers);
    DisplayError error;
    ErrorSums sums;
    std::size_t over_1 = 0, over_5 = 0, clipped = 0;
    std::vector<double> squares;
    const std::size_t pixels = std::size_t(wanted.width) * wanted.height;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        if (!changed.empty() && !changed[pixel]) continue;
        glm::dvec3 got_sum(0), wanted_sum(0);
        std::size_t samples = 0;
        for (std::size_t i = pixel; i < wanted.texels.size(); i += pixels) {
            if (!decided(got, wanted, i)) continue;
            got_sum += glm::dvec3(got.texels[i]), wanted_sum += glm::dvec3(wanted.texels[i]);
            ++samples;
        }
        if (samples == 0) continue;
        double worst = 0, square = 0;
        glm::dvec3 shown;
        for (int c = 0; c < 3; ++c) {
            shown[c] = encoded(wanted_sum[c] / double(samples));
            const double off = sums.add(encoded(got_sum[c] / double(samples)), shown[c]);
            worst = std::max(worst, std::abs(off)), square += off * off;
        }
        squares.push_back(square);
        clipped += is_clipped(shown);
        over_1 += worst > 1. / 255, over_5 += worst > 5. / 255;
        error.worst = std::max(error.worst, worst);
        ++error.pixels;
    }
    error.rmse = sums.rmse();
    const auto share = [&](std::size_t of_them) { return double(of_them) / double(std::max<std::size_t>(1, error.pixels)); };
    error.over_1_255 = share(over_1);
    error.over_5_255 = share(over_5);
    error.clipped_share = share(clipped);
    error.concentration = concentration_of(std::move(squares));
    return error;
}

}  // namespace strata
