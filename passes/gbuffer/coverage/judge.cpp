#include "passes/gbuffer/coverage/judge.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/triangles.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {
namespace {

// Along each side of a pixel.
constexpr std::uint32_t fine = 8;
// Two depths of one surface differ by less, relatively: floats, and positions snapped to 1/256 pixel.
constexpr double depth_slack = 1e-4;

bool is_masked(const Frame& frame, std::uint32_t draw) {
    const Material* material = draw == no_index ? nullptr : material_of(frame, draw);
    return material != nullptr && material->alpha_mode == AlphaMode::mask;
}

bool has_masks(const Frame& frame) {
    return std::ranges::any_of(opaque_draws(frame), [&](std::uint32_t draw) { return is_masked(frame, draw); });
}

/// The share of each pixel whose nearest surface is masked.
std::vector<double> true_coverage(const Frame& frame) {
    Frame finer = frame;
    finer.view.width *= fine;
    finer.view.height *= fine;
    finer.view.samples = 1;
    const VisiblePoints visible = visible_points(finer, opaque_draws(finer), {.shade_at = ShadeAt::sample});
    std::vector<double> coverage(std::size_t(frame.view.width) * frame.view.height);
    for (std::uint32_t y = 0; y < finer.view.height; ++y)
        for (std::uint32_t x = 0; x < finer.view.width; ++x)
            if (is_masked(finer, visible.at(x, y).draw))
                coverage[std::size_t(y / fine) * frame.view.width + x / fine] += 1.0 / (fine * fine);
    return coverage;
}

}  // namespace

void add_true_coverage(ImageSet& truth, const Frame& frame) {
    if (!has_masks(frame)) return;
    std::vector<std::uint32_t> solid = opaque_draws(frame);
    std::erase_if(solid, [&](std::uint32_t draw) { return is_masked(frame, draw); });
    const VisiblePoints behind = visible_points(frame, solid, {.shade_at = ShadeAt::sample});
    const std::vector<double> coverage = true_coverage(frame);
    ReferenceImage& depth = truth.at("depth_layers");
    for (std::size_t i = 0; i < depth.texels.size(); ++i) {
        depth.texels[i].y = coverage[i % coverage.size()];
        depth.texels[i].z = behind.points[i].depth;
    }
}

std::vector<PixelCoverage> pixel_coverage(const ImageSet& result, const ImageSet& truth, const Frame& frame) {
    if (!has_masks(frame)) return {};
    const ReferenceImage &depth = result.at("depth_layers"), &wanted = truth.at("depth_layers");
    std::vector<PixelCoverage> pixels(std::size_t(wanted.width) * wanted.height);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].wanted = wanted.texels[i].y;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i)
        if (depth.texels[i].x > wanted.texels[i].z * (1 + depth_slack)) pixels[i % pixels.size()].got += 1.0 / wanted.layers;
    return pixels;
}

std::vector<Metric> coverage_metrics(const ImageSet& result, const ImageSet& truth, const Frame& frame) {
    const std::vector<PixelCoverage> pixels = pixel_coverage(result, truth, frame);
    if (pixels.empty()) return {};
    double difference = 0, covered = 0, got_area = 0, area = 0;
    for (const PixelCoverage& pixel : pixels) {
        if (pixel.got == 0 && pixel.wanted == 0) continue;
        difference += std::abs(pixel.got - pixel.wanted);
        got_area += pixel.got;
        area += pixel.wanted;
        ++covered;
    }
    return {{"masked coverage off", "of a pixel", difference / std::max(1.0, covered)},
            {"masked area off", "%", 100 * std::abs(got_area / std::max(1e-9, area) - 1)}};
}

}  // namespace strata::gbuffer
