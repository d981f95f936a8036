// lighting/z_binned on the device: its picture is that of every light, its bins hold what reaches them.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/lighting/z_binned/z_bins.h"
#include "passes/reference/shade.h"
#include "passes/scene/shadow_views.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const std::string z_binned = "lighting/z_binned";

/// The hall at 64 x 36, and how many of its lights are left.
Frame hall(std::uint32_t lights) {
    const Scenario* scenario = must(find_scenario("hall_of_lights_4096"));
    Frame frame = scenario->build(0, {.width = 64, .height = 36});
    frame.lights.resize(lights);
    // Few lights would leave most pixels dark: they reach farther, and are as bright there.
    const float farther = float(std::cbrt(4096.0 / lights));
    for (Light& light : frame.lights) {
        light.range *= farther;
        light.intensity *= farther * farther;
    }
    return frame;
}

ReferenceImage light_of(const Frame& frame, const std::string& technique, std::vector<std::string> sets = {}) {
    Request request{.choices = chosen({technique}, std::move(sets)), .outputs = {"light"}};
    auto run = must(session_of_scenarios().run(frame, std::span(&request, 1))).front();
    return in_double(run.images.at("light"));
}

/// The largest difference of two pictures, relative to the larger of the two values.
double farthest_apart(const ReferenceImage& a, const ReferenceImage& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const double x = a.texels[i][channel], y = b.texels[i][channel];
            most = std::max(most, std::abs(x - y) / std::max({std::abs(x), std::abs(y), 1e-4}));
        }
    return most;
}

// One step of a half float: lights are summed by depth here and by number there.
constexpr double half_step = 1.0 / 1024;

// docs/algorithms/lighting.md 7, N10.
TEST(ZBinned, IsEveryLightWhateverTheirNumber) {
    for (const std::uint32_t lights : {1u, 31u, 32u, 33u, 63u, 64u, 65u, 255u, 256u, 257u, 4095u, 4096u}) {
        const Frame frame = hall(lights);
        const ReferenceImage truth = light_of(frame, "lighting/brute_force");
        EXPECT_GT(std::ranges::max(truth.texels, {}, [](const glm::dvec4& t) { return t.x; }).x, 0.05) << lights;
        EXPECT_LE(farthest_apart(light_of(frame, z_binned), truth), half_step) << lights << " lights";
    }
}

TEST(ZBinned, IsOnePictureForAllSettings) {
    const Frame frame = hall(300);
    const ReferenceImage picture = light_of(frame, z_binned);
    for (const char* set : {"spacing=logarithmic", "bounds=frustum", "bins=256", "tile=8", "tile=32", "merge=lanes"})
        EXPECT_EQ(farthest_apart(light_of(frame, z_binned, {set}), picture), 0) << set;
}

TEST(ZBinned, ABinHoldsAtLeastTheLightsThatReachItsDepths) {
    const Frame frame = hall(200);
    Request request{.choices = chosen({z_binned}, {"bins=256"}), .outputs = {z_binned + ":bins"}};
    const auto run = must(session_of_scenarios().run(frame, std::span(&request, 1))).front();
    const auto& rows = run.tables.at(z_binned + ":bins").rows;
    ASSERT_EQ(rows.size(), 256u);
    std::vector<lighting::DepthReach> reaches;
    for (const Light& light : light_list(frame)) {
        if (light.type == LightType::round_spot) continue;  // theirs are tighter than their range
        const float z = float(to_view(frame, light.position).z);
        reaches.push_back({z - light.range, z + light.range});
    }
    // Every light is in the span of its bins: no bin that it reaches begins after it or ends before it in the order of depth.
    std::size_t lit = 0;
    for (const auto& row : rows) {
        lit += row[3] > 0;
        const auto reaching = std::ranges::count_if(reaches, [&](const lighting::DepthReach& reach) {
            return double(reach.nearest) < row[1] && double(reach.farthest) > row[0];
        });
        EXPECT_GE(row[3], double(reaching)) << "from " << row[0] << " to " << row[1] << " m";
    }
    EXPECT_GT(lit, 100u);
}

}  // namespace
}  // namespace strata
