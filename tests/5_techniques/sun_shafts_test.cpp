// Sun shafts on the device: min-max maps change no bit and spare most reads, runs repeat, and combine adds what the stage gives.
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/shadow_use.h"
#include "capture_format/view.h"
#include "passes/frame_images.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Request with_shafts(const std::string& technique, const std::vector<std::string>& sets = {}) {
    Request request = on_scenario("beams");
    request.choices = chosen({"sun_shafts/" + technique}, sets);
    request.outputs = {"shafts"};
    return request;
}

/// What the chosen technique of the stage counted.
std::uint64_t counted_by_shafts(const Run& run, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique.starts_with("sun_shafts/") && counter.name == name) return counter.value;
    ADD_FAILURE() << "nothing counts " << name;
    return 0;
}

Run run_of(const std::string& technique, const std::vector<std::string>& sets) {
    return must(session_of_scenarios().run(with_shafts(technique, sets)));
}

/// A floor under a roof, both of 120 by 120 m: in between, everything in reach of the picture is in shadow, if the roof casts
/// one. The sun's irradiance is 1.
Frame under_a_roof(ShadowUse shadow) {
    Frame frame;
    frame.view = look_at({.eye = {0, 0, 0}, .target = {.3, -2, -3}, .vertical_fov = 1, .width = 32, .height = 18});
    Mesh mesh;
    for (const float y : {-1.5f, 3.f})
        for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)})
            mesh.positions.emplace_back(60 * corner.x, y, 60 * corner.y);
    mesh.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    frame.meshes.push_back(mesh);
    frame.materials.push_back({.lighting_model = LightingModel::lambert, .double_sided = true});
    frame.draws.push_back({});
    frame.sun = {.direction = glm::normalize(glm::vec3(.3f, -1, .2f)), .irradiance = glm::vec3(1), .shadow = shadow};
    frame.sun.shadow_distance = 20;
    frame.sun.shafts = true;
    frame.fog.density = .1f;
    return frame;
}

ReferenceImage shafts_of(const Frame& frame, const std::vector<std::string>& sets) {
    const auto session = session_of(std::vector<Frame>{frame});
    const Request request{.choices = chosen({"sun_shafts/ray_march"}, sets), .outputs = {"shafts"}};
    return in_double(must(session->run(request)).images.at("shafts"));
}

}  // namespace

TEST(SunShafts, OverMinMaxMapsAreTheSameToTheBitAndReadLess) {
    const std::vector<std::vector<std::string>> kinds = {{},
                                                         {"shaft_taps=1", "shaft_steps=64"},
                                                         {"shaft_stepping=xray", "shaft_jitter=hash"},
                                                         {"shaft_resolution=half", "allocation=need"},
                                                         {"shaft_cascade=last", "shaft_extinction=sampled"}};
    for (const std::vector<std::string>& sets : kinds) {
        SCOPED_TRACE(testing::PrintToString(sets));
        const auto plain = run_of("ray_march", sets), quick = run_of("ray_march_min_max", sets);
        EXPECT_EQ(plain.images.at("shafts").texels, quick.images.at("shafts").texels);
        EXPECT_EQ(counted_by_shafts(plain, "kilosteps"), counted_by_shafts(quick, "kilosteps"));
        const std::uint64_t skipped = counted_by_shafts(quick, "kiloskipped"), steps = counted_by_shafts(quick, "kilosteps");
        RecordProperty("skipped", std::to_string(double(skipped) / double(steps)));
        EXPECT_GT(skipped, steps / 2);
        EXPECT_LT(counted_by_shafts(quick, "kilofetches"), counted_by_shafts(plain, "kilofetches") / 2);
        EXPECT_EQ(counted_by_shafts(quick, "kilosteps_in_segments"), 0u);
    }
}

TEST(SunShafts, DecidedByTheSegmentAreTheSameToTheBitAndReadFewerBoundsWhereStepsAreShort) {
    const std::vector<std::vector<std::string>> kinds = {
        {"shaft_steps=128"},
        {"shaft_steps=128", "shaft_taps=1", "shaft_jitter=hash", "shaft_stepping=xray", "allocation=need"},
        {"shaft_steps=20", "shaft_resolution=half", "shaft_cascade=last", "shaft_normalization=steps"}};
    for (const std::vector<std::string>& sets : kinds) {
        const auto plain = run_of("ray_march", sets), alone = run_of("ray_march_min_max", sets);
        for (const char* segment : {"shaft_segment=7", "shaft_segment=16"}) {
            SCOPED_TRACE(testing::PrintToString(sets) + segment);
            std::vector<std::string> with_segments = sets;
            with_segments.push_back(segment);
            const auto quick = run_of("ray_march_min_max", with_segments);
            EXPECT_EQ(plain.images.at("shafts").texels, quick.images.at("shafts").texels);
            EXPECT_EQ(counted_by_shafts(quick, "kiloskipped"), counted_by_shafts(alone, "kiloskipped"))
                << "whoever decides steps, those that bounds leave open are the same";
            EXPECT_EQ(counted_by_shafts(quick, "kilofetches"), counted_by_shafts(alone, "kilofetches"));
            if (sets.front() != "shaft_steps=128") continue;
            EXPECT_GT(counted_by_shafts(quick, "kilosteps_in_segments"), counted_by_shafts(quick, "kilosteps") / 4);
            EXPECT_LT(counted_by_shafts(quick, "kilobounds"), counted_by_shafts(alone, "kilobounds"));
        }
    }
}

// Windows for the kernel of 2 x 2 texels are those that four texels of a step need.
TEST(SunShafts, OverTheBoundsOfMinMaxShadowsAreTheSameToTheBit) {
    const auto plain = run_of("ray_march", {}), own = run_of("ray_march_min_max", {});
    const std::uint64_t alone = counted_by_shafts(own, "kiloskipped");
    const std::vector<std::string> widths = {"kernel=2x2", "kernel=8x8"};
    for (const std::string& kernel : widths) {
        Request request = with_shafts("ray_march_min_max");
        request.choices = chosen({"shadows/min_max", "sun_shafts/ray_march_min_max"}, {kernel, "shaft_bounds=shared"});
        const auto shared = must(session_of_scenarios().run(request));
        EXPECT_EQ(plain.images.at("shafts").texels, shared.images.at("shafts").texels) << kernel;
        const std::uint64_t skipped = counted_by_shafts(shared, "kiloskipped");
        if (kernel == widths.front()) {
            EXPECT_EQ(skipped, alone);
        } else {
            EXPECT_LT(skipped, alone) << "wider windows decide less";
        }
    }
}

TEST(SunShafts, CountStepsBy1024WithoutLosingAny) {
    for (const char* steps : {"shaft_steps=8", "shaft_steps=31"}) {
        const auto run = run_of("ray_march", {steps});
        const std::uint64_t all = counted_by_shafts(run, "rays") * std::stoull(std::string(steps).substr(12));
        EXPECT_EQ(counted_by_shafts(run, "kilosteps"), all / 1024);
    }
}

TEST(SunShafts, AreTheSameInEveryRun) {
    Session& session = session_of_scenarios();
    for (const char* jitter : {"shaft_jitter=interleaved_gradient", "shaft_jitter=hash"}) {
        Request request = with_shafts("ray_march", {jitter});
        request.once = true;
        EXPECT_EQ(must(session.run(request)).images.at("shafts").texels, must(session.run(request)).images.at("shafts").texels);
    }
}

// T-SS-1 and T-SS-2 of docs/algorithms/deferred.md 6.7.
TEST(SunShafts, OfAirThatIsLitThroughoutAre1AndUnderARoofExactly0) {
    const std::vector<std::string> sets = {"shaft_normalization=steps", "shaft_intensity=1", "shaft_steps=20"};
    for (const glm::dvec4& texel : shafts_of(under_a_roof({}), sets).texels) ASSERT_EQ(texel.x, 1);
    for (const glm::dvec4& texel : shafts_of(under_a_roof({.casts = true, .map_size = 256}), sets).texels) ASSERT_EQ(texel.x, 0);
}

TEST(SunShafts, AreAddedToTheColorAndNowhereWithoutTheStage) {
    Frame dark = scenario_frames("beams").front();
    dark.sun.shafts = false;
    const auto session = session_of(std::vector<Frame>{scenario_frames("beams").front(), dark});
    Request request{.outputs = {"color", "shafts"}};
    const auto lit = must(session->run(request));
    request.variant.frame = 1;
    request.outputs = {"color"};
    const auto plain = must(session->run(request));
    EXPECT_FALSE(plain.choices.contains("sun_shafts"));
    const ReferenceImage with = in_double(lit.images.at("color")), shafts = in_double(lit.images.at("shafts")),
                         without = in_double(plain.images.at("color"));
    for (std::size_t i = 0; i < with.texels.size(); ++i)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(with.texels[i][c], without.texels[i][c] + shafts.texels[i][c], 1e-6);
}

}  // namespace strata
