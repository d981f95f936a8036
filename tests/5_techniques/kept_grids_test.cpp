// Light volumes that are kept over frames (relight=changed) where there are several grids, a sun or spots: what changes is lit
// again in the grids that it reaches, and in no other.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/5_techniques/kept_volumes.h"

namespace strata::kept_volumes {
namespace {

constexpr glm::uvec3 side_cells{10, 10, 14};
constexpr std::uint64_t cells_of_a_side = 10 * 10 * 14;

/// The lamp of the rooms elsewhere.
Light lamp_at(const Frame& rooms, const glm::dvec3& position, float range) {
    Light lamp = rooms.lights[0];
    lamp.position = position, lamp.range = range;
    return lamp;
}

/// A grid in each room, and in each a lamp whose range ends before the grid of the other. A board stands in the right room.
Frame rooms_with_a_grid_each() {
    Frame frame = still_rooms()[1];
    frame.lights = {lamp_at(frame, {-2.3, 2.1, -1.7}, 2.8f), lamp_at(frame, {2.5, 2.1, -1.7}, 2.7f)};
    frame.light_volumes.assign(2, frame.light_volumes[0]);
    for (LightVolume& volume : frame.light_volumes) volume.half_extent.x = 2, volume.cells = side_cells;
    frame.light_volumes[0].center.x = -2.7, frame.light_volumes[1].center.x = 3.1;
    constexpr std::size_t door = 16;
    Draw board = frame.draws[door];
    board.to_world[3].x += 3;
    frame.draws.push_back(board);
    return frame;
}

TEST(KeptGrids, AreLitAgainWhereALightReachesThemThatChangedAndNowhereElse) {
    std::vector<Frame> frames(5, rooms_with_a_grid_each());
    frames[1].lights[1].intensity *= 1.5f;
    frames[2].lights[0].intensity *= 1.5f;
    frames[3].draws.back().to_world[3].z += .25;  // the board, in the range of the right lamp
    frames[4].lights.pop_back();
    const auto session = session_of(frames);
    const HostImage first = lit_anew(*session, 0);
    const Lit both = kept(*session, 0);
    EXPECT_EQ(both.cells, 2 * cells_of_a_side);
    EXPECT_EQ(both.faces, 2 * faces_in(side_cells));
    EXPECT_TRUE(both.indirect.texels == first.texels);
    EXPECT_EQ(kept(*session, 0).work(), no_work);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const Lit changed = kept(*session, i);
        EXPECT_EQ(changed.cells, cells_of_a_side) << i;
        EXPECT_EQ(changed.faces, 0u) << i;
        EXPECT_LT(changed.injected, both.injected) << i;
        EXPECT_TRUE(changed.indirect.texels == lit_anew(*session, i).texels) << i;
        EXPECT_FALSE(changed.indirect.texels == first.texels) << i;
        EXPECT_EQ(kept(*session, i).work(), no_work) << i;
        const Lit back = kept(*session, 0);
        EXPECT_EQ(back.cells, cells_of_a_side) << i;
        EXPECT_TRUE(back.indirect.texels == first.texels) << i;
    }
}

TEST(KeptGrids, GoOnInSlicesEachOnItsOwn) {
    std::vector<Frame> frames(3, rooms_with_a_grid_each());
    frames[1].lights[1].intensity *= 1.5f;
    frames[2] = frames[1], frames[2].lights[0].intensity *= 1.5f;
    const auto session = session_of(frames);
    const HostImage wanted = lit_anew(*session, 2);
    const std::vector<std::string> slices{"slice=4"};
    kept(*session, 0, slices);
    EXPECT_EQ(kept(*session, 1, slices).cells, cells_of_a_side) << "the right grid begins";
    EXPECT_EQ(kept(*session, 2, slices).cells, cells_of_a_side) << "it ends, and the left one begins";
    const Lit last = kept(*session, 2, slices);
    EXPECT_EQ(last.cells, 0u) << "the left one ends";
    EXPECT_TRUE(last.indirect.texels == wanted.texels);
    EXPECT_EQ(kept(*session, 2, slices).work(), no_work);
}

/// Sun through the ceiling of the right room, on the floor around the eye, in two cascades.
Frame rooms_in_the_sun() {
    Frame frame = still_rooms()[1];
    frame.lights.clear();
    frame.sun = {.direction = glm::normalize(glm::vec3(.3f, -.85f, -.2f)), .irradiance = {5, 4, 3}};
    frame.sun.shadow.casts = true;
    for (Draw& draw : frame.draws) {
        const std::vector<glm::vec3>& positions = frame.meshes[draw.mesh].positions;
        draw.casts_shadow = !std::ranges::all_of(positions, [](const glm::vec3& p) { return p.y > 2.5f; });
    }
    frame.light_volumes = {{.kind = VolumeKind::cascaded_global,
                            .occlusion = VolumeOcclusion::axial,
                            .half_extent = {2.5f, 3, 2.5f},
                            .cells = {10, 12, 10},
                            .cascades = 2}};
    frame.view.origin = glm::dvec3(1.25, 1.75, -1.75);
    return frame;
}
constexpr std::uint64_t cells_of_a_cascade = 10 * 12 * 10;

double brightest(const HostImage& image) {
    double most = 0;
    for (std::uint32_t y = 0; y < image.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < image.shape.extent.width; ++x) most = std::max(most, double(texel(image, x, y).y));
    return most;
}

TEST(KeptGrids, UnderASunAreLitAgainInAllCascadesWhereItChanges) {
    const struct {
        const char* what;
        std::function<void(Frame&)> change;
        bool relights;
    } rows[] = {
        {"its direction", [](Frame& f) { f.sun.direction = glm::normalize(glm::vec3(.2f, -.85f, -.3f)); }, true},
        {"its irradiance", [](Frame& f) { f.sun.irradiance.z += 1; }, true},
        {"no sun", [](Frame& f) { f.sun.irradiance = glm::vec3(0); }, true},
        {"a caster", [](Frame& f) { f.draws.back().to_world[3].y += .25; }, true},
        {"how far its shadows reach", [](Frame& f) { f.sun.shadow_distance = 30; }, false},
        {"its shadows' cascades", [](Frame& f) { f.sun.cascades = 2; }, false},
    };
    std::vector<Frame> frames{rooms_in_the_sun()};
    for (const auto& row : rows) row.change(frames.emplace_back(frames.front()));
    const auto session = session_of(frames);
    const Lit first = kept(*session, 0);
    EXPECT_EQ(first.cells, 2 * cells_of_a_cascade);
    EXPECT_GT(first.injected, 200u);
    EXPECT_GT(brightest(first.indirect), .01);
    EXPECT_EQ(kept(*session, 0).work(), no_work);
    EXPECT_TRUE(first.indirect.texels == lit_anew(*session, 0).texels);
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const Lit changed = kept(*session, i + 1);
        EXPECT_EQ(changed.cells, rows[i].relights ? 2 * cells_of_a_cascade : 0u) << rows[i].what;
        EXPECT_EQ(changed.faces, 0u) << rows[i].what;
        EXPECT_TRUE(changed.indirect.texels == lit_anew(*session, i + 1).texels) << rows[i].what;
        EXPECT_TRUE(kept(*session, 0).indirect.texels == first.indirect.texels) << rows[i].what;
    }
}

/// The eye moves by a cell of the first cascade, within one of the second.
TEST(KeptGrids, ScrollOneCascadeWithoutTheOther) {
    std::vector<Frame> frames(2, rooms_in_the_sun());
    frames[1].view.origin.x += .5;
    const auto session = session_of(frames);
    kept(*session, 0);
    const Lit scrolled = kept(*session, 1);
    EXPECT_EQ(scrolled.cells, cells_of_a_cascade);
    EXPECT_EQ(scrolled.faces, 12u * 10 + 11 * 10 + 12 * 9) << "of a slab";
    EXPECT_TRUE(scrolled.indirect.texels == lit_anew(*session, 1).texels);
    EXPECT_EQ(kept(*session, 1).work(), no_work);
}

/// Three cascades, and a lamp that reaches the finest one where the eye is 1.5 m farther on: the coarsest one has not moved.
TEST(KeptGrids, AreLitByMapsThatAreAsFineWhereverTheEyeIs) {
    Frame here = still_rooms()[1];
    here.light_volumes = {{.kind = VolumeKind::cascaded_global,
                           .occlusion = VolumeOcclusion::axial,
                           .half_extent = {1, 1.5, 1},
                           .cells = {4, 6, 4},
                           .cascades = 3}};
    here.lights[0].position = {3.9, 1.75, 0};
    here.lights[0].range = 2;
    here.view.origin = {.25, 1.75, 0};
    Frame there = here;
    there.view.origin.x += 1.5;
    const auto session = session_of({here, there});
    kept(*session, 0);
    const Lit moved = kept(*session, 1);
    EXPECT_EQ(moved.cells, 2u * 4 * 6 * 4) << "of the finer ones";
    EXPECT_GT(moved.injected, 0u);
    EXPECT_TRUE(moved.indirect.texels == lit_anew(*session, 1).texels);
}

/// The left room and the right one in volumes 31 and 32, each with a lamp that reaches no other volume.
Frame rooms_in_33_volumes(double right_lamp) {
    Frame frame = still_rooms()[0];
    frame.light_volumes.clear();
    const LightVolume volume{.kind = VolumeKind::fixed_local, .half_extent = {2, 1.5, 2.5}, .cells = {8, 6, 10}};
    for (std::size_t i = 0; i < 33; ++i) {
        const double x = i < 31 ? 8. * double(i) : i == 31 ? -2.75 : 2.75;
        frame.light_volumes.push_back(volume);
        frame.light_volumes.back().center = {x, i < 31 ? -50 : 1.5, 0};
    }
    Light& left = frame.lights[0];
    left.range = 2;
    left.position = {-3, 1.5, 0};
    Light right = left;
    right.position = {right_lamp, 1.5, 0};
    frame.lights.push_back(right);
    return frame;
}

TEST(KeptGrids, BeyondThe32ndAreLitAgainAlone) {
    Frame alone = rooms_in_33_volumes(3.2);
    alone.lights.erase(alone.lights.begin());
    const auto session = session_of({rooms_in_33_volumes(3), rooms_in_33_volumes(3.2), alone});
    EXPECT_GT(kept(*session, 0).injected, 0u);
    const Lit moved = kept(*session, 1);
    EXPECT_EQ(moved.cells, 8u * 6 * 10);
    EXPECT_EQ(moved.injected, lit(*session, 2, {"relight=always"}).injected);
    EXPECT_TRUE(moved.indirect.texels == lit_anew(*session, 1).texels);
    EXPECT_TRUE(kept(*session, 0).indirect.texels == lit_anew(*session, 0).texels);
}

/// A spot in the left room that shines on the floor.
Frame rooms_with_a_spot() {
    Frame frame = still_rooms()[1];
    frame.lights[0].type = LightType::round_spot;
    frame.lights[0].direction = {0, -1, 0}, frame.lights[0].axis_u = {1, 0, 0};
    return frame;
}

TEST(KeptGrids, AreLitAgainByASpotThatTurns) {
    const struct {
        const char* what;
        std::function<void(Frame&)> change;
        bool relights, is_dark;
    } rows[] = {
        {"turned to the wall",
         [](Frame& f) {
             f.lights[0].direction = {-1, 0, 0}, f.lights[0].axis_u = {0, 0, 1};
         },
         true, false},
        {"turned around its axis",
         [](Frame& f) {
             f.lights[0].axis_u = {0, 0, 1};
         },
         true, false},
        {"narrower", [](Frame& f) { f.lights[0].inner_angle = .2f, f.lights[0].outer_angle = .4f; }, true, false},
        {"out of reach of the grid", [](Frame& f) { f.lights[0].position.y = 40; }, true, true},
        {"turned off", [](Frame& f) { f.lights.clear(); }, true, true},
        {"with another shadow map", [](Frame& f) { f.lights[0].shadow.map_size = 128; }, false, false},
    };
    std::vector<Frame> frames{rooms_with_a_spot()};
    for (const auto& row : rows) row.change(frames.emplace_back(frames.front()));
    const auto session = session_of(frames);
    const Lit first = kept(*session, 0);
    EXPECT_GT(first.injected, 200u);
    EXPECT_GT(brightest(first.indirect), .01);
    EXPECT_EQ(kept(*session, 0).work(), no_work);
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const Lit changed = kept(*session, i + 1);
        EXPECT_EQ(changed.cells > 0, rows[i].relights) << rows[i].what;
        EXPECT_EQ(changed.faces, 0u) << rows[i].what;
        EXPECT_EQ(changed.injected > 0, rows[i].relights && !rows[i].is_dark) << rows[i].what;
        EXPECT_EQ(brightest(changed.indirect) == 0, rows[i].is_dark) << rows[i].what;
        EXPECT_TRUE(changed.indirect.texels == lit_anew(*session, i + 1).texels) << rows[i].what;
        EXPECT_TRUE(kept(*session, 0).indirect.texels == first.indirect.texels) << rows[i].what;
    }
}

}  // namespace
}  // namespace strata::kept_volumes
