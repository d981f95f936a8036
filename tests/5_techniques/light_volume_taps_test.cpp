// What surfaces read of light propagation volumes on a device: taps ask the blockers of their macro-cell and get the bits of
// asking all.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/reference/decoded.h"
#include "passes/registry.h"
#include "replay/images/host_image.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const std::string lpv = "indirect/lpv";

Run indirect_light(Session& session, const std::vector<std::string>& sets, std::size_t frame = 0) {
    Request request{.variant = {.frame = frame}, .choices = chosen({lpv}, sets)};
    request.outputs = {"indirect", "surface_normal"};
    return must(session.run(request));
}

std::uint64_t count_of(const Run& run, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == lpv && counter.name == name) return counter.value;
    throw std::runtime_error("no counter " + std::string(name));
}

// Over 5 s of CPU: the count of blockers is a constant of shaders, so that every frame compiles its own.
TEST(LightVolumeTaps, AskTheBlockersOfTheirMacroCellAndGetTheBitsOfAskingAll) {
    const auto session =
        must(Session::open({scenario_frames("two_rooms", 1, 2)[1], with_random_blockers(33, 2), with_random_blockers(100, 3)},
                           {.validation = true}));
    for (const std::size_t frame : {0u, 1u, 2u}) {
        const auto near = indirect_light(*session, {}, frame), all = indirect_light(*session, {"macro_cells=off"}, frame);
        EXPECT_TRUE(near.images.at("indirect").texels == all.images.at("indirect").texels) << frame;
        EXPECT_EQ(count_of(near, "hidden taps"), count_of(all, "hidden taps")) << frame;
        EXPECT_GT(count_of(near, "hidden taps"), 500u) << frame;
        EXPECT_GT(count_of(near, "samples near blockers"), 0u) << frame;
        EXPECT_LT(count_of(near, "blocker tests"), (frame == 0 ? .9 : .5) * double(count_of(all, "blocker tests"))) << frame;
        EXPECT_EQ(count_of(all, "samples near blockers"), count_of(all, "samples")) << frame;
    }
}

/// Of the box some tiles are near blockers and others are not.
TEST(LightVolumeTaps, AreTheSameBitsWhereTilesNearNoBlockerHaveAShaderOfTheirOwn) {
    const auto session = session_of({scenario_frames("cornell_box", 4)[0]});
    for (const char* more : {"apply_resolution=half", "damping=2"}) {
        const auto all = indirect_light(*session, {"occlusion=axial", "iterations=4", more}),
                   tiles = indirect_light(*session, {"occlusion=axial", "iterations=4", more, "tap_tiles=on"});
        EXPECT_TRUE(tiles.images.at("indirect").texels == all.images.at("indirect").texels) << more;
        for (const char* counter : {"samples", "samples near blockers", "blocker tests", "hidden taps", "full resolution pixels"})
            EXPECT_EQ(count_of(tiles, counter), count_of(all, counter)) << counter << ", " << more;
        EXPECT_EQ(count_of(all, "tiles"), 0u);
        EXPECT_EQ(count_of(tiles, "tiles"), 64u) << "of 8x8 pixels";
        EXPECT_GT(count_of(tiles, "tiles near blockers"), 10u);
        EXPECT_LT(count_of(tiles, "tiles near blockers"), 60u);
        EXPECT_GT(count_of(all, "samples near blockers"), 100u);
        EXPECT_LT(count_of(all, "samples near blockers"), .8 * double(count_of(all, "samples")));
    }
}

TEST(LightVolumeTaps, AskNothingWhereNoBlockerIsNear) {
    Frame frame = scenario_frames("two_rooms", 1, 2)[1];
    for (Blocker& blocker : frame.blockers) blocker.center.y += 100;
    for (Portal& portal : frame.portals) portal.center.y += 100;
    const auto session = session_of({frame});
    const auto far = indirect_light(*session, {}), all = indirect_light(*session, {"macro_cells=off"});
    EXPECT_TRUE(far.images.at("indirect").texels == all.images.at("indirect").texels);
    EXPECT_EQ(count_of(far, "samples near blockers"), 0u);
    EXPECT_EQ(count_of(far, "blocker tests"), 0u);
    EXPECT_EQ(count_of(far, "hidden taps"), 0u);
}

/// A blocker's portals are found without asking all of the frame: drivers end loops of more than 65,535 turns.
TEST(LightVolumeTaps, SeeThroughAThousandWindows) {
    const Frame frame = with_a_thousand_windows();
    const auto session = session_of({frame});
    const Request request{.choices = chosen({lpv})};
    const Accuracy accuracy = must(session->judge(request, Stage::indirect, Against::model));
    expect_within_tolerance(accuracy, *must(find_technique(lpv)), request);
}

ReferenceImage view_of(Session& session, const std::string& view, const std::vector<std::string>& sets = {},
                       std::size_t frame = 0) {
    Request request{.variant = {.frame = frame}, .choices = chosen({lpv}, sets)};
    request.outputs = {lpv + ":" + view};
    return in_double(must(session.run(request)).images.at(request.outputs[0]));
}

double largest(const ReferenceImage& picture) {
    double most = 0;
    for (const glm::dvec4& texel : picture.texels) most = std::max(most, texel.x);
    return most;
}

TEST(LightVolumeTaps, AreSeenByTheBlockersNearTheirMacroCell) {
    const auto session = session_of({scenario_frames("two_rooms", 1, 2)[1]});
    const ReferenceImage near = view_of(*session, "macro-cells"), all = view_of(*session, "macro-cells", {"macro_cells=off"});
    EXPECT_EQ(largest(all), 7);
    EXPECT_LT(largest(near), 7) << "walls on both ends are never near the same cells";
    EXPECT_GE(largest(near), 3) << "in a corner";
    EXPECT_EQ(largest(view_of(*session, "macro-cells", {"taps=all"})), 0);
}

/// A grid around the left half of the left room, before the frame's own.
TEST(LightVolumeTaps, AreOfTheGridThatTheVolumeViewNames) {
    Frame frame = scenario_frames("two_rooms", 1, 2)[1];
    LightVolume left = frame.light_volumes[0];
    left.center.x = -4, left.half_extent = {2, 2, 2.8f}, left.cells = {5, 5, 7};
    frame.light_volumes.insert(frame.light_volumes.begin(), left);
    const auto session = session_of({frame});
    const ReferenceImage picture = view_of(*session, "volume");
    std::size_t first = 0, second = 0, blended = 0;
    for (const glm::dvec4& texel : picture.texels) {
        if (texel.x == 0) continue;
        ASSERT_GE(texel.x, 1);
        ASSERT_LT(texel.x, 2.5);
        (std::round(texel.x) == 1 ? first : second) += 1;
        blended += texel.x != std::round(texel.x);
    }
    EXPECT_GT(first, 100u);
    EXPECT_GT(second, 500u);
    EXPECT_GT(blended, 50u);
}

/// Frames as wide as half a cell is pixels and more: neighbors at half resolution fit.
Frame at_240(Frame frame) {
    frame.view.height = frame.view.height * 240 / frame.view.width, frame.view.width = 240;
    return frame;
}

/// Root mean square of the difference over that of the second.
double relative_error(const HostImage& image, const HostImage& wanted) {
    double error = 0, size = 0;
    const ReferenceImage a = in_double(image), b = in_double(wanted);
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        const glm::dvec3 light(b.texels[i]), difference = glm::dvec3(a.texels[i]) - light;
        error += glm::dot(difference, difference), size += glm::dot(light, light);
    }
    return std::sqrt(error / size);
}

TEST(LightVolumeTaps, AreReadByAQuarterOfThePixelsWithLittleError) {
    const auto session = must(Session::open(
        {at_240(scenario_frames("two_rooms", 1, 2)[1]), at_240(scenario_frames("cornell_box")[0])}, {.validation = true}));
    for (const std::size_t frame : {0u, 1u}) {
        const auto full = indirect_light(*session, {}, frame), half = indirect_light(*session, {"apply_resolution=half"}, frame);
        const double error = relative_error(half.images.at("indirect"), full.images.at("indirect"));
        EXPECT_GT(error, 1e-4) << frame;
        EXPECT_LT(error, frame == 0 ? .03 : .015) << frame;
        EXPECT_EQ(count_of(full, "full resolution pixels"), 0u);
        EXPECT_LT(count_of(half, "full resolution pixels"), .1 * double(count_of(half, "samples"))) << frame;
        RecordProperty(frame == 0 ? "two_rooms" : "cornell_box", std::to_string(error));
    }
}

/// What a second reading behind the surface would cost is not there with an exponent of 0: as many ways are tested as without it.
TEST(LightVolumeTaps, AreDampedOnlyWhereThatIsAskedFor) {
    const auto session = session_of({scenario_frames("two_rooms", 1, 2)[1]});
    const auto plain = indirect_light(*session, {}), off = indirect_light(*session, {"damping=0"}),
               least = indirect_light(*session, {"damping=1e-6"});
    EXPECT_TRUE(plain.images.at("indirect").texels == off.images.at("indirect").texels);
    EXPECT_EQ(count_of(plain, "blocker tests"), count_of(off, "blocker tests"));
    EXPECT_GT(count_of(least, "blocker tests"), 1.5 * double(count_of(off, "blocker tests")));
    EXPECT_LT(relative_error(least.images.at("indirect"), plain.images.at("indirect")), 1e-3);
}

void expect_what_the_model_says(Session& session, const std::vector<std::string>& sets) {
    const Request request{.choices = chosen({lpv}, sets)};
    const Accuracy accuracy = must(session.judge(request, Stage::indirect, Against::model));
    expect_within_tolerance(accuracy, *must(find_technique(lpv)), request);
    EXPECT_GT(accuracy.compared - accuracy.trivial, 1000u);
}

TEST(LightVolumeTaps, AreWhatTheModelSaysAtHalfResolution) {
    for (const std::uint32_t samples : {1u, 4u}) {
        const auto session = must(Session::open({at_240(scenario_frames("two_rooms", samples, 2)[1])}, {.validation = true}));
        expect_what_the_model_says(*session, {"apply_resolution=half"});
    }
}

TEST(LightVolumeTaps, AreWhatTheModelSaysWithDamping) {
    const auto session = session_of({scenario_frames("two_rooms", 1, 2)[1]});
    expect_what_the_model_says(*session, {"damping=2"});
    expect_what_the_model_says(*session, {"apply_resolution=half", "taps=all", "damping=0.5"});
}

/// Floors on both sides of the wall are closer than neighbors at half resolution may be.
TEST(LightVolumeTaps, CrossNoWallAtHalfResolution) {
    const Frame frame = at_240(scenario_frames("two_rooms", 1, 2)[0]);
    const auto session = session_of({frame});
    const auto run = indirect_light(*session, {"apply_resolution=half"});
    std::size_t dark = 0, lit = 0, leaking = 0;
    for (std::uint32_t y = 0; y < run.height; ++y)
        for (std::uint32_t x = 0; x < run.width; ++x) {
            const glm::dvec4 normal = texel(run.images.at("surface_normal"), x, y);
            if (normal.w <= 0) continue;
            const SurfacePoint p = decoded_surface(frame, {normal, glm::dvec4(0), glm::dvec4(0)}, x, y);
            const double side = (frame.view.origin + glm::transpose(glm::dmat3(frame.view.to_view)) * p.position).x;
            if (std::abs(side) < .04) continue;  // the door
            const bool has_light = glm::dvec3(texel(run.images.at("indirect"), x, y)) != glm::dvec3(0);
            (side < 0 ? lit : dark) += 1;
            leaking += side > 0 && has_light;
        }
    EXPECT_GT(lit, 5000u);
    EXPECT_GT(dark, 5000u);
    EXPECT_EQ(leaking, 0u);
    EXPECT_LT(count_of(run, "full resolution pixels"), .1 * double(count_of(run, "samples"))) << "most are upsampled";
}

}  // namespace
}  // namespace strata
