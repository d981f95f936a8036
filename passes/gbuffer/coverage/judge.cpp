#include "passes/gbuffer/coverage/judge.h"

#include <algorithm>
#include <cmath>

#include "passes/gbuffer/coverage/truth.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {
namespace {

// Two depths of one surface differ by less, relatively: floats, and positions snapped to 1/256 pixel.
constexpr double depth_slack = 1e-4;
// A true area is at least this share of the pixels that the result or the truth covers, where an error is relative to it: of an
// area of nearly 0 a share would say nothing. No error is above 10 000 %.
constexpr double least_area = 0.01;

/// How far covered shares are from the true ones.
class Off {
public:
    void add(double got, double wanted) {
        if (got == 0 && wanted == 0) return;
        difference_ += std::abs(got - wanted);
        got_ += got;
        wanted_ += wanted;
        ++pixels_;
    }
    double per_pixel() const { return difference_ / std::max(1.0, pixels_); }
    double percent_of_area(double area) const { return pixels_ == 0 ? 0 : 100 * area / std::max(least_area * pixels_, wanted_); }
    double area_percent() const { return percent_of_area(std::abs(got_ - wanted_)); }
    double pixels() const { return pixels_; }

private:
    double difference_ = 0, got_ = 0, wanted_ = 0, pixels_ = 0;
};

}  // namespace

std::vector<PixelCoverage> pixel_coverage(const ImageSet& result, const ImageSet& truth, const Frame& frame) {
    if (!has_masks(frame)) return {};
    const ReferenceImage &depth = result.at("depth_layers"), &wanted = truth.at("depth_layers");
    std::vector<PixelCoverage> pixels(std::size_t(wanted.width) * wanted.height);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = {.wanted = wanted.texels[i].y, .alpha = wanted.texels[i].z, .own_error = wanted.standard_error[i].y};
    for (std::size_t i = 0; i < wanted.texels.size(); ++i)
        if (depth.texels[i].x > wanted.texels[i].w * (1 + depth_slack)) pixels[i % pixels.size()].got += 1.0 / wanted.layers;
    return pixels;
}

std::vector<Metric> coverage_metrics(const ImageSet& result, const ImageSet& truth, const Frame& frame) {
    const std::vector<PixelCoverage> pixels = pixel_coverage(result, truth, frame);
    if (pixels.empty()) return {};
    Off of_area, of_alpha;
    double own_squares = 0;
    for (const PixelCoverage& pixel : pixels) {
        of_area.add(pixel.got, pixel.wanted);
        of_alpha.add(pixel.got, pixel.alpha);
        own_squares += pixel.own_error * pixel.own_error;
    }
    const double own_rms = std::sqrt(own_squares / std::max(1.0, of_area.pixels()));
    return {{"masked coverage off", "of a pixel", of_area.per_pixel()},
            {"masked area off", "%", of_area.area_percent()},
            {"masked alpha off", "of a pixel", of_alpha.per_pixel()},
            {"masked alpha area off", "%", of_alpha.area_percent(), true},
            {"masked coverage truth error", "of a pixel", own_rms, true},
            {"masked area truth error", "%", of_area.percent_of_area(std::sqrt(own_squares)), true}};
}

}  // namespace strata::gbuffer
