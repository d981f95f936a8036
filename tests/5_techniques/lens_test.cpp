// The lens and the film on the device: what a frame without them pays, what they leave as it is, exposure over frames.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/lens.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "passes/frame_images.h"
#include "passes/lens/bloom/bloom_model.h"
#include "passes/lens/exposure/exposure_model.h"
#include "tests/support/session.h"

namespace strata {
namespace {

std::size_t steps_of(const Run& run, std::string_view technique) {
    return std::size_t(
        std::ranges::count_if(run.steps, [&](const StepRecord& step) { return step.scope.technique == technique; }));
}

/// Frames of lamp_at_night with another lens and no film, at these times.
std::unique_ptr<Session> night(const Lens& lens, const std::vector<double>& times = {0}, std::uint32_t samples = 1) {
    std::vector<Frame> frames;
    for (const double time : times) {
        frames.push_back(scenario_frames("lamp_at_night", samples).front());
        frames.back().lens = lens;
        frames.back().film = {};
        frames.back().time = time;
    }
    return session_of(std::move(frames));
}

Request wanting(std::vector<std::string> outputs, std::uint32_t frame = 0, const std::vector<std::string>& sets = {}) {
    Request request{.choices = chosen({}, sets), .outputs = std::move(outputs)};
    request.variant.frame = frame;
    return request;
}

double exposure_of(Session& session, std::uint32_t frame, const std::vector<std::string>& sets = {}) {
    return in_double(must(session.run(wanting({"exposure"}, frame, sets))).images.at("exposure")).at(0, 0).x;
}

ReferenceImage color_of(Session& session, const std::vector<std::string>& sets = {}) {
    return in_double(must(session.run(wanting({"color"}, 0, sets))).images.at("color"));
}

constexpr Lens adapting{.auto_exposure = true, .exposure_speed = 2};

}  // namespace

TEST(LensAndFilm, AreLeftOutWhereAFrameHasNone) {
    const auto run = must(night({})->run(wanting({"display"})));
    EXPECT_EQ(steps_of(run, "lens/camera"), 0u);
    EXPECT_EQ(steps_of(run, "film/grain_and_fade"), 0u);
}

/// T-PP-4, and what is off in an identity: no sample changes by a bit.
TEST(LensAndFilm, AFocusedPictureKeepsItsBits) {
    for (const std::uint32_t samples : {1u, 4u}) {
        const ReferenceImage pinhole = color_of(*night({}, {0}, samples));
        const auto session = night({.bloom = 1, .focus_distance = 2.6f, .aperture = .004f, .distortion = true}, {0}, samples);
        EXPECT_EQ(color_of(*session, {"bloom=off", "distortion=off"}).texels, pinhole.texels) << samples;
        EXPECT_EQ(color_of(*session, {"bloom=off", "focus=off", "k1=0"}).texels, pinhole.texels) << samples;
        EXPECT_NE(color_of(*session).texels, pinhole.texels);
    }
}

TEST(LensAndFilm, WhatIsInFocusKeepsItsBitsBesideWhatIsNot) {
    const ReferenceImage pinhole = color_of(*night({}));
    const auto session = night({.focus_distance = 2.6f, .aperture = .25f});
    const ReferenceImage blurred = color_of(*session);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < blurred.texels.size(); ++i) kept += blurred.texels[i] == pinhole.texels[i];
    EXPECT_GT(kept, 200u) << "the lamp, the crate and the ground around them";
    EXPECT_LT(kept, 1800u);
}

/// What a capture may hold: the farthest focus, the widest aperture, a picture of one pixel, radiance beyond every format.
TEST(LensAndFilm, ExtremesOfALensAreWhatTheModelSays) {
    struct Extreme {
        const char* name;
        Lens lens;
        std::uint32_t extent = 0;  ///< pixels each way; 0: the scenario's
        float emissive = 1;
    };
    constexpr float most = std::numeric_limits<float>::max();
    const Extreme extremes[] = {
        {.name = "focus at infinity", .lens = {.focus_distance = most, .aperture = .05f}},
        {.name = "focus at 0", .lens = {.focus_distance = 0, .aperture = .01f}},
        {.name = "widest aperture", .lens = {.focus_distance = 2.6f, .aperture = most}},
        {.name = "narrowest aperture", .lens = {.focus_distance = 2.6f, .aperture = 1e-40f}},
        {.name = "one pixel",
         .lens = {.bloom = 1, .auto_exposure = true, .focus_distance = 2.6f, .aperture = 1, .distortion = true},
         .extent = 1},
        {.name = "radiance beyond half floats",
         .lens = {.bloom = 1, .auto_exposure = true, .focus_distance = 2.6f, .aperture = .25f, .distortion = true},
         .emissive = 1e30f}};
    for (const Extreme& extreme : extremes) {
        std::vector<Frame> frames{scenario_frames("lamp_at_night").front()};
        frames[0].lens = extreme.lens;
        frames[0].film = {};
        for (Material& material : frames[0].materials) material.emissive *= extreme.emissive;
        if (extreme.extent != 0) frames[0].view.width = frames[0].view.height = extreme.extent;
        const auto session = session_of(std::move(frames));
        for (const char* form : {"focus=gather", "focus=xray"}) {
            const Accuracy accuracy = must(session->judge(wanting({"display"}, 0, {form}), Stage::lens, Against::model));
            EXPECT_EQ(accuracy.incomparable, "") << extreme.name << ' ' << form;
            EXPECT_LT(accuracy.model_worst, 4e-3) << extreme.name << ' ' << form;
            for (const glm::dvec4& texel : color_of(*session, {form}).texels)
                ASSERT_TRUE(std::isfinite(texel.x)) << extreme.name << ' ' << form;
        }
    }
}

/// T-PP-3 on the device.
TEST(LensAndFilm, AConstantPictureGlowsByItsStrength) {
    std::vector<Frame> frames{scenario_frames("lamp_at_night").front()};
    frames[0].draws.clear();
    frames[0].lights.clear();
    frames[0].background = glm::vec3(.5f);
    frames[0].lens = {.bloom = .25f, .bloom_threshold = 0};
    frames[0].film = {};
    const auto session = session_of(std::move(frames));
    for (const glm::dvec4& texel : color_of(*session).texels) ASSERT_EQ(texel.x, .625);
}

/// The matrix compares colors, beside which a glow is small: here it is alone.
TEST(LensAndFilm, GlowIsWhatTheModelSays) {
    const Lens glows{.bloom = 1, .bloom_threshold = 1};
    const ReferenceImage plain = color_of(*night({}));
    const auto session = night(glows);
    const lens::Bloom bloom{.strength = 1, .threshold = 1};
    const ReferenceImage pyramid = lens::pyramid_glow(lens::glowing(plain, bloom), lens::pyramid_levels(.12, plain.height));
    const auto compare = [&](const char* form, const ReferenceImage& model) {
        const ReferenceImage got = color_of(*session, {std::string("bloom=") + form});
        double brightest = 0;
        for (std::size_t i = 0; i < got.texels.size(); ++i) {
            const double glow = got.texels[i].x - plain.texels[i].x, wanted = model.texels[i].x;
            ASSERT_NEAR(glow, wanted, .008 * wanted + 1e-5)
                << form << " at " << i << ": half floats, six of them in X-Ray's product";
            brightest = std::max(brightest, wanted);
        }
        EXPECT_GT(brightest, .5) << form;
    };
    compare("pyramid", pyramid);
    compare("xray", lens::xray_glow(plain, 1));
}

TEST(LensAndFilm, ExposureFollowsTheTimeAndStartsAnewWhereItDoesNotGoOn) {
    const auto session = night(adapting, {10, 10.25, 10.5, 9});
    const Frame frame = scenario_frames("lamp_at_night").front();
    const double luminance = *lens::measured_luminance(frame, color_of(*session), lens::exposure_exponential, 1);
    const auto target = [&](double gray) { return lens::exposure_target(luminance, .7, gray); };
    const std::string bright = "exposure_grey=2";
    EXPECT_NEAR(exposure_of(*session, 0), target(1), 1e-4) << "a frame that is replayed again";
    const double after_a_quarter = target(1) + (target(2) - target(1)) * (1 - std::exp(-.5));
    EXPECT_NEAR(exposure_of(*session, 1, {bright}), after_a_quarter, 1e-4);
    EXPECT_NEAR(exposure_of(*session, 2, {bright}), after_a_quarter + (target(2) - after_a_quarter) * (1 - std::exp(-.5)), 1e-4);
    EXPECT_NEAR(exposure_of(*session, 3), target(1), 1e-4) << "back in time";
    EXPECT_NEAR(exposure_of(*session, 2, {bright}), target(1) + (target(2) - target(1)) * (1 - std::exp(-3.)), 1e-4)
        << "1.5 s in one step";
}

TEST(LensAndFilm, ExposureIsFoundByTheTimeAfterHoursToo) {
    const double later = 1e6;
    const auto early = night(adapting, {0, .004}), late = night(adapting, {later, later + .004});
    for (Session* session : {early.get(), late.get()}) exposure_of(*session, 0);
    EXPECT_NEAR(exposure_of(*early, 1, {"exposure_grey=2"}), exposure_of(*late, 1, {"exposure_grey=2"}), 1e-6);
}

/// The model starts from what the device held: judged in the middle of a sequence, at both forms.
TEST(LensAndFilm, ExposureInASequenceIsWhatTheModelSays) {
    for (const char* form : {"exposure=exponential", "exposure=xray"}) {
        const auto session = night(adapting, {0, .1, .2});
        exposure_of(*session, 0, {form});
        exposure_of(*session, 1, {form, "exposure_grey=2"});
        const Accuracy accuracy =
            must(session->judge(wanting({"display"}, 2, {form, "exposure_grey=3"}), Stage::lens, Against::model));
        EXPECT_EQ(accuracy.incomparable, "");
        EXPECT_LT(accuracy.model_worst, 1e-5) << form;
    }
}

/// T-DT-2: but for exposure, a frame does not know which frames came before.
TEST(LensAndFilm, AFrameAloneIsItselfInASequenceButForExposure) {
    const auto session = scenario_session("lamp_at_night", 1, 2);
    const auto last_of = [&](const std::vector<std::uint32_t>& frames, const std::vector<std::string>& sets) {
        session->forget_memo();
        std::vector<std::byte> last;
        for (const std::uint32_t frame : frames)
            last = must(session->run(wanting({"display"}, frame, sets))).images.at("display").texels;
        return last;
    };
    EXPECT_EQ(last_of({1}, {"exposure=off"}), last_of({0, 1}, {"exposure=off"}));
    EXPECT_EQ(last_of({1}, {}), last_of({1, 1}, {})) << "T-DT-1";
    EXPECT_EQ(last_of({1}, {"exposure=off"}), last_of({1, 1}, {"exposure=off"})) << "from the memo";
    EXPECT_NE(last_of({1}, {}), last_of({0, 1}, {}));
}

/// T-PP-7: a pixel that is not a number stays where it is, or is gone.
TEST(LensAndFilm, OnePixelThatIsNoNumberStaysAlone) {
    const Lens all{
        .bloom = .5f, .bloom_threshold = 0, .auto_exposure = true, .focus_distance = 2.6f, .aperture = .25f, .distortion = true};
    const auto session = night(all);
    const ReferenceImage plain = color_of(*night({}));
    for (const double bad : {double(NAN), HUGE_VAL}) {
        ReferenceImage given = plain;
        given.at(20, 10) = glm::dvec4(bad, bad, bad, 1);
        for (const std::vector<std::string>& sets : {std::vector<std::string>{}, {"focus=xray", "bloom=xray", "exposure=xray"}}) {
            const auto run = must(session->run_from(wanting({"color", "exposure"}, 0, sets), Stage::combine, {{"color", given}}));
            std::size_t not_finite = 0;
            for (const glm::dvec4& texel : in_double(run.images.at("color")).texels) not_finite += !std::isfinite(texel.x);
            EXPECT_LE(not_finite, 1u);
            EXPECT_TRUE(std::isfinite(in_double(run.images.at("exposure")).at(0, 0).x));
        }
    }
}

TEST(LensAndFilm, ForcedOnAFrameWithoutThemChangeNothing) {
    auto frames = scenario_frames("lamp_at_night");
    frames[0].lens = {};
    frames[0].film = {};
    const auto session = session_of(std::move(frames));
    const auto plain = must(session->run(wanting({"color", "display"})));
    Request request = wanting({"color", "display"});
    for (const Feature feature :
         {Feature::bloom, Feature::auto_exposure, Feature::depth_of_field, Feature::lens_distortion, Feature::grain})
        request.variant.force.push_back(feature);
    const auto forced = must(session->run(request));
    EXPECT_GT(steps_of(forced, "lens/camera"), 5u);
    EXPECT_GE(steps_of(forced, "film/grain_and_fade"), 1u);
    for (const char* image : {"color", "display"})
        EXPECT_EQ(forced.images.at(image).texels, plain.images.at(image).texels) << image;
}

TEST(LensAndFilm, FadesWhatCombiningDeveloped) {
    auto frames = scenario_frames("lamp_at_night");
    frames[0].lens = {};
    frames[0].film = {.fade = 1};
    const auto session = session_of(std::move(frames));
    for (const glm::dvec4& texel : in_double(must(session->run(wanting({"display"}))).images.at("display")).texels)
        ASSERT_EQ(glm::dvec3(texel), glm::dvec3(0));
}

}  // namespace strata
