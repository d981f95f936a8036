// Light volumes that are kept over frames (relight=changed): what did not change is not lit again, and the picture is that of
// volumes that are lit in every frame, bit by bit.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/indirect/lpv/grids_model.h"
#include "passes/scene/frustum.h"
#include "passes/scene/scene_facts.h"
#include "tests/5_techniques/kept_volumes.h"

namespace strata::kept_volumes {
namespace {

/// The door half open, and the same frame changed.
std::vector<Frame> rooms_and(const std::function<void(Frame&)>& change) {
    std::vector<Frame> frames(2, still_rooms()[1]);
    change(frames[1]);
    return frames;
}

constexpr std::uint64_t room_cells = 24 * 10 * 14;

TEST(KeptVolumes, AreLitOnceWhereNothingChanges) {
    const auto session = session_of(still_rooms());
    const Lit anew = lit(*session, 1, {"relight=always"}), first = kept(*session, 1), second = kept(*session, 1);
    EXPECT_EQ(anew.work(), lit(*session, 1, {"taps=all", "relight=always"}).work()) << "in every frame";
    EXPECT_GT(first.injected, 500u);
    EXPECT_EQ(first.cells, room_cells);
    EXPECT_EQ(first.faces, faces_in({24, 10, 14}));
    EXPECT_EQ(first.work(), anew.work());
    EXPECT_EQ(second.work(), no_work);
    EXPECT_TRUE(first.indirect.texels == anew.indirect.texels);
    EXPECT_TRUE(second.indirect.texels == anew.indirect.texels);
}

TEST(KeptVolumes, DrawCastersIntoTheMapsThatSeeThem) {
    const Frame frame = still_rooms()[1];
    const SceneFacts facts(frame);
    const glm::dvec3 lamp = frame.view.to_view * (frame.lights[0].position - frame.view.origin);
    std::uint64_t around = 0;  // casters by sides of a cube around the lamp
    for (const std::uint32_t draw : facts.lists().casters) {
        const BoundingSphere& caster = facts.bounds().spheres[draw];
        for (int side = 0; side < 6; ++side) {
            glm::dvec3 along(0), u(0);
            along[side / 2] = side % 2 == 0 ? 1 : -1;
            u[(side / 2 + 1) % 3] = 1;
            const glm::dvec3 offset = glm::transpose(frame.view.to_view) * (caster.center - lamp);
            const glm::dvec3 seen(glm::dot(offset, u), glm::dot(offset, glm::cross(along, u)), glm::dot(offset, along));
            around += Frustum(glm::dvec2(1), .05).meets(BoundingSphere{seen, caster.radius}) ? 1 : 0;
        }
    }
    const auto session = session_of({frame});
    const auto drawn = [&] { return counter_of(must(session->run(coarse_light_of(0, {}))), "map casters"); };
    const std::uint64_t first = drawn();
    EXPECT_GT(first, facts.lists().casters.size());
    EXPECT_LE(first, around);
    EXPECT_LT(around, 6 * facts.lists().casters.size());
    EXPECT_EQ(drawn(), 0u);
}

/// Faces between cells near the portals of two frames. A portal of a frame opens ways that cross its wall within half a cell's
/// diagonal of the face's middle.
std::uint64_t faces_near_the_doors(const Frame& a, const Frame& b) {
    using namespace strata::indirect::in_double;
    const Grid grid = grids(a).front();
    const double reach = .867 * grid.cell_size;
    const auto is_near = [&](const glm::dvec3& middle, const Portal& portal) {
        const glm::dvec3 offset = middle - portal.center;
        return std::abs(offset.x) <= reach &&
               glm::length(offset) <= std::hypot(double(portal.half_u), double(portal.half_v)) + reach;
    };
    std::uint64_t count = 0;
    for (std::uint32_t i = 0; i < cell_count(grid); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const glm::ivec3 cell(i % grid.cells.x, i / grid.cells.x % grid.cells.y, i / (grid.cells.x * grid.cells.y));
            glm::ivec3 next = cell;
            ++next[axis];
            const glm::dvec3 middle = .5 * (cell_middle(grid, cell) + cell_middle(grid, next));
            if (is_inside(grid, next) && (is_near(middle, a.portals[0]) || is_near(middle, b.portals[0]))) ++count;
        }
    return count;
}

TEST(KeptVolumes, FindLinksAgainNearADoorThatMoves) {
    const std::vector<Frame> frames = still_rooms();
    const auto session = session_of(frames);
    const HostImage half = lit_anew(*session, 1), wide = lit_anew(*session, 2);
    ASSERT_FALSE(half.texels == wide.texels);
    kept(*session, 1);
    const Lit opened = kept(*session, 2), closed_again = kept(*session, 1);
    const std::uint64_t near = faces_near_the_doors(frames[1], frames[2]);
    EXPECT_LT(near, faces_in({24, 10, 14}) / 10);
    EXPECT_EQ(opened.faces, near);
    EXPECT_EQ(closed_again.faces, near);
    EXPECT_EQ(opened.cells, room_cells);
    EXPECT_TRUE(opened.indirect.texels == wide.texels);
    EXPECT_TRUE(closed_again.indirect.texels == half.texels);
}

/// A small window in the wall beside the lamp, recorded before the door, whose blocker comes first.
Frame with_a_window_before_the_door(Frame frame) {
    const Blocker& wall = frame.blockers[1];
    frame.portals.insert(frame.portals.begin(),
                         {.center = wall.center, .u = wall.u, .v = wall.v, .half_u = .3f, .half_v = .3f, .blocker = 1});
    for (Light& light : frame.lights)
        for (std::uint32_t& portal : light.portals) ++portal;
    return frame;
}

TEST(KeptVolumes, FindLinksAgainNearTheDoorInWhateverOrderPortalsAreRecorded) {
    const std::vector<Frame> rooms = still_rooms();
    const auto session = session_of({with_a_window_before_the_door(rooms[1]), with_a_window_before_the_door(rooms[2])});
    const HostImage wide = lit_anew(*session, 1);
    kept(*session, 0);
    const Lit opened = kept(*session, 1);
    EXPECT_EQ(opened.faces, faces_near_the_doors(rooms[1], rooms[2]));
    EXPECT_TRUE(opened.indirect.texels == wide.texels);
}

TEST(KeptVolumes, KeepTheirLinksWhereALightChanges) {
    const auto session = session_of(rooms_and([](Frame& frame) { frame.lights[0].position.x -= .3; }));
    const HostImage wanted = lit_anew(*session, 1);
    kept(*session, 0);
    const Lit changed = kept(*session, 1);
    EXPECT_EQ(changed.faces, 0u);
    EXPECT_EQ(changed.cells, room_cells);
    EXPECT_GT(changed.injected, 500u);
    EXPECT_TRUE(changed.indirect.texels == wanted.texels);
}

TEST(KeptVolumes, AreLitAnewForWhateverTheirLightDependsOnAndForNothingElse) {
    constexpr std::size_t door = 16;
    const struct {
        const char* what;
        std::function<void(Frame&)> change;
        bool relights;
    } rows[] = {
        {"a light's color", [](Frame& f) { f.lights[0].intensity.y += 1; }, true},
        {"a light's range", [](Frame& f) { f.lights[0].range = 13; }, true},
        {"a material's color", [](Frame& f) { f.materials[f.draws[0].material].base_color.x *= .5f; }, true},
        {"a caster's place", [](Frame& f) { f.draws.front().to_world[3].y -= .25; }, true},
        {"a vertex", [](Frame& f) { f.meshes[f.draws[door].mesh].positions[0].x += .01f; }, true},
        {"a caster that is one no more", [](Frame& f) { f.draws[0].casts_shadow = false; }, true},
        {"a blocker", [](Frame& f) { f.blockers[3].half_u -= .125f; }, true},
        {"the grid's place", [](Frame& f) { f.light_volumes[0].center.y += .125; }, true},
        {"how often it is iterated, which the setting overrides", [](Frame& f) { f.light_volumes[0].iterations = 9; }, false},
        {"what is behind the rooms", [](Frame& f) { f.background *= 2; }, false},
        {"a light's shadow map", [](Frame& f) { f.lights[0].shadow.map_size = 256; }, false},
        {"light from all around",
         [](Frame& f) {
             f.hemisphere.sky = {.1f, .2f, .3f};
         },
         false},
        {"a name", [](Frame& f) { f.draws[0].name = "floor", f.materials[0].name = "planks"; }, false},
    };
    std::vector<Frame> frames{still_rooms()[1]};
    for (const auto& row : rows) row.change(frames.emplace_back(frames.front()));
    const auto session = session_of(frames);
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        kept(*session, 0);
        const Lit changed = kept(*session, i + 1);
        EXPECT_EQ(changed.cells > 0, rows[i].relights) << rows[i].what;
        EXPECT_TRUE(changed.indirect.texels == lit_anew(*session, i + 1).texels) << rows[i].what;
    }
}

TEST(KeptVolumes, AreTheSameInAnyOrderOfFrames) {
    std::vector<Frame> frames = still_rooms();
    frames.push_back(frames[2]);
    frames.back().blockers.pop_back();
    frames.back().lights[0].blockers.pop_back();
    frames.push_back(frames[1]);
    frames.back().lights.push_back(frames.back().lights[0]);
    frames.back().lights.back().position.x = 2;
    const auto session = session_of(frames);
    std::vector<HostImage> wanted;
    for (std::size_t i = 0; i < frames.size(); ++i) wanted.push_back(lit_anew(*session, i));
    for (const std::size_t i : {0u, 3u, 1u, 4u, 2u, 3u, 3u, 0u, 4u, 1u, 0u, 2u, 4u, 3u, 0u})
        EXPECT_TRUE(kept(*session, i).indirect.texels == wanted[i].texels) << i;
}

/// A cascade of cells of half a meter around an eye in the right room that stands so many cells away from its first place.
Frame rooms_with_a_cascade(const glm::ivec3& cells_away) {
    Frame frame = still_rooms()[1];
    frame.light_volumes = {{.kind = VolumeKind::cascaded_global,
                            .occlusion = VolumeOcclusion::axial,
                            .half_extent = {4, 3, 4},
                            .cells = {16, 12, 16}}};
    frame.view.origin = glm::dvec3(1.25, 1.75, 1.25) + .5 * glm::dvec3(cells_away);
    return frame;
}

TEST(KeptVolumes, FindTheLinksOfASlabWhereACascadeScrolls) {
    constexpr std::uint64_t nx = 16, ny = 12, nz = 16;
    const struct {
        glm::ivec3 away;
        std::uint64_t faces;
    } rows[] = {{{1, 0, 0}, ny * nz + (ny - 1) * nz + ny * (nz - 1)},
                {{0, -1, 0}, nx * nz + (nx - 1) * nz + nx * (nz - 1)},
                {{0, 0, -2}, 2 * (nx * ny + (nx - 1) * ny + nx * (ny - 1))},
                {{-20, 0, 0}, faces_in({nx, ny, nz})}};
    std::vector<Frame> frames{rooms_with_a_cascade({0, 0, 0})};
    for (const auto& row : rows) frames.push_back(rooms_with_a_cascade(row.away));
    const auto session = session_of(frames);
    const HostImage here = lit_anew(*session, 0);
    EXPECT_EQ(kept(*session, 0).faces, faces_in({nx, ny, nz}));
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const Lit scrolled = kept(*session, i);
        EXPECT_EQ(scrolled.faces, rows[i - 1].faces) << i;
        EXPECT_EQ(scrolled.cells, nx * ny * nz);
        EXPECT_TRUE(scrolled.indirect.texels == lit_anew(*session, i).texels) << i;
        const Lit back = kept(*session, 0);
        EXPECT_EQ(back.faces, rows[i - 1].faces);
        EXPECT_TRUE(back.indirect.texels == here.texels) << i;
    }
    EXPECT_EQ(kept(*session, 0).work(), no_work);
}

TEST(KeptVolumes, ShowTheOldLightUntilTheSlicesOfTheNewAreDone) {
    const auto session = session_of(rooms_and([](Frame& frame) { frame.lights[0].intensity *= 1.5f; }));
    const HostImage old_light = lit_anew(*session, 0), new_light = lit_anew(*session, 1);
    for (const int slice : {1, 3, 8, 10}) {
        session->forget_memo();
        const std::string set = "slice=" + std::to_string(slice);
        EXPECT_TRUE(kept(*session, 0, {set}).indirect.texels == old_light.texels) << "the first is lit at once";
        const int frames = (8 + slice - 1) / slice;
        for (int i = 1; i <= frames; ++i) {
            const Lit now = kept(*session, 1, {set});
            EXPECT_EQ(now.cells, i == 1 ? room_cells : 0u);
            EXPECT_TRUE(now.indirect.texels == (i < frames ? old_light : new_light).texels) << slice << ", frame " << i;
        }
        EXPECT_EQ(kept(*session, 1, {set}).work(), no_work);
    }
}

TEST(KeptVolumes, EndTheLightThatTheyBeganBeforeTheyBeginAnother) {
    std::vector<Frame> frames(3, still_rooms()[1]);
    frames[1].lights[0].intensity *= 2;
    frames[2].lights[0].intensity *= 3;
    const auto session = session_of(frames);
    const HostImage first = lit_anew(*session, 0), second = lit_anew(*session, 1), third = lit_anew(*session, 2);
    const std::string slice = "slice=4";
    const auto shows = [&](std::size_t frame, const HostImage& wanted) {
        EXPECT_TRUE(kept(*session, frame, {slice}).indirect.texels == wanted.texels) << frame;
    };
    shows(0, first);
    shows(1, first);
    shows(2, second);  // begun two frames ago
    shows(2, second);
    shows(2, third);
    shows(1, third);
    shows(2, third);  // what was begun for the frame before is dropped
    EXPECT_EQ(kept(*session, 2, {slice}).work(), no_work);
}

TEST(KeptVolumes, StartWithNothingAfterARunThatStoppedHalfway) {
    const auto session = session_of(still_rooms());
    const HostImage wanted = lit_anew(*session, 0);
    for (const char* step : {"decide", "faces", "inject.comp", "propagate"}) {
        kept(*session, 0);
        Request halfway = coarse_light_of(1, {"relight=changed"});
        halfway.until = step;
        must(session->run(halfway));
        EXPECT_TRUE(kept(*session, 0).indirect.texels == wanted.texels) << step;
    }
}

/// Light of which a part of the picture is dark: where it leaks, that is lit.
void expect_dark_in_part(const HostImage& light) {
    std::size_t dark = 0;
    double most = 0;
    for (std::uint32_t y = 0; y < light.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < light.shape.extent.width; ++x) {
            const double red = texel(light, x, y)[0];
            dark += red == 0 ? 1 : 0;
            most = std::max(most, red);
        }
    EXPECT_GT(dark, 300u);
    EXPECT_GT(most, .5);
}

TEST(KeptVolumes, AreKeptWhereTheEyeMoves) {
    std::vector<Frame> frames(2, still_rooms()[0]);
    frames[1].view = scenario_frames("two_rooms", 1, 3)[2].view;
    const auto session = session_of(frames);
    kept(*session, 0);
    const Lit moved = kept(*session, 1);
    EXPECT_EQ(moved.work(), no_work);
    expect_dark_in_part(moved.indirect);
    EXPECT_TRUE(moved.indirect.texels == lit_anew(*session, 1).texels);
}

/// Frames of the rooms with the door closed whose cells have middles so many meters off the plane of the wall between them, seen
/// by an eye that moves.
std::vector<Frame> rooms_around_middles(double off_plane) {
    std::vector<Frame> frames;
    for (const glm::dvec3& moved :
         {glm::dvec3(0), glm::dvec3(.37, .11, -.23), glm::dvec3(-.13, .29, .41), glm::dvec3(.77, -.31, .17)}) {
        Frame& frame = frames.emplace_back(still_rooms().front());
        frame.light_volumes[0].center.x = .2 + off_plane;
        frame.view.origin += moved;
    }
    return frames;
}

TEST(KeptVolumes, AreKeptWhereTheEyeMovesAndMiddlesLieOnTheWall) {
    const auto session = session_of(rooms_around_middles(0));
    kept(*session, 0);
    for (const std::size_t i : {1u, 2u, 3u}) {
        const Lit moved = kept(*session, i);
        EXPECT_EQ(moved.work(), no_work);
        EXPECT_TRUE(moved.indirect.texels == lit_anew(*session, i).texels) << i;
    }
}

TEST(KeptVolumes, AreLitAnewForAnotherEyeWhereItDecidesOnWhichSideOfAWallAMiddleIs) {
    const auto session = session_of(rooms_around_middles(-1e-3));
    kept(*session, 0);
    for (const std::size_t i : {1u, 2u, 3u, 0u}) {
        const Lit moved = kept(*session, i);
        EXPECT_EQ(moved.cells, room_cells);
        EXPECT_EQ(moved.faces, faces_in({24, 10, 14}));
        EXPECT_TRUE(moved.indirect.texels == lit_anew(*session, i).texels) << i;
        EXPECT_EQ(kept(*session, i).work(), no_work);
    }
}

TEST(KeptVolumes, AreNotChangedByViews) {
    const auto session = session_of(still_rooms());
    const HostImage wanted = lit_anew(*session, 1);
    Request request = coarse_light_of(1, {"relight=changed", "slice=4"});
    request.outputs = {"indirect", "indirect/lpv:visible taps", "indirect/lpv:energy"};
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(must(session->run(request)).images.at("indirect").texels == wanted.texels);
}

}  // namespace
}  // namespace strata::kept_volumes
