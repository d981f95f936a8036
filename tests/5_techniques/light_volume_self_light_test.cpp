// Light that returns to the surface that reflected it. Nothing of a convex surface's light reaches that surface: the truth of a
// plane in the sun is 0, and what light volumes give it is told as a share of its direct light.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "replay/images/host_image.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/5_techniques/lit_patch.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr double albedo = .5;

/// A floor of 16 x 16 m (across z) in the sun, in the middle of a volume of cells half a meter wide.
Frame sunlit_floor() {
    Frame frame;
    frame.view.width = 64, frame.view.height = 36;
    add_square(frame, glm::dvec3(0), 8);
    frame.draws.back().casts_shadow = true;
    frame.materials.back().base_color = {albedo, albedo, albedo, 1};
    Light sun;
    sun.type = LightType::directional;
    sun.direction = glm::normalize(glm::vec3(.3f, .2f, -1));
    sun.intensity = glm::vec3(10);
    frame.lights = {sun};
    frame.light_volumes = {{.kind = VolumeKind::fixed_local, .half_extent = {8, 8, 4}, .cells = {32, 32, 16}, .iterations = 16}};
    look(frame, {0, 0, 3}, {0, 1e-3, 0}, 1);
    return frame;
}

/// The most that the floor receives of its own light, relative to its direct light.
double self_light(Session& session, const std::vector<std::string>& sets) {
    const Run run = must(session.run(indirect_of(0, sets)));
    double most = 0;
    for (std::uint32_t y = 0; y < run.height; ++y)
        for (std::uint32_t x = 0; x < run.width; ++x) most = std::max(most, double(texel(run.images.at("indirect"), x, y).x));
    const double cosine = 1 / std::sqrt(.3 * .3 + .2 * .2 + 1);
    return most * std::numbers::pi / (10 * cosine);
}

TEST(LightVolumeSelfLight, IsNextToNothingOnAFloorInTheSun) {
    const auto session = session_of({sunlit_floor()});
    for (const char* iterations : {"iterations=16", "iterations=64"})
        for (const char* storage : {"cell_storage=float", "cell_storage=half"})
            EXPECT_LT(self_light(*session, {iterations, storage}), .01) << iterations << " " << storage;
}

// The table of passes/indirect/lpv/README.md.
TEST(LightVolumeSelfLight, OfASettingIsAsMuchAsIsDocumented) {
    struct Row {
        std::vector<std::string> sets;
        double share;
    };
    const auto session = session_of({sunlit_floor()});
    for (const Row& row :
         {Row{{}, 0}, Row{{"self_light=kept", "lobes=face", "propagation=energy_true"}, .280},
          Row{{"self_light=kept", "lobes=face"}, .297}, Row{{"self_light=kept"}, .222}, Row{{"self_light=uninjected"}, .250},
          Row{{"self_light=uninjected", "lobes=face"}, .325}, Row{{"self_light=kept", "reading=1.5"}, .179},
          Row{{"self_light=kept", "lobes=face", "reading=1.5"}, .340}, Row{{"self_light=kept", "lobes=face", "damping=2"}, .295},
          Row{{"self_light=kept", "lobes=face", "occlusion=fuzzy"}, .191}, Row{{"self_light=kept", "iterations=64"}, .418},
          Row{{"self_light=kept", "lobes=face", "iterations=64"}, .691},
          Row{{"self_light=uninjected", "lobes=face", "iterations=64"}, .719},
          Row{{"self_light=kept", "lobes=face", "reading=1.5", "iterations=64"}, .742}, Row{{"iterations=64"}, 0}})
        EXPECT_NEAR(self_light(*session, row.sets), row.share, .005) << testing::PrintToString(row.sets);
}

// The table of the README: on the floor and, against the truth, in a box that is lit by its own walls.
TEST(LightVolumeSelfLight, ExhaustiveIsLeastByDefaultAndNoSettingIsAFifthBetterInABox) {
    Frame box = scenario_frames("cornell_box").front();
    box.view.width = box.view.height = 64;
    const auto session = session_of({sunlit_floor(), box});
    const auto row = [&](const std::vector<std::string>& sets) {
        const double floor = self_light(*session, sets);
        const auto box_errors = must(session->judge(indirect_of(1, sets), Stage::indirect, Against::truth)).technique_errors;
        const double error = std::ranges::find(box_errors, "relative rmse", &Metric::name)->value;
        fmt::print("{:<70} floor {:.3f}  box {:.3f}\n", fmt::join(sets, " "), floor, error);
        return std::pair(floor, error);
    };
    for (const char* iterations : {"iterations=16", "iterations=36", "iterations=64"}) {
        const auto [floor, error] = row({iterations});
        EXPECT_LT(floor, .01);
        for (const char* lobes : {"lobes=face", "lobes=flow"})
            for (const char* self_light : {"self_light=kept", "self_light=uninjected", "self_light=by_facing"})
                for (const char* reading : {"reading=0.5", "reading=1.5"})
                    for (const char* damping : {"damping=0", "damping=2"}) {
                        const auto [other_floor, other_error] = row({iterations, lobes, self_light, reading, damping});
                        EXPECT_GT(other_floor, floor - .005) << iterations << lobes << self_light << reading << damping;
                        EXPECT_GT(other_error, .8 * error) << iterations << lobes << self_light << reading << damping;
                    }
    }
}

}  // namespace
}  // namespace strata
