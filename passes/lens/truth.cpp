#include "passes/lens/truth.h"

#include "capture_format/frame/frame.h"
#include "passes/lens/bloom/bloom_model.h"
#include "passes/lens/bloom/scattered.h"
#include "passes/lens/depth_of_field/truth.h"
#include "passes/lens/distortion/radial_model.h"
#include "passes/lens/exposure/exposure_model.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

// What the frame does not record.
constexpr double k1 = .1, bloom_reach = .12;
constexpr lens::LensParams defaults{.exposure = lens::exposure_exponential,
                                    .exposure_amount = .7f,
                                    .exposure_grey = 1,
                                    .bloom = {},
                                    .bloom_reach = {},
                                    .focus = {},
                                    .focus_taps = {},
                                    .focus_reach = {},
                                    .distortion = {},
                                    .k1 = {}};

}  // namespace

ImageSet lens_truth(const StageInput& input) {
    const Lens& recorded = input.frame.lens;
    ImageSet images;
    double exposure = 1;
    if (recorded.auto_exposure) {
        exposure = lens::exposure_model(input, defaults);
        images["exposure"] = ReferenceImage(1, 1, 1, {exposure, 0, 0, 1});
    }
    if (recorded.aperture <= 0 && !recorded.distortion && recorded.bloom <= 0) return images;
    ReferenceImage color = input.before.at("color");
    if (recorded.aperture > 0) color = lens::seen_through_lens(input, color);
    if (recorded.distortion) color = lens::radial_model(color, k1);
    if (recorded.bloom > 0) {
        const lens::Bloom bloom{.strength = recorded.bloom,
                                .threshold = recorded.bloom_threshold,
                                .scale = exposure * double(input.frame.view.exposure),
                                .reach = bloom_reach};
        const std::uint32_t levels = lens::pyramid_levels(bloom_reach, color.height);
        color = lens::with_glow(color, lens::scattered(lens::glowing(color, bloom), levels), bloom);
    }
    images["color"] = std::move(color);
    return images;
}

}  // namespace strata
