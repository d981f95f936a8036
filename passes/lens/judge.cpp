#include "passes/lens/judge.h"

#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/reference/difference.h"
#include "passes/reference/display_light.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

double exposure_of(const ImageSet& images) {
    const auto found = images.find("exposure");
    return found == images.end() ? 1 : found->second.at(0, 0).x;
}

ReferenceImage shown(const ReferenceImage& color, const Frame& frame, double exposure) {
    return tone_mapped(color, double(frame.view.exposure) * exposure, double(frame.film.white));
}

}  // namespace

std::vector<Metric> lens_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const double got = exposure_of(result), wanted = exposure_of(truth);
    const double stops = std::isfinite(got) && got > 0 ? std::abs(std::log2(got / wanted)) : HUGE_VAL;
    const auto color = truth.find("color"), found = result.find("color");
    if (color == truth.end() || found == result.end()) return {{"exposure error", "stops", stops}};
    const DisplayError display = display_error(shown(found->second, input.frame, got), shown(color->second, input.frame, wanted));
    return {{display_rmse, "of white", display.rmse},
            {"display worst", "of white", display.worst},
            {"radiance relative rmse", "", difference(found->second, color->second).relative},
            {"exposure error", "stops", stops}};
}

}  // namespace strata
