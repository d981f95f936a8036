// The lens in double: its effects in the order that light meets them.
#include "capture_format/frame/frame.h"
#include "passes/lens/bloom/bloom_model.h"
#include "passes/lens/depth_of_field/focus_model.h"
#include "passes/lens/distortion/radial_model.h"
#include "passes/lens/exposure/exposure_model.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::lens {

ImageSet camera_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<LensParams>();
    const Lens& lens = input.frame.lens;
    ImageSet images;
    double exposure = 1;
    if (lens.auto_exposure) {
        exposure = exposure_model(input, params);
        images["exposure"] = ReferenceImage(1, 1, 1, {exposure, 0, 0, 1});
        images["exposure"].channels = 1;
    }
    if (lens.aperture <= 0 && !lens.distortion && lens.bloom <= 0) return images;
    ReferenceImage color = input.before.at("color");
    if (lens.aperture > 0 && params.focus != focus_off) color = focus_model(input, color, params);
    if (lens.distortion && params.distortion != distortion_off && params.k1 != 0) color = radial_model(color, double(params.k1));
    if (lens.bloom > 0 && params.bloom != bloom_off) {
        const Bloom bloom{.strength = lens.bloom,
                          .threshold = lens.bloom_threshold,
                          .scale = exposure * double(input.frame.view.exposure),
                          .reach = double(params.bloom_reach)};
        const ReferenceImage glow = params.bloom == bloom_pyramid
                                        ? pyramid_glow(glowing(color, bloom), pyramid_levels(bloom.reach, color.height))
                                        : xray_glow(color, bloom.scale);
        color = with_glow(color, glow, bloom);
    }
    images["color"] = std::move(color);
    return images;
}

}  // namespace strata::lens
