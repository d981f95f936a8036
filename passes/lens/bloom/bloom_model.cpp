#include "passes/lens/bloom/bloom_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace strata::lens {
namespace {

constexpr double largest = 65504;

/// From 0 to the largest half float; 0 of what is not a number.
glm::dvec3 limited(glm::dvec3 c) {
    for (int i = 0; i < 3; ++i) c[i] = std::isnan(c[i]) ? 0 : std::clamp(c[i], 0., largest);
    return c;
}

glm::dvec3 held(const ReferenceImage& image, int x, int y) {
    const auto at = [](int i, std::uint32_t size) { return static_cast<std::uint32_t>(std::clamp(i, 0, int(size) - 1)); };
    return glm::dvec3(image.at(at(x, image.width), at(y, image.height)));
}

/// The mean of each pixel's samples, each as `of` says.
template <typename Of>
ReferenceImage mean_of_samples(const ReferenceImage& color, const Of& of) {
    ReferenceImage mean(color.width, color.height);
    for (std::uint32_t y = 0; y < color.height; ++y)
        for (std::uint32_t x = 0; x < color.width; ++x) {
            glm::dvec3 sum(0);
            for (std::uint32_t i = 0; i < color.layers; ++i) sum += of(glm::dvec3(color.at(x, y, i)));
            mean.at(x, y) = glm::dvec4(sum / double(color.layers), 1);
        }
    return mean;
}

ReferenceImage halved(const ReferenceImage& finer) {
    ReferenceImage coarser((finer.width + 1) / 2, (finer.height + 1) / 2);
    constexpr double weights[] = {1. / 8, 3. / 8, 3. / 8, 1. / 8};
    for (int y = 0; y < int(coarser.height); ++y)
        for (int x = 0; x < int(coarser.width); ++x) {
            glm::dvec3 sum(0);
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) sum += weights[i] * weights[j] * held(finer, 2 * x + i - 1, 2 * y + j - 1);
            coarser.at(std::uint32_t(x), std::uint32_t(y)) = glm::dvec4(sum, 1);
        }
    return coarser;
}

/// Linear between the centers of texels twice as large.
ReferenceImage doubled(const ReferenceImage& coarser, std::uint32_t width, std::uint32_t height) {
    ReferenceImage finer(width, height);
    for (int y = 0; y < int(height); ++y)
        for (int x = 0; x < int(width); ++x) {
            const double u = (x + .5) / 2 - .5, v = (y + .5) / 2 - .5;
            const int left = int(std::floor(u)), top = int(std::floor(v));
            const double p = u - left, q = v - top;
            const glm::dvec3 sum = (1 - q) * ((1 - p) * held(coarser, left, top) + p * held(coarser, left + 1, top)) +
                                   q * ((1 - p) * held(coarser, left, top + 1) + p * held(coarser, left + 1, top + 1));
            finer.at(std::uint32_t(x), std::uint32_t(y)) = glm::dvec4(sum, 1);
        }
    return finer;
}

glm::dvec4 tap(const ReferenceImage& image, double u, double v) {
    const double x = u * image.width - .5, y = v * image.height - .5, p = x - std::floor(x), q = y - std::floor(y);
    const auto at = [&](int dx, int dy) {
        const auto inside = [](double i, std::uint32_t size) { return std::uint32_t(std::clamp(i, 0., double(size - 1))); };
        return image.at(inside(std::floor(x) + dx, image.width), inside(std::floor(y) + dy, image.height));
    };
    return (1 - q) * ((1 - p) * at(0, 0) + p * at(1, 0)) + q * ((1 - p) * at(0, 1) + p * at(1, 1));
}

ReferenceImage blurred_along(const ReferenceImage& image, int dx, int dy) {
    ReferenceImage result(image.width, image.height);
    const std::array<double, 8> weights = xray_taps();
    for (int y = 0; y < int(image.height); ++y)
        for (int x = 0; x < int(image.width); ++x) {
            glm::dvec4 sum(0);
            for (int k = -7; k <= 7; ++k) {
                const auto px = std::uint32_t(std::clamp(x + k * dx, 0, int(image.width) - 1));
                const auto py = std::uint32_t(std::clamp(y + k * dy, 0, int(image.height) - 1));
                sum += weights[std::size_t(std::abs(k))] * image.at(px, py);
            }
            result.at(std::uint32_t(x), std::uint32_t(y)) = glm::min(sum, glm::dvec4(1));
        }
    return result;
}

}  // namespace

ReferenceImage glowing(const ReferenceImage& color, const Bloom& bloom) {
    return mean_of_samples(color, [&](const glm::dvec3& c) {
        const glm::dvec3 exposed = limited(c * bloom.scale);
        const double most = std::max({exposed.x, exposed.y, exposed.z});
        return most > bloom.threshold ? exposed * (1 - bloom.threshold / most) : glm::dvec3(0);
    });
}

std::uint32_t pyramid_levels(double reach, std::uint32_t height) {
    // Of a variance of (4^l - 1) / 2 = (reach height)^2.
    const double power = 2 * std::pow(reach * height, 2) + 1;
    return std::uint32_t(std::clamp(std::round(std::log(power) / std::log(4.)), 1., 12.));
}

ReferenceImage pyramid_glow(const ReferenceImage& glowing, std::uint32_t levels) {
    std::vector<ReferenceImage> level{glowing};
    for (std::uint32_t i = 0; i < levels; ++i) level.push_back(halved(level.back()));
    ReferenceImage mean = level.back();
    for (std::size_t i = levels; i-- > 0;) {
        mean = doubled(mean, level[i].width, level[i].height);
        if (i == 0) break;
        const double coarser = double(levels - i);
        for (std::size_t t = 0; t < mean.texels.size(); ++t)
            mean.texels[t] = (mean.texels[t] * coarser + level[i].texels[t]) / (coarser + 1);
    }
    return mean;
}

std::array<double, 8> xray_taps() {
    std::array<double, 8> weights{};
    for (const double deviation : {1., 3.}) {
        double sum = 0;
        for (int k = -7; k <= 7; ++k) sum += std::exp(-.5 * std::pow(k / deviation, 2));
        for (std::size_t k = 0; k < 8; ++k) weights[k] += .7 * std::exp(-.5 * std::pow(double(k) / deviation, 2)) / sum;
    }
    return weights;
}

ReferenceImage xray_glow(const ReferenceImage& color, double scale) {
    const ReferenceImage hi =
        mean_of_samples(color, [&](const glm::dvec3& c) { return glm::min(limited(c * scale) / 9., glm::dvec3(1)); });
    constexpr std::uint32_t extent = 256;
    ReferenceImage bright(extent, extent);
    for (std::uint32_t y = 0; y < extent; ++y)
        for (std::uint32_t x = 0; x < extent; ++x) {
            glm::dvec4 sum(0);
            for (const double v : {.25, .75})
                for (const double u : {.25, .75}) sum += tap(hi, (x + u) / extent, (y + v) / extent);
            const glm::dvec3 rgb = glm::min(glm::dvec3(sum) / 2., glm::dvec3(1));
            bright.at(x, y) = glm::dvec4(rgb, std::clamp(rgb.x + rgb.y + rgb.z - 1e-5, 0., 1.));
        }
    const ReferenceImage blurred = blurred_along(blurred_along(bright, 1, 0), 0, 1);
    ReferenceImage glow(color.width, color.height);
    for (std::uint32_t y = 0; y < color.height; ++y)
        for (std::uint32_t x = 0; x < color.width; ++x) {
            const glm::dvec4 found = tap(blurred, (x + .5) / color.width, (y + .5) / color.height);
            glow.at(x, y) = glm::dvec4(glm::dvec3(found) * found.w, 1);
        }
    return glow;
}

ReferenceImage with_glow(const ReferenceImage& color, const ReferenceImage& glow, const Bloom& bloom) {
    ReferenceImage result = color;
    const std::size_t pixels = glow.texels.size();
    for (std::size_t i = 0; i < result.texels.size(); ++i)
        result.texels[i] += glm::dvec4(glm::dvec3(glow.texels[i % pixels]) * (bloom.strength / bloom.scale), 0);
    return result;
}

}  // namespace strata::lens
