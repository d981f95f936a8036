// The views of the lens show what its effects do to a picture, in the units that they state.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/lens/depth_of_field/focus_model.h"
#include "passes/lens/exposure/exposure_model.h"
#include "passes/lens/judge.h"
#include "passes/lens/lens.shared.h"
#include "passes/stage_input.h"
#include "tests/support/session.h"
#include "tests/support/thin_lens.h"

namespace strata {
namespace {

constexpr double reach = .1;  // focus_reach at its default

/// Frames of lamp_at_night with another lens, without film, at these times.
std::vector<Frame> nights(const Lens& lens, const std::vector<double>& times = {0}) {
    std::vector<Frame> frames;
    for (const double time : times) {
        frames.push_back(scenario_frames("lamp_at_night").front());
        frames.back().lens = lens;
        frames.back().film = {};
        frames.back().time = time;
    }
    return frames;
}

Run run_of(Session& session, std::vector<std::string> outputs, const std::vector<std::string>& sets = {}, std::size_t frame = 0) {
    Request request{.choices = chosen({}, sets), .outputs = std::move(outputs)};
    request.variant.frame = frame;
    return must(session.run(request));
}

ReferenceImage image_of(Session& session, const std::string& name, const std::vector<std::string>& sets = {}) {
    return in_double(run_of(session, {name}, sets).images.at(name));
}

constexpr Lens blurring{.focus_distance = 2.6f, .aperture = .25f};

TEST(LensViews, ShowTheCircleOfConfusionOfTheDepthInPixels) {
    const auto session = session_of(nights(blurring));
    const Frame frame = must(session->frame(0));
    const ReferenceImage depth = image_of(*session, "depth_layers"), thin = image_of(*session, "lens/camera:circle of confusion");
    const ReferenceImage xray = image_of(*session, "lens/camera:circle of confusion", {"focus=xray"});
    std::size_t nearer = 0, farther = 0;
    for (std::size_t i = 0; i < depth.texels.size(); ++i) {
        const double d = depth.texels[i].x, z = d > 0 ? double(frame.view.near) / d : HUGE_VAL, most = reach * frame.view.height;
        EXPECT_NEAR(thin.texels[i].x, std::clamp(lens::blur_radius(frame, z), -most, most), 1e-4) << i;
        const double ellipse = lens::xray_blur(z, 2.6f) * 2.5 / 1024 * frame.view.width;
        EXPECT_NEAR(xray.texels[i].x, z < 2.6f ? -ellipse : ellipse, 1e-5) << i;
        nearer += thin.texels[i].x < -1;
        farther += thin.texels[i].x > 1;
    }
    EXPECT_GT(nearer, 20u) << "the post";
    EXPECT_GT(farther, 500u) << "the night";
}

TEST(LensViews, CountTheTapsThatFallBeforeASurfaceOnItAndBehindIt) {
    const auto session = session_of(nights(blurring));
    const Frame frame = must(session->frame(0));
    const ImageSet before{{"color", image_of(*session, "color", {"focus=off"})},
                          {"depth_layers", image_of(*session, "depth_layers")}};
    const lens::LensParams params{.focus = lens::focus_gather, .focus_taps = lens::focus_taps_64, .focus_reach = float(reach)};
    const ReferenceImage model = lens::counted_taps({frame, before}, params);
    const ReferenceImage counted = image_of(*session, "lens/camera:taps", {"focus_taps=64"});
    std::size_t equal = 0, gathering = 0;
    for (std::size_t i = 0; i < model.texels.size(); ++i) {
        equal += glm::dvec3(counted.texels[i]) == glm::dvec3(model.texels[i]);
        gathering += counted.texels[i].y > 16;
        EXPECT_LE(std::max({counted.texels[i].x, counted.texels[i].y, counted.texels[i].z}), 64) << i;
    }
    EXPECT_GT(double(equal), .98 * double(model.texels.size())) << "but for taps that rounding moves";
    EXPECT_GT(gathering, 500u);
    const ReferenceImage xray = image_of(*session, "lens/camera:taps", {"focus=xray"});
    for (const glm::dvec4& texel : xray.texels) EXPECT_TRUE(texel.x == 0 && texel.y <= 12 && texel.z == 0);
    EXPECT_TRUE(std::ranges::any_of(xray.texels, [](const glm::dvec4& texel) { return texel.y == 12; }));
}

TEST(LensViews, ShowTheGlowThatIsAdded) {
    const auto session = session_of(nights({.bloom = .5f, .bloom_threshold = .5f, .auto_exposure = true, .distortion = true}));
    for (const char* form : {"bloom=pyramid", "bloom=xray"})
        for (const char* width : {"bloom_reach=0.12", "bloom_reach=0.005"}) {
            const ReferenceImage without = image_of(*session, "color", {"bloom=off"});
            const ReferenceImage with = image_of(*session, "color", {form, width});
            const ReferenceImage glow = image_of(*session, "lens/camera:bloom", {form, width});
            double brightest = 0;
            for (std::size_t i = 0; i < glow.texels.size(); ++i)
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(glow.texels[i][c], with.texels[i][c] - without.texels[i][c], 1e-6 + 1e-6 * with.texels[i][c])
                        << form;
                    brightest = std::max(brightest, glow.texels[i][c]);
                }
            EXPECT_GT(brightest, .1) << form << ' ' << width;
        }
}

TEST(LensViews, SayWhatExposureMeasuresWantsAndIs) {
    const auto session = session_of(nights({.auto_exposure = true, .exposure_speed = 2}, {10, 10.25}));
    const auto rows = [&](std::size_t frame, const std::vector<std::string>& sets) {
        const auto run = run_of(*session, {"lens/camera:exposure", "exposure"}, sets, frame);
        std::vector<double> row = run.tables.at("lens/camera:exposure").rows.at(0);
        row.push_back(in_double(run.images.at("exposure")).at(0, 0).x);
        return row;
    };
    const double luminance =
        *lens::measured_luminance(must(session->frame(0)), image_of(*session, "color"), lens::exposure_exponential, 1);
    const std::vector<double> first = rows(0, {}), second = rows(1, {"exposure_grey=2"});
    EXPECT_NEAR(first[0], luminance, 1e-4 * luminance);
    EXPECT_NEAR(first[1], lens::exposure_target(luminance, .7, 1), 1e-4);
    EXPECT_EQ(first[2], first[4]) << "the factor of the frame";
    EXPECT_EQ(first[3], 0) << "no frame before";
    EXPECT_NEAR(second[0], luminance, 1e-4 * luminance);
    EXPECT_NEAR(second[1], lens::exposure_target(luminance, .7, 2), 1e-4);
    EXPECT_NEAR(second[2], first[2] + (second[1] - first[2]) * (1 - std::exp(-.5)), 1e-4);
    EXPECT_EQ(second[3], first[2]);
}

TEST(LensViews, CostNothingUnlessTheyAreAskedForAndAreBlackWithoutALens) {
    const auto session = session_of(nights({}));
    const std::vector<std::string> views = {"lens/camera:circle of confusion", "lens/camera:taps", "lens/camera:bloom"};
    for (const std::string& view : views)
        for (const glm::dvec4& texel : image_of(*session, view).texels) ASSERT_EQ(glm::dvec3(texel), glm::dvec3(0)) << view;
    EXPECT_EQ(run_of(*session, {"lens/camera:exposure"}).tables.at("lens/camera:exposure").rows,
              (std::vector<std::vector<double>>{{0, 1, 1, 0}}));
    const auto lit = session_of(scenario_frames("lamp_at_night"));
    for (const StepRecord& step : run_of(*lit, {"display"}).steps) {
        EXPECT_EQ(step.name.find("lens/depth_of_field/show"), std::string::npos);
        EXPECT_NE(step.name, "lens/bloom/show.comp");
        EXPECT_NE(step.name, "lens/exposure/table.comp");
    }
}

struct FromTracedLens {
    double truth, technique, pinhole;
};

/// Errors in encoded display light against the scenario from 256 points of the lens, drawn by the device as pinhole pictures.
FromTracedLens errors_at(std::uint32_t width, std::uint32_t height) {
    std::vector<Frame> frames = nights(blurring);
    frames.front().view.width = width;
    frames.front().view.height = height;
    for (const glm::dvec2& place : lens_places(256)) frames.push_back(seen_from(frames.front(), place));
    const Frame frame = frames.front();
    const auto session = session_of(std::move(frames));
    ReferenceImage traced(width, height);
    for (std::size_t i = 1; i <= 256; ++i) {
        const ReferenceImage one = in_double(run_of(*session, {"color"}, {}, i).images.at("color"));
        for (std::size_t k = 0; k < traced.texels.size(); ++k) traced.texels[k] += one.texels[k] / 256.;
    }
    const auto from_traced = [&](const ReferenceImage& picture) {
        return lens_judge({{"color", picture}}, {{"color", traced}}, {frame, ImageSet()}).front().value;
    };
    return {.truth = from_traced(must(session->truth({}, Stage::lens)).at("color")),
            .technique = from_traced(image_of(*session, "color")),
            .pinhole = from_traced(image_of(*session, "color", {"focus=off"}))};
}

/// 20 s of CPU. A truth that filled gaps beside the lamp with the lamp was the nearer one at 256 x 144, and the farther one at
/// 512 x 288. At 64 x 36 far lights are smaller than a pixel, and a picture has them or not.
TEST(ExhaustiveThinLens, OfTheScenarioIsNearerToTheTruthThanToATechniqueAtAnySize) {
    double of_smaller = .025;  // of encoded display light
    for (const std::uint32_t width : {128u, 256u, 512u}) {
        const FromTracedLens error = errors_at(width, width * 9 / 16);
        const std::string name = std::to_string(width);
        RecordProperty("truth_" + name, std::to_string(error.truth));
        RecordProperty("technique_" + name, std::to_string(error.technique));
        RecordProperty("pinhole_" + name, std::to_string(error.pinhole));
        EXPECT_LT(error.truth, error.technique) << width;
        EXPECT_LT(error.truth, of_smaller) << width << ": more pixels are no worse";
        EXPECT_LT(error.technique, .5 * error.pinhole) << width;
        of_smaller = error.truth;
    }
}

}  // namespace
}  // namespace strata
