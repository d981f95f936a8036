// One rule says on which side of a blocker a surface is, for light that is injected, for surfels and for cells that are read: a
// dark room stays exactly dark wherever its wall's blocker lies, between the faces of the wall, behind one of them or before it.
// Truth: 0, as no ray passes a wall.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "tests/5_techniques/light_volume_scenes.h"

namespace strata {
namespace {

/// The wall between two_rooms behind its closed door.
struct Wall {
    double half = .05;   ///< of its thickness, meters
    double blocker = 0;  ///< x; the lit face lies at -half
    double yaw = 0;      ///< of the rooms in their grid, radians
    bool two_sided = false;
};

/// A blocker that lies so far before the lit face, in millimeters.
Wall wall_behind_blocker(int millimeters, double yaw, bool two_sided) {
    return {.blocker = -.05 - .001 * millimeters, .yaw = yaw, .two_sided = two_sided};
}

/// Whether all of a mesh lies in one of the two faces of the wall.
bool is_of_the_wall(const Mesh& mesh, float half) {
    return std::ranges::all_of(mesh.positions, [&](const glm::vec3& p) { return std::abs(std::abs(p.x) - half) < 1e-6f; });
}

/// Surfaces as they are before the rooms are turned.
Frame unturned(const Wall& wall) {
    Frame frame = two_rooms()[0];
    for (Mesh& mesh : frame.meshes)
        for (glm::vec3& p : mesh.positions)
            if (std::abs(std::abs(p.x) - .05f) < 1e-6f) p.x = std::copysign(float(wall.half), p.x);
    frame.blockers[0].center.x = frame.portals[0].center.x = wall.blocker;
    if (wall.two_sided)
        for (Draw& draw : frame.draws) {
            if (!is_of_the_wall(frame.meshes[draw.mesh], float(wall.half))) continue;
            frame.materials.push_back(frame.materials[draw.material]);
            frame.materials.back().double_sided = true;
            draw.material = std::uint32_t(frame.materials.size() - 1);
        }
    return frame;
}

/// Light on surfaces of either room: the dark one's begin with its face of the wall.
struct Light {
    double darkest_room = 0;  ///< the brightest sample of the dark room
    double lit_room = 0;      ///< the brightest sample of the other
    std::size_t dark_samples = 0;
};

Light light_of(const Wall& wall, const Run& run) {
    const Frame frame = unturned(wall);
    const HostImage& normals = run.images.at("surface_normal");
    Light light;
    for (std::uint32_t y = 0; y < run.height; ++y)
        for (std::uint32_t x = 0; x < run.width; ++x) {
            const glm::dvec4 normal = texel(normals, x, y);
            if (normal.w <= 0) continue;
            const SurfacePoint p = decoded_surface(frame, {normal, glm::dvec4(0), glm::dvec4(0)}, x, y);
            const double side = (frame.view.origin + glm::transpose(glm::dmat3(frame.view.to_view)) * p.position).x;
            const glm::dvec4 seen = texel(run.images.at("indirect"), x, y);
            const double brightest = std::max({seen.x, seen.y, seen.z});
            if (side > wall.half - 1e-3) ++light.dark_samples, light.darkest_room = std::max(light.darkest_room, brightest);
            if (side < -wall.half - .05) light.lit_room = std::max(light.lit_room, brightest);
        }
    return light;
}

void expect_a_dark_room(const std::vector<Wall>& walls, const std::vector<std::string>& sets) {
    std::vector<Frame> frames;
    for (const Wall& wall : walls) frames.push_back(turned(unturned(wall), wall.yaw));
    const auto session = session_of(frames);
    double worst = 0;
    int lit = 0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const Wall& wall = walls[i];
        const Light light = light_of(wall, must(session->run(indirect_of(i, sets))));
        ASSERT_GT(light.dark_samples, 500u);
        EXPECT_EQ(light.darkest_room, 0) << "the blocker " << 1000 * (-wall.half - wall.blocker)
                                         << " mm before the lit face of a wall " << 2000 * wall.half << " mm thick, yaw "
                                         << wall.yaw << (wall.two_sided ? ", two-sided, " : ", ") << testing::PrintToString(sets);
        EXPECT_GT(light.lit_room, .01) << wall.blocker << " " << wall.yaw;
        worst = std::max(worst, light.darkest_room), lit += int(light.darkest_room > 0);
    }
    fmt::print("yaw {:.3f}, {}-sided, {}: {} walls, {} let light through, worst {:.3g}\n", walls[0].yaw,
               walls[0].two_sided ? "two" : "one", fmt::join(sets, " "), walls.size(), lit, worst);
}

std::vector<double> six_yaws() {
    Numbers numbers(1127);
    std::vector<double> yaws;
    for (int i = 0; i < 6; ++i) yaws.push_back(double(numbers.from(0, 2 * std::numbers::pi_v<float>)));
    return yaws;
}

const std::vector<std::string> quick{"iterations=6", "map_size=64"};

// Direct light ends 15 mm behind a blocker. The floor between blocker and wall is behind it, too.
TEST(LightVolumeSides, LeaveARoomDarkWhereverTheBlockerOfItsWallLies) {
    const double yaw = six_yaws()[0];
    expect_a_dark_room({wall_behind_blocker(12, 0, false), wall_behind_blocker(30, 0, false), wall_behind_blocker(12, yaw, true),
                        wall_behind_blocker(-40, yaw, false)},
                       quick);
}

TEST(LightVolumeSides, LeaveARoomDarkBehindAThinWallThatReflectsOnBothSidesOfItsFaces) {
    std::vector<std::string> sets = quick;
    sets.push_back("bounces=2");
    expect_a_dark_room({{.half = .009, .two_sided = true}, {.half = .014, .two_sided = true}, {.half = .019, .two_sided = true}},
                       sets);
}

TEST(LightVolumeSides, AreThoseOfFuzzyOcclusionToo) {
    std::vector<std::string> sets = quick;
    sets.push_back("occlusion=both");
    expect_a_dark_room({wall_behind_blocker(12, 0, true)}, sets);
}

/// The whole sweep: 101 places of the blocker and 26 thicknesses of the wall, by yaw and by how many sides of its faces reflect.
class ExhaustiveLightVolumeSides : public testing::TestWithParam<std::tuple<std::size_t, bool>> {
protected:
    double yaw() const { return six_yaws()[std::get<0>(GetParam())]; }
    bool two_sided() const { return std::get<1>(GetParam()); }

    std::vector<Wall> walls() const {
        std::vector<Wall> walls;
        for (int millimeters = -50; millimeters <= 50; ++millimeters)
            walls.push_back(wall_behind_blocker(millimeters, yaw(), two_sided()));
        return walls;
    }
};

TEST_P(ExhaustiveLightVolumeSides, LeaveARoomDarkByOneBounce) {
    expect_a_dark_room(walls(), {"iterations=6", "map_size=64", "bounces=1"});
}

TEST_P(ExhaustiveLightVolumeSides, LeaveARoomDarkByTwoBounces) {
    expect_a_dark_room(walls(), {"iterations=6", "map_size=64", "bounces=2"});
}

TEST_P(ExhaustiveLightVolumeSides, LeaveARoomDarkBehindAThinWall) {
    std::vector<Wall> thin;
    for (int millimeters = 5; millimeters <= 30; ++millimeters)
        thin.push_back({.half = .001 * millimeters, .yaw = yaw(), .two_sided = two_sided()});
    expect_a_dark_room(thin, {"iterations=6", "map_size=64", "bounces=2"});
}

INSTANTIATE_TEST_SUITE_P(Yaws, ExhaustiveLightVolumeSides, testing::Combine(testing::Range<std::size_t>(0, 6), testing::Bool()));

}  // namespace
}  // namespace strata
