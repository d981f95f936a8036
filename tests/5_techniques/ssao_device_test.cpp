// Ambient occlusion on the device: nothing by default, planes that do not occlude themselves, noise that repeats, far worlds.
#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/support/endless_ground.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Request with_ssao(std::vector<std::string> sets = {}, std::vector<std::string> uses = {}) {
    uses.push_back("occlusion/ssao");
    return {.choices = chosen(uses, sets), .outputs = {"occlusion"}};
}

ReferenceImage occlusion_of(Session& session, const Request& request) {
    return in_double(must(session.run(request)).images.at("occlusion"));
}

Frame ground(std::uint32_t samples = 1) {
    return endless_ground({.eye = {0, 1.7, 0}, .target = {2, .9, -4}, .vertical_fov = 1, .width = 96, .height = 54}, samples);
}

/// Texels below 1, and the least of all.
struct Deviating {
    std::size_t texels = 0;
    double least = 1;
};
Deviating deviating(const ReferenceImage& image) {
    Deviating found;
    for (const glm::dvec4& texel : image.texels) {
        found.texels += texel.x != 1;
        found.least = std::min(found.least, texel.x);
    }
    return found;
}

std::size_t steps_of(const Run& run, std::string_view technique) {
    return std::size_t(
        std::ranges::count_if(run.steps, [&](const StepRecord& step) { return step.scope.technique == technique; }));
}

}  // namespace

TEST(AmbientOcclusion, IsLeftOutUnlessItIsAskedForAndCostsNothingThen) {
    Session& session = session_of_scenarios();
    Request request = on_scenario("corners");
    const auto plain = must(session.run(request));
    EXPECT_EQ(plain.choices.at("occlusion"), "occlusion/none");
    EXPECT_EQ(steps_of(plain, "occlusion/none"), 0u);
    EXPECT_FALSE(plain.stage_bytes.contains("occlusion"));
    request.outputs = {"occlusion", "display"};
    const auto asked = must(session.run(request));
    EXPECT_EQ(deviating(in_double(asked.images.at("occlusion"))).texels, 0u);
    EXPECT_EQ(asked.images.at("display").texels, plain.images.at("display").texels);
}

TEST(AmbientOcclusion, OfATruthThatTakesItsPlaceReachesThePictureWithoutATechniqueToo) {
    Session& session = session_of_scenarios();
    Request request = on_scenario("corners");
    request.outputs = {"color"};
    const ReferenceImage plain = in_double(must(session.run(request)).images.at("color"));
    ReferenceImage half(plain.width, plain.height, 1, glm::dvec4(.5, 0, 0, 1));
    half.channels = 1;
    const ReferenceImage given =
        in_double(must(session.run_from(request, Stage::occlusion, {{"occlusion", half}})).images.at("color"));
    std::size_t surfaces = 0;
    for (std::size_t i = 0; i < plain.texels.size(); ++i) {
        if (given.texels[i] == plain.texels[i]) continue;  // background
        ++surfaces;
        ASSERT_NEAR(given.texels[i].x, .5 * plain.texels[i].x, 1e-6);
    }
    EXPECT_GT(surfaces, plain.texels.size() / 2);
}

TEST(AmbientOcclusion, OfAPlaneInTheGBufferIsExactly1) {
    const auto deviating_with = [](std::uint32_t samples, const std::vector<std::vector<std::string>>& kinds) {
        const auto session = session_of(std::vector<Frame>{ground(samples)});
        std::size_t texels = 0;
        for (const std::vector<std::string>& sets : kinds) texels += deviating(occlusion_of(*session, with_ssao(sets))).texels;
        return texels;
    };
    EXPECT_EQ(deviating_with(4, {{}, {"ao_resolution=half"}}), 0u);
    EXPECT_EQ(deviating_with(1, {{"ao_taps=8", "ao_blur=off"},
                                 {"ao_taps=96", "ao_noise=hash", "ao_blur=off"},
                                 {"ao_radius=4m", "ao_noise=none", "ao_blur=off"}}),
              0u);
}

TEST(AmbientOcclusion, OfAPlaneInACoarserGBufferIs1WithItsErrorsAndBandsWithout) {
    const auto session = session_of(std::vector<Frame>{ground()});
    const auto packed = [&](std::vector<std::string> sets) {
        return deviating(occlusion_of(*session, with_ssao(std::move(sets), {"gbuffer/packed"})));
    };
    EXPECT_EQ(packed({"ao_depth_error=5e-4", "ao_bias=.06"}).texels, 0u);
    const Deviating bands = packed({"ao_blur=off"});
    testing::Test::RecordProperty("bands", fmt::format("{} texels below 1, the least {:.4f}", bands.texels, bands.least));
    EXPECT_GT(bands.texels, 0u) << "docs/algorithms/deferred.md 2.7: flat walls get less than 1";
}

TEST(AmbientOcclusion, OfXRayBandsOnAPlaneByTheStepsOfDepth) {
    const auto session = session_of(std::vector<Frame>{ground()});
    const Deviating bands = deviating(occlusion_of(*session, with_ssao({"ao_form=xray", "ao_blur=off"})));
    testing::Test::RecordProperty("bands", fmt::format("{} texels below 1, the least {:.4f}", bands.texels, bands.least));
    EXPECT_GT(bands.texels, 0u);
    EXPECT_GT(bands.least, .95);
}

TEST(AmbientOcclusion, IsTheSameInEveryRunAndHashedNoiseIsOfTheFrame) {
    std::vector<Frame> frames{scenario_frames("corners").front(), scenario_frames("corners").front()};
    frames[1].index = 1;
    const auto session = session_of(std::move(frames));
    const auto texels = [&](std::size_t frame, std::vector<std::string> sets) {
        Request request = with_ssao(std::move(sets));
        request.variant.frame = frame;
        request.once = true;
        return must(session->run(request)).images.at("occlusion").texels;
    };
    for (const std::string noise : {"ao_noise=interleaved", "ao_noise=hash"}) {
        EXPECT_EQ(texels(0, {noise}), texels(0, {noise}));
        EXPECT_EQ(texels(0, {noise}) == texels(1, {noise}), noise == "ao_noise=interleaved");
    }
}

// Positions reach the device relative to the camera, in double until then (docs/algorithms/deferred.md 9, H19).
TEST(AmbientOcclusion, IsTheSameTenKilometersFromTheOrigin) {
    std::vector<Frame> frames{scenario_frames("corners").front(), scenario_frames("corners").front()};
    const glm::dvec3 away(8192, 0, -8192);
    frames[1].view.origin += away;
    for (Draw& draw : frames[1].draws) draw.to_world[3] += glm::dvec4(away, 0);
    const auto session = session_of(std::move(frames));
    Request request = with_ssao();
    const ReferenceImage here = occlusion_of(*session, request);
    request.variant.frame = 1;
    const ReferenceImage there = occlusion_of(*session, request);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < here.texels.size(); ++i) differ += here.texels[i].x != there.texels[i].x;
    EXPECT_EQ(differ, 0u);
}

TEST(AmbientOcclusion, MultipliesAmbientLightAndTheDarkerOfBothIsNeverDarkerThanTheirProduct) {
    Session& session = session_of_scenarios();
    Request request = on_scenario("corners");
    const auto color = [&](const std::vector<std::string>& sets) {
        request.choices = chosen({"occlusion/ssao"}, sets);
        request.outputs = {"color", "occlusion", "surface_material"};
        return must(session.run(request)).images;
    };
    const auto product = color({}), darker = color({"ao_material=min"});
    const ReferenceImage material = in_double(product.at("surface_material")), visible = in_double(product.at("occlusion")),
                         shown = in_double(product.at("color")), less = in_double(darker.at("color"));
    std::size_t worn = 0;
    for (std::size_t i = 0; i < shown.texels.size(); ++i) {
        if (material.texels[i].x == 0) continue;
        const double m = material.texels[i].z, v = visible.texels[i].x;
        EXPECT_NEAR(shown.texels[i].x, .8 * m * v, .006) << "albedo .8 in 8 bits";
        EXPECT_NEAR(less.texels[i].x, .8 * std::min(m, v), .006);
        worn += m < .9;
    }
    EXPECT_GT(worn, 20u);
}

}  // namespace strata
