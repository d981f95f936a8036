// Marched sun shafts approach the scattering integral as maps and steps grow finer: the march knows nothing of exact intervals,
// and the truth nothing of maps.
#include <gtest/gtest.h>

#include "capture_format/frame.h"
#include "captures/scenarios.h"
#include "passes/reference/difference.h"
#include "passes/reference/fragments.h"
#include "passes/stage_input.h"
#include "passes/sun_shafts/march.h"
#include "passes/sun_shafts/march_model.h"
#include "passes/sun_shafts/truth.h"
#include "tests/support/traced_maps.h"

namespace strata::sun_shafts {
namespace {

ReferenceImage traced_depth(const Frame& frame) {
    const View& view = frame.view;
    const VisiblePoints visible = visible_points(frame, opaque_draws(frame));
    ReferenceImage depth(view.width, view.height);
    for (std::uint32_t y = 0; y < view.height; ++y)
        for (std::uint32_t x = 0; x < view.width; ++x) depth.at(x, y).x = visible.at(x, y).depth;
    return depth;
}

/// Relative root mean square error of `beams`.
double error(std::uint32_t map_size, const char* steps) {
    Frame frame = (*find_scenario("beams"))->build(0, {.width = 32, .height = 18});
    frame.sun.shadow.map_size = map_size;
    frame.sun.shadow.bias = 1e-3f;
    const ImageSet before{{"depth_layers", traced_depth(frame)}, {"shadow_maps", traced_maps(frame)}};
    static const std::vector<Param> params = march_params();
    Settings settings(params);
    EXPECT_TRUE(settings.set("shaft_steps", steps));
    const ReferenceImage truth = sun_shafts_truth({frame, before}).at("shafts");
    ReferenceImage marched = march_model({frame, before}, settings).at("shafts");
    marched.undecided.clear();
    return difference(marched, truth).relative;
}

TEST(SunShaftsConvergence, FinerMapsAndMoreStepsApproachTheIntegral) {
    const double coarse = error(128, "32"), finer = error(128, "128"), finest = error(512, "128");
    RecordProperty("errors", std::to_string(coarse) + " " + std::to_string(finer) + " " + std::to_string(finest));
    EXPECT_LT(finer, coarse);
    EXPECT_LT(finest, .5 * finer);
    EXPECT_LT(finest, .03);
}

}  // namespace
}  // namespace strata::sun_shafts
