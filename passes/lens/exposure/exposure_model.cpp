#include "passes/lens/exposure/exposure_model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/lens/lens.shared.h"
#include "passes/luminance.h"
#include "passes/stage_input.h"

namespace strata::lens {
namespace {

struct Before {
    double exposure = 1, seconds = 0, share = 0;
    bool goes_on() const { return seconds > 0; }
};

Before before_of(const StageInput& input) {
    const auto found = input.before.find("exposure");
    if (found == input.before.end()) return {};
    const glm::dvec4& texel = found->second.at(0, 0);
    return texel.y > 0 ? Before{texel.x, texel.y, texel.z} : Before{};
}

}  // namespace

double exposure_target(double luminance, double amount, double gray) {
    constexpr double black = 1e-4;
    const double over = 1 + (gray - 1) * amount, slope = amount, at_black = (1 - amount) + black * amount;
    return std::clamp(over / (luminance * slope + at_black), 1. / 128, 20.);
}

double exponential_share(double seconds, double speed) { return -std::expm1(-seconds * speed); }

double xray_share(double share_before, double seconds, double speed) {
    return std::clamp(.9 * share_before + .1 * seconds * speed, 0., 1.);
}

std::optional<double> measured_luminance(const Frame& frame, const ReferenceImage& color, std::uint32_t form, double held) {
    double sum = 0, count = 0;
    for (const glm::dvec4& texel : color.texels) {
        if (std::isnan(texel.x) || std::isnan(texel.y) || std::isnan(texel.z)) continue;
        const glm::dvec3 exposed = glm::clamp(glm::dvec3(texel) * double(frame.view.exposure), 0., 65504.);
        const glm::dvec3 hi = glm::min(exposed * held / 9., 1.);
        sum += form == exposure_xray ? 9 * (.3 * hi.x + .38 * hi.y + .22 * hi.z) : luminance(exposed);
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
}

double exposure_model(const StageInput& input, const LensParams& params) {
    if (params.exposure == exposure_off) return 1;
    const Before before = before_of(input);
    const auto luminance = measured_luminance(input.frame, input.before.at("color"), params.exposure, before.exposure);
    if (!luminance) return before.exposure;
    const double target = exposure_target(*luminance, params.exposure_amount, params.exposure_grey);
    if (!before.goes_on()) return target;
    const double speed = input.frame.lens.exposure_speed;
    const double share = params.exposure == exposure_xray ? xray_share(before.share, before.seconds, speed)
                                                          : exponential_share(before.seconds, speed);
    return before.exposure + (target - before.exposure) * share;
}

}  // namespace strata::lens
