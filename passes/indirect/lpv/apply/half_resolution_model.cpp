#include "passes/indirect/lpv/apply/half_resolution_model.h"

#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

namespace strata::indirect::in_double {
namespace {

// The least sum of weights.
constexpr double least_fit = 0.25;

glm::uvec2 blocks_of(const VisibleSurfaces& seen) { return {(seen.width + 1) / 2, (seen.height + 1) / 2}; }

}  // namespace

std::vector<std::optional<glm::uvec2>> reading_pixels(const VisibleSurfaces& seen) {
    std::vector<std::optional<glm::uvec2>> chosen;
    const glm::uvec2 extent = blocks_of(seen);
    for (std::uint32_t y = 0; y < extent.y; ++y)
        for (std::uint32_t x = 0; x < extent.x; ++x) {
            std::vector<glm::uvec2> with_surface;
            for (const glm::uvec2 pixel : {glm::uvec2(2 * x, 2 * y), glm::uvec2(2 * x + 1, 2 * y), glm::uvec2(2 * x, 2 * y + 1),
                                           glm::uvec2(2 * x + 1, 2 * y + 1)})
                if (pixel.x < seen.width && pixel.y < seen.height && seen.receivers[pixel.y * seen.width + pixel.x])
                    with_surface.push_back(pixel);
            const auto depth = [&](const glm::uvec2& pixel) { return seen.depths[pixel.y * seen.width + pixel.x]; };
            const auto found = (x + y) % 2 == 0 ? std::ranges::min_element(with_surface, {}, depth)
                                                : std::ranges::max_element(with_surface, {}, depth);
            chosen.push_back(found == with_surface.end() ? std::nullopt : std::optional(*found));
        }
    return chosen;
}

double fit(const LitGrid& lit, const Receiver& at, const Receiver& other, const glm::dvec2& pixels) {
    const double size = lit.grid.cell_size, distance = glm::length(at.position - other.position);
    const double cosine = glm::dot(at.normal, other.normal);
    const std::array<double, 4> factors{1 - std::abs(pixels.x) / 3, 1 - std::abs(pixels.y) / 3, 1 - distance / (size / 2),
                                        2 * cosine - 1};
    double product = 1;
    for (const double factor : factors) product *= std::max(0.0, factor);
    const Segment way{way_begin(at.position, at.normal), way_begin(other.position, other.normal)};
    return product > 0 && is_blocked(lit.tap_barriers, way, slack_of(size)) ? 0 : product;
}

HalfResolutionLight::HalfResolutionLight(const LitGrid& lit, const VisibleSurfaces& seen) : lit_(lit), extent_(blocks_of(seen)) {
    const std::vector<std::optional<glm::uvec2>> pixels = reading_pixels(seen);
    blocks_.resize(pixels.size());
    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
        if (!pixels[i]) return;
        const Receiver& receiver = *seen.receivers[pixels[i]->y * seen.width + pixels[i]->x];
        if (grid_share(lit.grid, receiver.position) > 0) blocks_[i] = Block{*pixels[i], receiver, irradiance(lit, receiver)};
    });
}

std::optional<glm::dvec3> HalfResolutionLight::at(const Receiver& receiver, const glm::uvec2& pixel) const {
    const glm::ivec2 own(pixel / 2u), towards(pixel.x % 2 == 0 ? -1 : 1, pixel.y % 2 == 0 ? -1 : 1);
    glm::dvec3 sum(0);
    double weights = 0;
    for (const glm::ivec2 step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
        const glm::ivec2 place = own + step * towards;
        if (glm::any(glm::lessThan(place, glm::ivec2(0))) || glm::any(glm::greaterThanEqual(place, extent_))) continue;
        const std::optional<Block>& block = blocks_[std::size_t(place.y) * std::size_t(extent_.x) + std::size_t(place.x)];
        if (!block) continue;
        const double weight = fit(lit_, receiver, block->receiver, glm::dvec2(pixel) - glm::dvec2(block->pixel));
        sum += weight * block->light;
        weights += weight;
    }
    if (weights < least_fit) return std::nullopt;
    return sum / weights;
}

}  // namespace strata::indirect::in_double
