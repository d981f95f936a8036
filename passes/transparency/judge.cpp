#include "passes/transparency/judge.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>

#include "capture_format/frame/frame.h"
#include "passes/reference/difference.h"
#include "passes/reference/settle.h"
#include "passes/stage_input.h"
#include "passes/tone_curve.h"

namespace strata {
namespace {

double displayed(const Frame& frame, double radiance) {
    return tone_mapped(radiance * double(frame.view.exposure), double(frame.film.white));
}

bool off_by_a_step(const Frame& frame, const glm::dvec4& got, const glm::dvec4& wanted) {
    for (int c = 0; c < 3; ++c) {
        if (std::isnan(got[c]) != std::isnan(wanted[c])) return true;  // NaN would be displayed as black
        if (std::abs(displayed(frame, got[c]) - displayed(frame, wanted[c])) > 1. / 255) return true;
    }
    return false;
}

/// |a - b| / (|b| + .01) of the channel where that is largest (docs/algorithms/transparency.md 9.3), of radiance times exposure:
/// below .01 the absolute error takes over, whatever the unit of light. What is not a number is as wrong as can be.
double relative_error(const Frame& frame, const glm::dvec4& got, const glm::dvec4& wanted) {
    const double dark = .01 / double(frame.view.exposure);
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        const double error = std::abs(signed_error(got[c], wanted[c])) / (std::abs(wanted[c]) + dark);
        worst = std::max(worst, std::isnan(error) ? HUGE_VAL : error);
    }
    return worst;
}

}  // namespace

std::vector<Metric> transparency_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage &got = result.at("color"), &wanted = truth.at("color");
    const Difference error = difference(got, wanted);
    std::size_t off = 0;
    std::vector<double> relative;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (!decided(got, wanted, i)) continue;
        if (off_by_a_step(input.frame, got.texels[i], wanted.texels[i])) ++off;
        relative.push_back(relative_error(input.frame, got.texels[i], wanted.texels[i]));
    }
    std::ranges::sort(relative);
    const auto percent = [&](std::size_t samples) {
        return 100 * double(samples) / double(std::max<std::size_t>(1, relative.size()));
    };
    const auto over = [&](double limit) {
        return percent(std::size_t(relative.end() - std::ranges::upper_bound(relative, limit)));
    };
    return {
        {"rmse", "radiance", error.rmse, true},  // the relative one says the same, and compares frames
        {"relative rmse", "", error.relative},
        {"worst", "radiance", error.worst, true},
        {"bias", "radiance", error.bias},
        {"P95", "relative", percentile(relative, 95), true},
        {"P99", "relative", percentile(relative, 99)},
        {"over 2 %", "%", over(.02), true},
        {"over 10 %", "%", over(.1)},
        {"off by 1/255", "%", percent(off), true},
    };
}

Metric settle_transparency(const ImageSet& result, ImageSet& truth) {
    ReferenceImage& color = truth.at("color");
    const double width = settle(result.at("color"), color);
    double squares = 0;
    for (const glm::dvec4& texel : color.texels) squares += glm::dot(glm::dvec3(texel), glm::dvec3(texel)) / 3;
    return {"relative rmse", "", width / std::sqrt(std::max(squares, DBL_MIN) / double(color.texels.size()))};
}

}  // namespace strata
