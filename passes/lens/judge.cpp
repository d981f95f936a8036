#include "passes/lens/judge.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

double exposure_of(const ImageSet& images) {
    const auto found = images.find("exposure");
    return found == images.end() ? 1 : found->second.at(0, 0).x;
}

ReferenceImage shown(ReferenceImage color, const Frame& frame, double exposure) {
    const double white = frame.film.white;
    for (glm::dvec4& texel : color.texels)
        for (int c = 0; c < 3; ++c) {
            if (std::isnan(texel[c])) continue;
            const double x = std::clamp(texel[c] * double(frame.view.exposure) * exposure, 0., white);
            texel[c] = x * (1 + x / (white * white)) / (1 + x);
        }
    return color;
}

}  // namespace

std::vector<Metric> lens_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const double got = exposure_of(result), wanted = exposure_of(truth);
    const double stops = std::isfinite(got) && got > 0 ? std::abs(std::log2(got / wanted)) : HUGE_VAL;
    const auto color = truth.find("color"), found = result.find("color");
    if (color == truth.end() || found == result.end()) return {{"exposure error", "stops", stops}};
    const Difference display = difference(shown(found->second, input.frame, got), shown(color->second, input.frame, wanted));
    return {{"display rmse", "of white", display.rmse},
            {"display worst", "of white", display.worst},
            {"radiance relative rmse", "", difference(found->second, color->second).relative},
            {"exposure error", "stops", stops}};
}

}  // namespace strata
