// Marched sun shafts approach the scattering integral as maps and steps grow finer: the march knows nothing of exact intervals,
// and the truth nothing of maps.
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/view.h"
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

/// `beams` with maps and depths by rays, and the integral.
struct Beams {
    Frame frame;
    ImageSet before;
    ReferenceImage truth;

    Beams(std::uint32_t width, std::uint32_t height, std::uint32_t map_size)
        : frame((*find_scenario("beams"))->build(0, {.width = width, .height = height})) {
        frame.sun.shadow.map_size = map_size;
        frame.sun.shadow.bias = 1e-3f;
        before = {{"depth_layers", traced_depth(frame)}, {"shadow_maps", traced_maps(frame)}};
        truth = sun_shafts_truth({frame, before}).at("shafts");
    }
    ReferenceImage marched(const std::vector<std::pair<const char*, const char*>>& sets) const {
        static const std::vector<Param> params = march_params();
        Settings settings(params);
        for (const auto& [name, value] : sets) EXPECT_TRUE(settings.set(name, std::string_view(value)));
        ReferenceImage image = march_model({frame, before}, settings).at("shafts");
        image.undecided.clear();
        return image;
    }
    double error(const ReferenceImage& image) const { return difference(image, truth).relative; }
    /// Of the difference between neighbors in a row that the truth says are alike and lit: within 2 %.
    double variance_of_neighbors(const ReferenceImage& image) const {
        double sum = 0, count = 0;
        for (std::uint32_t y = 0; y < truth.height; ++y)
            for (std::uint32_t x = 0; x + 1 < truth.width; ++x) {
                const double a = truth.at(x, y).x, b = truth.at(x + 1, y).x;
                if (!(a > 0) || std::abs(a - b) > 0.02 * a) continue;
                sum += std::pow((image.at(x + 1, y).x - image.at(x, y).x) / a, 2);
                ++count;
            }
        EXPECT_GT(count, 100);
        return sum / count;
    }
};

TEST(SunShaftsConvergence, FinerMapsAndMoreStepsApproachTheIntegral) {
    const Beams coarse(32, 18, 128), fine(32, 18, 512);
    const auto error = [](const Beams& beams, const char* steps) {
        return beams.error(beams.marched({{"shaft_steps", steps}, {"shaft_blur", "off"}}));
    };
    const double coarsest = error(coarse, "32"), finer = error(coarse, "128"), finest = error(fine, "128");
    RecordProperty("errors", std::to_string(coarsest) + " " + std::to_string(finer) + " " + std::to_string(finest));
    EXPECT_LT(finer, coarsest);
    EXPECT_LT(finest, .5 * finer);
    EXPECT_LT(finest, .03);
}

TEST(SunShaftsConvergence, TheBlurTakesThreeFourthsOfTheVarianceBetweenNeighborsAndAddsNoError) {
    for (const glm::uvec2 extent : {glm::uvec2(64, 36), glm::uvec2(96, 54)}) {
        const Beams beams(extent.x, extent.y, 256);
        for (const char* steps : {"16", "32"}) {
            const ReferenceImage sharp =
                beams.marched({{"shaft_steps", steps}, {"shaft_jitter", "interleaved_gradient"}, {"shaft_blur", "off"}});
            const ReferenceImage blurred = beams.marched({{"shaft_steps", steps}});
            EXPECT_LT(beams.variance_of_neighbors(blurred), .25 * beams.variance_of_neighbors(sharp))
                << extent.x << ", " << steps;
            EXPECT_LE(beams.error(blurred), beams.error(sharp)) << extent.x << ", " << steps;
        }
    }
}

}  // namespace
}  // namespace strata::sun_shafts
