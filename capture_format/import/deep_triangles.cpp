#include "capture_format/import/deep_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strata {
namespace {

/// Corners of a sample's triangle in pixels from the pixel's upper left corner. It holds Vulkan's four standard sample positions,
/// the center, and the lower right corner, which is the center of a pixel at half extent (thumbnails, quick truths); and none of
/// these points of any other pixel. All of them stay 8.8 steps of 1/256 pixel off its sides, the most that a search found, so
/// that no rounding of a vertex or of the rasterizer decides what is covered.
constexpr std::array<glm::dvec2, 3> corners = {{{.8604, -.2404}, {-.4087, .6061}, {1.2512, 1.3509}}};

/// Fragments below both are dropped by every technique (docs/algorithms/transparency.md 0.2).
constexpr double least_alpha = 1e-5;

/// Keeps the room of the lists.
void clear(DeepTriangles& made, std::size_t layers) {
    made.layers.resize(layers);
    for (DeepTriangles::Corners& layer : made.layers) layer.positions.clear(), layer.colors.clear();
    made.seen.clear();
    made.infinite.clear();
    made.census = {};
    made.nearest = std::numeric_limits<double>::max();
    made.farthest = 0;
}

}  // namespace

DeepTriangleMaker::DeepTriangleMaker(const DeepWindow& window, const View& view, std::span<const DeepLayer> layers)
    : window_(window),
      small_(thumbnail_extent(window.width, window.height)),
      extent_(window.width, window.height),
      scale_(view.projection[0][0], view.projection[1][1]),
      layers_(layers) {}

Result<void> DeepTriangleMaker::make(const DeepBlock& block, DeepTriangles& made) const {
    clear(made, layers_.size());
    for (std::size_t i = 0; i + 1 < block.begin.size(); ++i) {
        if (block.begin[i] == block.begin[i + 1]) continue;
        const std::int64_t x = std::int64_t{block.window.x} - window_.x + std::int64_t(i % block.window.width);
        const std::int64_t y = std::int64_t{block.window.y} - window_.y + std::int64_t(i / block.window.width);
        if (x < 0 || y < 0 || x >= window_.width || y >= window_.height) {
            made.census.outside += block.begin[i + 1] - block.begin[i];
            continue;
        }
        const auto samples = pixel_samples(block, i, made.census);
        if (!samples) return samples.error();
        add_pixel(glm::uvec2(x, y), *samples, made);
    }
    return {};
}

void DeepTriangleMaker::add_pixel(const glm::uvec2& pixel, const std::vector<DeepSample>& nearest_first,
                                  DeepTriangles& made) const {
    if (nearest_first.empty()) return;
    ++made.census.pixels;
    made.census.deepest = std::max<std::uint64_t>(made.census.deepest, nearest_first.size());
    if (const glm::uvec2 texel = pixel / small_.pixels; texel.x < small_.width && texel.y < small_.height) {
        const glm::uvec2 left = glm::uvec2(window_.width, window_.height) - texel * small_.pixels;
        const glm::dvec2 covered(glm::min(left, glm::uvec2(small_.pixels)));
        made.seen.emplace_back(std::size_t{texel.y} * small_.width + texel.x,
                               glm::dvec3(composite(nearest_first)) / (covered.x * covered.y));
    }
    for (auto sample = nearest_first.rbegin(); sample != nearest_first.rend(); ++sample) add_sample(pixel, *sample, made);
}

void DeepTriangleMaker::add_sample(const glm::uvec2& pixel, const DeepSample& sample, DeepTriangles& made) const {
    const glm::dvec3 &color = sample.color, &alpha = sample.alpha;
    const double brightest = std::max({color.x, color.y, color.z}), densest = std::max({alpha.x, alpha.y, alpha.z});
    if (densest == 0 && brightest > 0) ++made.census.without_alpha;
    if (densest < least_alpha && brightest < least_alpha) ++made.census.faint;
    const double depth = std::max(sample.depth, nearest_depth);
    if (std::isinf(depth)) made.infinite.emplace_back(made.layers[0].positions.size(), pixel);
    else made.nearest = std::min(made.nearest, depth), made.farthest = std::max(made.farthest, depth);
    std::array<glm::vec3, corners.size()> placed;
    for (std::size_t corner = 0; corner < corners.size(); ++corner) placed[corner] = position(pixel, corner, depth);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const glm::dvec3 alone = glm::dvec3(1) - glm::dvec3(layers_[i].transmission);
        DeepTriangles::Corners& layer = made.layers[i];
        layer.positions.insert(layer.positions.end(), placed.begin(), placed.end());
        layer.colors.insert(layer.colors.end(), corners.size(), glm::vec4(color * alone, alpha[glm::length_t(i)]));
        ++made.census.fragments;
    }
}

glm::vec3 DeepTriangleMaker::position(const glm::dvec2& pixel, std::size_t corner, double depth) const {
    const glm::dvec2 ndc = (pixel + corners[corner]) / extent_ * 2.0 - 1.0;
    return {ndc.x / scale_.x * depth, ndc.y / scale_.y * depth, depth};
}

}  // namespace strata
