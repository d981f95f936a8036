// What holds of light propagation volumes on a device whatever their accuracy: walls stop light wholly, energy is lost where it
// is said to be and nowhere else, and neither order, scale nor place in the world changes a picture.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/support/agreement.h"

namespace strata {
namespace {

constexpr double brightest_albedo = .78;  // of both scenarios

TEST(LightVolumes, LeaveARoomBehindAClosedDoorExactlyDark) {
    const std::vector<Frame> frames = two_rooms();
    const auto session = session_of(frames);
    const std::vector<std::vector<std::string>> settings{{"propagation=linear", "iterations=16"},
                                                         {"propagation=linear", "iterations=64"},
                                                         {"propagation=clamped", "iterations=16"},
                                                         {"propagation=clamped", "iterations=64"},
                                                         {"propagation=energy_true", "iterations=16"},
                                                         {"propagation=energy_true", "iterations=64"},
                                                         {"bounces=2"},
                                                         {"bounces=2", "irradiance=face", "occlusion=both"},
                                                         {"bounces=2", "occlusion=both", "cell_storage=half"}};
    for (const std::vector<std::string>& sets : settings) {
        const Rooms closed = rooms_of(frames[0], must(session->run(indirect_of(0, sets))));
        ASSERT_GT(closed.dark.size(), 500u);
        EXPECT_EQ(std::ranges::count(closed.dark, 0.), std::ssize(closed.dark)) << testing::PrintToString(sets);
        EXPECT_GT(mean(closed.lit), .1);
        const Rooms open = rooms_of(frames[1], must(session->run(indirect_of(1, sets))));
        EXPECT_GT(mean(open.dark), 1e-3 * mean(open.lit)) << testing::PrintToString(sets);
    }
}

TEST(LightVolumes, LeaveItDarkBehindObliqueWallsToo) {
    const std::vector<Frame> frames = two_rooms();
    for (const double yaw : {.3, glm::radians(45.)}) {
        const auto session = session_of({turned(frames[0], yaw), turned(frames[1], yaw)});
        // Where samples lie is asked of the rooms before they were turned: the eye turned with them.
        const Rooms closed = rooms_of(frames[0], must(session->run(indirect_of(0)))),
                    open = rooms_of(frames[1], must(session->run(indirect_of(1))));
        ASSERT_GT(closed.dark.size(), 500u);
        EXPECT_EQ(std::ranges::count(closed.dark, 0.), std::ssize(closed.dark)) << yaw;
        EXPECT_GT(mean(closed.lit), .1) << yaw;
        EXPECT_GT(mean(open.dark), 1e-3 * mean(open.lit)) << yaw;
    }
}

TEST(LightVolumes, LeakWhereNoBlockerIsAskedOrEveryTapCounts) {
    const std::vector<Frame> frames = two_rooms();
    const auto session = session_of(frames);
    EXPECT_GT(mean(rooms_of(frames[0], must(session->run(indirect_of(0, {"occlusion=none"})))).dark), 1e-3);
    EXPECT_GT(mean(rooms_of(frames[0], must(session->run(indirect_of(0, {"taps=all"})))).dark), 1e-3);
}

/// The light of the room behind a closed door, relative to that of the room with the lamp, by what stops it.
struct Leak {
    std::string_view occlusion, taps;
    double share = 0;
};
struct TurnedLeaks {
    double yaw;  ///< of the rooms in their grid, radians
    std::array<Leak, 3> leaks;
};

// The table of passes/indirect/lpv/README.md, give or take what a device rounds.
TEST(LightVolumes, LeakAsMuchAsIsDocumented) {
    const Frame closed = two_rooms()[0];
    const auto rows = [](double none, double axial) {
        return std::array{Leak{"none", "all", none}, Leak{"axial", "all", axial}, Leak{"axial", "visible", 0}};
    };
    for (const auto& [yaw, leaks] : {TurnedLeaks{0, rows(.1166, .00804)}, TurnedLeaks{.3, rows(.1127, .00236)},
                                     TurnedLeaks{glm::radians(45.), rows(.1134, .00108)}}) {
        const auto session = session_of({turned(closed, yaw)});
        for (const Leak& leak : leaks) {
            const std::vector<std::string> sets{fmt::format("occlusion={}", leak.occlusion), fmt::format("taps={}", leak.taps)};
            const Rooms rooms = rooms_of(closed, must(session->run(indirect_of(0, sets))));
            const double share = mean(rooms.dark) / mean(rooms.lit);
            EXPECT_NEAR(share, leak.share, .02 * leak.share) << yaw << " " << fmt::format("{}", fmt::join(sets, " "));
        }
    }
}

NumberTable table_of(Session& session, const std::string& name, std::size_t frame, const std::vector<std::string>& sets) {
    Request request = indirect_of(frame, sets);
    request.outputs = {"indirect/lpv:" + name};
    return must(session.run(request)).tables.at("indirect/lpv:" + name);
}

TEST(LightVolumes, LoseNoEnergyButAtBlockersAndOverTheBorder) {
    // Closed by blockers, and by none.
    const auto session = session_of({two_rooms()[1], scenario_frames("cornell_box").front()});
    for (const std::size_t frame : {0u, 1u})
        for (const char* propagation : {"linear", "energy_true"})
            for (const char* faces : {"centre", "exact"}) {
                const NumberTable table =
                    table_of(*session, "energy", frame,
                             {std::string("propagation=") + propagation, std::string("faces=") + faces, "iterations=64"});
                ASSERT_EQ(table.rows.size(), 65u);
                const double injected = table.rows.front()[1];
                EXPECT_GT(injected, 50) << "W";
                // Rounding of propagation; sums of one float would add as much again to that of energy_true.
                const double lost = propagation == std::string("linear") ? 1e-6 : 2.5e-7;
                for (const std::vector<double>& row : table.rows)
                    EXPECT_NEAR(row[1] + row[2] + row[3], injected, lost * injected)
                        << propagation << ", " << faces << ", step " << row[0];
                const double absorbed = table.rows.back()[2], escaped = table.rows.back()[3];
                EXPECT_GT(frame == 0 ? absorbed : escaped, .5 * injected);
                EXPECT_EQ(frame == 0 ? escaped : absorbed, 0);
            }
}

TEST(LightVolumes, BounceTwiceAsTheirModelSays) {
    const std::map<std::string, std::vector<std::string>> settings{
        {"cornell_box", {"bounces=2"}}, {"two_rooms", {"bounces=2", "irradiance=face", "occlusion=both"}}};
    for (const auto& [scenario, sets] : settings) {
        Request request = on_scenario(scenario, 1);
        request.choices = chosen({"indirect/lpv"}, sets);
        const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::indirect, Against::model));
        expect_proven_within_tolerance(accuracy, *must(find_technique("indirect/lpv")), request, scenario);
    }
}

/// What surfels are made of by differences from pixel to pixel, where a mesh has no normals.
TEST(LightVolumes, BounceTwiceTheSameWithoutVertexNormals) {
    std::vector<Frame> frames{scenario_frames("cornell_box").front(), scenario_frames("cornell_box").front()};
    for (Mesh& mesh : frames[1].meshes) mesh.normals.clear(), mesh.tangents.clear();
    const auto session = session_of(frames);
    const auto energy = [&](std::size_t frame) { return table_of(*session, "bounces", frame, {"bounces=2"}).rows[1][1]; };
    EXPECT_NEAR(energy(1) / energy(0), 1, 1e-3);
}

// docs/algorithms/lighting.md N11: a loop of bounces ends where each brings less than the one before.
TEST(LightVolumes, ReflectNoMoreTheSecondTimeThanTheirSurfacesMay) {
    const auto session = session_of({two_rooms()[1], scenario_frames("cornell_box").front()});
    for (const std::size_t frame : {0u, 1u}) {
        const NumberTable table = table_of(*session, "bounces", frame, {"bounces=2"});
        ASSERT_EQ(table.rows.size(), 2u);
        EXPECT_GT(table.rows[1][1], .05 * table.rows[0][1]);
        EXPECT_LT(table.rows[1][1], brightest_albedo * table.rows[0][1]);
    }
}

TEST(LightVolumes, GrowWithTheirLightsByAnyPowerOfTwoToTheBit) {
    std::vector<Frame> frames{two_rooms()[1], two_rooms()[1]};
    for (Light& light : frames[1].lights) light.intensity *= 8;  // exact
    const auto session = session_of(frames);
    for (const char* storage : {"cell_storage=float", "cell_storage=half"}) {
        const std::vector<std::string> sets{"bounces=2", "occlusion=both", storage};  // in whatever fixed point
        const auto dim = must(session->run(indirect_of(0, sets))), bright = must(session->run(indirect_of(1, sets)));
        std::size_t compared = 0;
        for (std::uint32_t y = 0; y < dim.height; ++y)
            for (std::uint32_t x = 0; x < dim.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double a = texel(dim.images.at("indirect"), x, y)[c], b = texel(bright.images.at("indirect"), x, y)[c];
                    if (a < 0x1p-14) continue;  // half floats below this have fewer bits
                    ASSERT_EQ(8 * a, b) << x << ", " << y << ", " << storage;
                    ++compared;
                }
        EXPECT_GT(compared, 3000u);
    }
}

TEST(LightVolumes, AreTheSameInEveryRun) {
    const auto session = session_of(two_rooms());
    const std::vector<std::string> sets{"bounces=2", "occlusion=both"};
    const auto first = must(session->run(indirect_of(1, sets)));
    session->forget_memo();
    const auto again = must(session->run(indirect_of(1, sets)));
    EXPECT_TRUE(first.images.at("indirect").texels == again.images.at("indirect").texels);
}

TEST(LightVolumes, AreTheSameTenKilometersAway) {
    Frame near = two_rooms()[1], far = near;
    const glm::dvec3 away(1e4, -2e3, 1e4);
    far.view.origin += away;
    for (Draw& draw : far.draws)
        for (glm::dmat4* place : {&draw.to_world, &draw.previous_to_world}) (*place)[3] += glm::dvec4(away, 0);
    for (Light& light : far.lights) light.position += away;
    for (Blocker& blocker : far.blockers) blocker.center += away;
    for (Portal& portal : far.portals) portal.center += away;
    for (LightVolume& volume : far.light_volumes) volume.center += away;
    const auto session = session_of({near, far});
    const auto here = must(session->run(indirect_of(0))), there = must(session->run(indirect_of(1)));
    double worst = 0, most = 0;
    for (std::uint32_t y = 0; y < here.height; ++y)
        for (std::uint32_t x = 0; x < here.width; ++x) {
            const double a = texel(here.images.at("indirect"), x, y).y, b = texel(there.images.at("indirect"), x, y).y;
            worst = std::max(worst, std::abs(a - b));
            most = std::max(most, a);
        }
    EXPECT_GT(most, .5);
    EXPECT_LT(worst, 1e-3 * most);
}

TEST(LightVolumes, ThatAreForcedIntoAFrameWithoutAnyAreWhatTheirModelSays) {
    Request request = on_scenario("one_sphere");
    request.variant.force = {Feature::light_volumes};
    request.choices = chosen({"indirect/lpv"});
    const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::indirect, Against::model));
    EXPECT_GT(accuracy.compared, 0u);
    EXPECT_EQ(accuracy.model_worst, 0);
    EXPECT_THAT(must(session_of_scenarios().run(request)).notes,
                testing::Contains(testing::HasSubstr("no light volume: no light is indirect")));
}

}  // namespace
}  // namespace strata
