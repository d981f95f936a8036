// Frames on which light propagation volumes are hard to get right: every type of light, grids of any size and number, lights and
// cells in or on walls, numbers that are none. They are held against the model in double, or against what must hold exactly.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/not_finite.h"

namespace strata {
namespace {

/// The Cornell box in a small picture, its light replaced by a lamp of a type in the middle of the box. All blockers stop its
/// light.
Frame box_with(LightType type) {
    Frame frame = scenario_frames("cornell_box").front();
    frame.view.width = frame.view.height = 32;
    frame.light_volumes[0].occlusion = VolumeOcclusion::axial;
    frame.light_volumes[0].iterations = 8;
    Light lamp = frame.lights.front();
    lamp.type = type;
    lamp.position = {2.6, 3.9, 2.2};
    lamp.direction = glm::normalize(glm::vec3(0.2f, -0.9f, 0.3f));
    lamp.axis_u = glm::normalize(glm::cross(lamp.direction, glm::vec3(0, 0, 1)));
    lamp.inner_angle = 0.5f, lamp.outer_angle = 0.9f;
    lamp.source_radius = 0.2f;
    lamp.half_extent = {0.5f, 0.3f};
    frame.lights = {lamp};
    return frame;
}

/// Parallel light comes in by the open front.
Frame box_in_daylight(bool is_sun) {
    Frame frame = box_with(LightType::directional);
    Light& day = frame.lights.front();
    day.direction = glm::normalize(glm::vec3(0.2f, -0.5f, 0.85f));
    day.intensity = {5, 4, 3};
    if (!is_sun) return frame;
    frame.sun = {.direction = day.direction, .irradiance = day.intensity};
    frame.lights.clear();
    return frame;
}

Frame box_in(std::vector<LightVolume> volumes) {
    Frame frame = box_with(LightType::omni);
    for (LightVolume& volume : volumes) volume.occlusion = VolumeOcclusion::axial, volume.iterations = 6;
    frame.light_volumes = std::move(volumes);
    return frame;
}

LightVolume fixed_volume(glm::dvec3 center, float half_extent, std::uint32_t cells) {
    return {.kind = VolumeKind::fixed_local, .center = center, .half_extent = glm::vec3(half_extent), .cells = glm::uvec3(cells)};
}

/// Three cascades around an eye in the box: the picture crosses the borders of two.
Frame box_in_cascades() {
    Frame frame =
        box_in({{.kind = VolumeKind::cascaded_global, .half_extent = glm::vec3(1.25f), .cells = glm::uvec3(10), .cascades = 3}});
    frame.view.origin = {2.78, 2.73, 0.4};
    return frame;
}

/// Cells of 5 cm around a side of the short block, which the eye is near to.
Frame box_in_small_cells() {
    Frame frame = box_in({fixed_volume({2.78, 0.31, 1.31}, 0.5f, 20)});
    frame.view.origin = {2.78, 0.8, -1};
    return frame;
}

/// The rooms with an open door, the lamp elsewhere.
Frame rooms_with_lamp_at(glm::dvec3 position) {
    Frame frame = two_rooms()[1];
    frame.view.width = 48, frame.view.height = 27;
    frame.lights[0].position = position;
    return frame;
}

struct HardVolumes {
    std::string name;
    Frame frame;
    std::vector<std::string> sets = {};
};

const std::vector<HardVolumes>& hard_volumes() {
    static const std::vector<HardVolumes> all = {
        {"omni", box_with(LightType::omni)},
        {"round_spot", box_with(LightType::round_spot)},
        {"square_spot", box_with(LightType::square_spot)},
        {"tube", box_with(LightType::tube)},
        {"sphere", box_with(LightType::sphere)},
        {"disc", box_with(LightType::disc)},
        {"rectangle", box_with(LightType::rectangle)},
        {"directional", box_in_daylight(false)},
        {"sun", box_in_daylight(true)},
        {"cascades", box_in_cascades()},
        {"overlapping_volumes", box_in({fixed_volume({1.65, 1.9, 2.8}, 1.8f, 9), fixed_volume({3.6, 2.5, 3}, 2.4f, 8)})},
        {"one_cell", box_in({fixed_volume({2.78, 2.74, 2.8}, 3.2f, 1)})},
        {"cells_of_5_centimeters", box_in_small_cells()},
        {"cells_of_8_meters", box_in({fixed_volume({2.78, 2.74, 2.8}, 16, 4)})},
        {"sixty_four_iterations", rooms_with_lamp_at({-2.3, 2.1, -1.7}), {"iterations=64"}},
        {"a_lamp_within_a_wall", rooms_with_lamp_at({0.03, 1.2, -1})},
        {"a_lamp_on_the_corner_of_cells", rooms_with_lamp_at({-2.3, 2.3, -1.6})},
        {"a_lamp_on_a_blockers_plane", rooms_with_lamp_at({0, 1.2, -2.2}), {"map_density=0"}},
    };
    return all;
}

Session& session_of_hard_volumes() {
    static const std::unique_ptr<Session> session = [] {
        std::vector<Frame> frames;
        for (const HardVolumes& hard : hard_volumes()) frames.push_back(hard.frame);
        return session_of(std::move(frames));
    }();
    return *session;
}

class HardLightVolumes : public testing::TestWithParam<std::size_t> {};

TEST_P(HardLightVolumes, AreWhatTheModelSays) {
    const HardVolumes& hard = hard_volumes()[GetParam()];
    const Request request = indirect_of(GetParam(), hard.sets);
    const Accuracy accuracy = must(session_of_hard_volumes().judge(request, Stage::indirect, Against::model));
    const Technique& technique = *must(find_technique("indirect/lpv"));
    expect_within_tolerance(accuracy, technique, request, hard.name);
    EXPECT_GE(accuracy.compared - accuracy.trivial, 16u);
}

INSTANTIATE_TEST_SUITE_P(Cases, HardLightVolumes, testing::Range<std::size_t>(0, hard_volumes().size()),
                         [](const auto& index) { return hard_volumes()[index.param].name; });

/// The volume's center is beside that of the room, below which the lamp hangs: with cells of 10 cm a virtual point light would
/// lie within a rounding of a border, and it is 17 % of the light of one pixel.
TEST(ExhaustiveHardLightVolumes, OfSixtyFourCellsEachWayAreWhatTheModelSays) {
    const auto session = must(Session::open({box_in({fixed_volume({2.787, 2.745, 2.791}, 3.2f, 64)})}, {.validation = true}));
    const Request request = indirect_of(0);
    const Accuracy accuracy = must(session->judge(request, Stage::indirect, Against::model));
    expect_within_tolerance(accuracy, *must(find_technique("indirect/lpv")), request, "64 cells each way");
}

bool is_black(const HostImage& image) {
    for (std::uint32_t y = 0; y < image.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < image.shape.extent.width; ++x)
            if (glm::dvec3(texel(image, x, y)) != glm::dvec3(0)) return false;
    return true;
}

// N9
TEST(LightVolumes, AreDarkenedByNoDark) {
    Frame lit = box_with(LightType::omni), with_dark = lit, dark = lit, half_dark = lit;
    Light shade = lit.lights.front();
    shade.intensity = glm::vec3(-20);
    with_dark.lights.push_back(shade);
    dark.lights = {shade};
    half_dark.lights[0].intensity.x *= -1;
    const auto session = session_of({lit, with_dark, dark, half_dark});
    std::vector<HostImage> images;
    for (std::size_t i = 0; i < 4; ++i) images.push_back(must(session->run(indirect_of(i))).images.at("indirect"));
    EXPECT_TRUE(images[1].texels == images[0].texels);
    EXPECT_TRUE(is_black(images[2]));
    EXPECT_FALSE(is_black(images[0]));
    const glm::dvec4 both = texel(images[0], 16, 28), green_and_blue = texel(images[3], 16, 28);
    EXPECT_GT(both.x, 0);
    EXPECT_EQ(green_and_blue.x, 0);
    EXPECT_NEAR(green_and_blue.y / both.y, 1, 2e-3);
}

/// The wall between the rooms cut into blockers that touch along edges through the middles of cells, along borders of cells and
/// anywhere; the door is closed.
Frame rooms_behind_pieces() {
    Frame frame = two_rooms()[0];
    frame.portals.clear();
    for (Light& light : frame.lights) light.portals.clear();
    const Blocker whole = frame.blockers[0];  // u to the front, v up
    const double begin = whole.center.z - double(whole.half_u), end = whole.center.z + double(whole.half_u);
    const double bottom = whole.center.y - double(whole.half_v), top = whole.center.y + double(whole.half_v);
    const std::vector<double> z = {begin, -3, -2.2, -1.23, end}, y = {bottom, 0.9, 1.7, top};
    for (std::size_t i = 0; i + 1 < z.size(); ++i)
        for (std::size_t k = 0; k + 1 < y.size(); ++k) {
            Blocker piece = whole;
            piece.center = {0, 0.5 * (y[k] + y[k + 1]), 0.5 * (z[i] + z[i + 1])};
            piece.half_u = float(0.5 * (z[i + 1] - z[i])), piece.half_v = float(0.5 * (y[k + 1] - y[k]));
            if (i == 0 && k == 0) frame.blockers[0] = piece;
            else frame.blockers.push_back(piece);
        }
    for (Light& light : frame.lights) {
        light.blockers.clear();
        for (std::uint32_t i = 0; i < frame.blockers.size(); ++i) light.blockers.push_back(i);
    }
    return frame;
}

void expect_dark_behind_the_door(const Frame& where, const Run& run, const std::string& what) {
    const Rooms rooms = rooms_of(where, run);
    ASSERT_GT(rooms.dark.size(), 500u) << what;
    EXPECT_EQ(std::ranges::count(rooms.dark, 0.), std::ssize(rooms.dark)) << what;
    EXPECT_GT(mean(rooms.lit), .1) << what;
}

TEST(LightVolumes, PassNoSeamBetweenBlockersThatTouch) {
    const Frame straight = rooms_behind_pieces();
    const std::vector<double> turns = {.3, glm::radians(45.), 1.2};
    std::vector<Frame> frames = {straight};
    for (const double yaw : turns) frames.push_back(turned(straight, yaw));
    const auto session = session_of(frames);
    for (std::size_t i = 0; i < frames.size(); ++i)
        expect_dark_behind_the_door(straight, must(session->run(indirect_of(i))),
                                    i == 0 ? "straight" : std::to_string(turns[i - 1]));
}

/// Middles of cells lie on the wall's plane to the last bit of a double or almost: to which side each belongs the device and the
/// model may see otherwise. Each sees it the same for all its tests, so neither lets anything through.
TEST(LightVolumes, PassNoWallThatMiddlesOfCellsLieOn) {
    const std::vector<Frame> plain = two_rooms();
    const auto on_the_plane = [&](Frame frame) {
        // The plane x = z + 2 in grids of .4 m: a middle at (0, -2) and every one diagonal to it lies on it.
        frame = turned(std::move(frame), glm::radians(45.));
        frame.light_volumes[0].center = {0.2, 1.5, -2.2};
        return frame;
    };
    Frame straight = plain[0];
    straight.light_volumes[0].center.x = 0.2;  // middles at x = 0
    const std::vector<Frame> frames = {straight, on_the_plane(plain[0]), on_the_plane(plain[1])};
    const auto session = session_of(frames);
    for (const char* iterations : {"iterations=16", "iterations=64"})
        for (std::size_t i = 0; i < 2; ++i)
            expect_dark_behind_the_door(plain[0], must(session->run(indirect_of(i, {iterations}))),
                                        i == 0 ? "straight" : "oblique");
    EXPECT_GT(mean(rooms_of(plain[1], must(session->run(indirect_of(2)))).dark), 1e-4) << "through the open door";
}

/// Both at once: each piece's plane goes through the same middles of cells.
TEST(LightVolumes, PassNoSeamThatMiddlesOfCellsLieOn) {
    const Frame plain = rooms_behind_pieces();
    Frame straight = plain, oblique = turned(plain, glm::radians(45.));
    straight.light_volumes[0].center.x = 0.2;
    oblique.light_volumes[0].center = {0.2, 1.5, -2.2};
    std::vector<Frame> frames = {straight, oblique};
    for (std::size_t i = 0; i < 2; ++i) {  // every other piece faces the other way
        frames.push_back(frames[i]);
        for (std::size_t k = 0; k < frames.back().blockers.size(); k += 2) frames.back().blockers[k].u *= -1.f;
    }
    const auto session = session_of(frames);
    const char* const names[] = {"straight", "oblique", "straight, facing either way", "oblique, facing either way"};
    for (std::size_t i = 0; i < frames.size(); ++i)
        expect_dark_behind_the_door(plain, must(session->run(indirect_of(i))), names[i]);
}

// Of cells of .2 m borders lie .1 m above the floor of the rooms and below their ceiling. When rounding chose between two cells,
// the device was .02 away from the model, .5 at worst.
TEST(LightVolumes, GiveAllLightThatAFloorSendsOntoABorderToOneCell) {
    const auto session = session_of({two_rooms()[1]});
    const Request request = indirect_of(0, {"cell_scale=1/2", "iterations=2"});
    const Accuracy accuracy = must(session->judge(request, Stage::indirect, Against::model));
    EXPECT_LT(accuracy.model_rmse, 5e-3);
    EXPECT_LT(accuracy.model_worst, .1);
}

// docs/algorithms/lighting.md 5.6
TEST(LightVolumes, SayWhichPortalsAreTooSmallForTheirCells) {
    Frame wide = two_rooms()[1], narrow = wide, closed = wide;
    narrow.portals[0].half_u = .024f;  // cells of .4 m: 8 ways, .05 m apart
    closed.portals[0].half_u = 0;
    const auto session = session_of({wide, narrow, closed});
    const auto notes = [&](std::size_t frame, std::vector<std::string> sets = {}) {
        return must(session->run(indirect_of(frame, sets))).notes;
    };
    EXPECT_THAT(notes(0), testing::IsEmpty());
    EXPECT_THAT(notes(1),
                testing::ElementsAre(testing::HasSubstr(
                    "narrower than 1/8 of its cells of 0.4 m (portal 0 is 0.048 m wide and opens 12 % of a cell's face)")));
    EXPECT_THAT(notes(1, {"occlusion=none"}), testing::IsEmpty());
    EXPECT_THAT(notes(2), testing::IsEmpty()) << "closed";
}

TEST(LightVolumes, SayThatAVolumeIsNoLargerThanItsRoom) {
    Frame recorded = scenario_frames("cornell_box").front(), tight = recorded;
    recorded.view.width = recorded.view.height = tight.view.width = tight.view.height = 16;
    tight.light_volumes[0].center = {2.78, 2.744, 2.796}, tight.light_volumes[0].half_extent = {2.78f, 2.744f, 2.796f};
    tight.light_volumes[0].cells = glm::uvec3(16);
    const auto session = session_of({recorded, tight});
    EXPECT_THAT(must(session->run(indirect_of(0))).notes, testing::IsEmpty());
    EXPECT_THAT(must(session->run(indirect_of(1))).notes,
                testing::ElementsAre(testing::HasSubstr("within half a cell of its border (-x, +x, -y, +y, -z, +z)")));
}

/// How two pictures of halves differ where a pixel of the one is that of the other, or its mirror image.
struct HalfSteps {
    std::size_t lit = 0, equal = 0, black_in_one = 0;
    double worst = 0;  ///< relative
};
HalfSteps compare(const HostImage& a, const HostImage& b, bool is_mirrored) {
    HalfSteps result;
    const auto [width, height] = std::pair(a.shape.extent.width, a.shape.extent.height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double one = texel(a, x, y)[c], other = texel(b, is_mirrored ? width - 1 - x : x, y)[c];
                if (one == 0 && other == 0) continue;
                ++result.lit;
                result.equal += one == other;
                result.black_in_one += one == 0 || other == 0;
                constexpr double least_normal = 0x1p-14;  // of half floats: numbers below it have its steps
                result.worst = std::max(result.worst, std::abs(one - other) / std::max({one, other, least_normal}));
            }
    return result;
}

/// A light whose record holds a number that is none, beside the lamp.
struct BadLight {
    const char* name;
    LightType type;
    std::function<void(Light&, float)> spoil;
};

TEST(LightVolumes, TakeNothingOfALightThatIsNoNumber) {
    const std::vector<BadLight> bad = {
        {"position", LightType::omni, [](Light& l, float v) { l.position.y = double(v); }},
        {"direction", LightType::round_spot, [](Light& l, float v) { l.direction.x = v; }},
        {"axis", LightType::square_spot, [](Light& l, float v) { l.axis_u.z = v; }},
        {"intensity", LightType::omni, [](Light& l, float v) { l.intensity = glm::vec3(v); }},
        {"range", LightType::omni, [](Light& l, float v) { l.range = v; }},
        {"radius", LightType::sphere, [](Light& l, float v) { l.source_radius = v; }},
        {"extent", LightType::rectangle, [](Light& l, float v) { l.half_extent = glm::vec2(v); }},
        {"outer angle", LightType::round_spot, [](Light& l, float v) { l.outer_angle = v; }},
        {"direction of parallel light", LightType::directional, [](Light& l, float v) { l.direction.y = v; }}};
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Frame> frames = {rooms_with_lamp_at({-2.3, 2.1, -1.7})};
    for (const BadLight& b : bad) {
        Frame frame = frames.front();
        Light light = frame.lights.front();
        light.type = b.type;
        light.position.x -= .5;
        light.source_radius = .1f, light.half_extent = {.2f, .1f};
        light.shadow.casts = false;
        if (b.type == LightType::directional) light.intensity = glm::vec3(.05f);
        b.spoil(light, nan);
        frame.lights.insert(frame.lights.begin(), light);
        frames.push_back(std::move(frame));
    }
    const auto session = session_of(frames);
    const std::vector<std::string> sets = {"iterations=4", "map_size=32"};
    const HostImage without = must(session->run(indirect_of(0, sets))).images.at("indirect");
    EXPECT_FALSE(is_black(without));
    for (std::size_t i = 0; i < bad.size(); ++i) {
        const HostImage with = must(session->run(indirect_of(i + 1, sets))).images.at("indirect");
        EXPECT_EQ(texel_that_is_no_number(with), std::nullopt) << bad[i].name;
        // Its finite numbers may change the scale of the sums, and so their last bit, which the share of light that faces a
        // surface magnifies.
        const HalfSteps steps = compare(with, without, false);
        EXPECT_EQ(steps.black_in_one, 0u) << bad[i].name;
        EXPECT_LT(steps.worst, 8e-3) << bad[i].name;
    }
}

/// The rooms with a spot in place of the lamp: what a spot sees is drawn in its own axes, so that a turn takes its texels along.
Frame rooms_with_spot() {
    Frame frame = two_rooms()[1];
    frame.light_volumes[0].center += glm::dvec3(.03, .07, .07);  // no border of cells where light comes off the doorway
    Light& spot = frame.lights[0];
    spot.type = LightType::round_spot;
    spot.direction = glm::normalize(glm::vec3(0.3f, -0.8f, -0.2f));
    spot.axis_u = glm::normalize(glm::cross(spot.direction, glm::vec3(0, 0, 1)));
    spot.inner_angle = .7f, spot.outer_angle = 1;
    spot.intensity *= 4.f;
    return frame;
}

// T5.15
TEST(LightVolumes, TurnAndMirrorWithTheScene) {
    const Frame plain = rooms_with_spot();
    const glm::dmat3 half_turn = quarter_turn * quarter_turn;
    std::vector<Frame> frames = {plain};
    for (const glm::dmat3& by : {quarter_turn, half_turn, half_turn * quarter_turn, mirror_x})
        frames.push_back(similar(plain, {.turn = by}));
    const auto session = session_of(frames);
    const HostImage here = must(session->run(indirect_of(0))).images.at("indirect");
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const bool is_mirrored = i + 1 == frames.size(), is_exact = i == 2;
        const HalfSteps steps = compare(here, must(session->run(indirect_of(i))).images.at("indirect"), is_mirrored);
        ASSERT_GT(steps.lit, 5000u);
        EXPECT_EQ(steps.black_in_one, 0u) << i;
        // Half a turn negates coordinates as the still eye sees them: of a few pixels the last bit. A quarter turn sums products
        // in another order, and a device moves a map's vertices to another 1/256 of a texel: a point at an edge lights another
        // cell. A mirror image also turns the texels of the map.
        EXPECT_LT(steps.worst, is_exact ? 0x1p-10 : .02) << i;
        EXPECT_LE(steps.lit - steps.equal, is_exact ? 50u : steps.lit) << i;
    }
}

/// The court's store room from within while the eye walks two meters: cascades snap and scroll by four cells of the finest.
void expect_a_dark_store_room(std::uint32_t frames, std::uint32_t begin) {
    std::vector<Frame> walk;
    for (std::uint32_t i = 0; i < frames; ++i) {
        Frame frame = scenario_frames("courtyard").front();
        const double way = double(begin + i) / 31;
        frame.view.width = 32, frame.view.height = 18;
        frame.view.origin = {-7.6 + 2 * way, 1.4, -7.5 + 1.9 * way};
        walk.push_back(std::move(frame));
    }
    const auto session = session_of(walk);
    for (std::uint32_t i = 0; i < frames; ++i) {
        const Run run = must(session->run(indirect_of(i, {"map_size=64", "relight=always"})));
        EXPECT_TRUE(is_black(run.images.at("indirect"))) << "frame " << begin + i;
        const auto injected = std::ranges::find(run.counters, "injected", &CounterRecord::name);
        ASSERT_NE(injected, run.counters.end());
        EXPECT_GT(injected->value, 400u);
    }
}

TEST(LightVolumes, LeaveAStoreRoomDarkWhileCascadesScroll) { expect_a_dark_store_room(3, 13); }
TEST(ExhaustiveLightVolumes, LeaveAStoreRoomDarkOnTheWholeWalk) { expect_a_dark_store_room(32, 0); }

/// The closed rooms in cascades that follow the eye on its way around them.
TEST(LightVolumes, LeaveARoomDarkInCascadesThatFollowTheEye) {
    std::vector<Frame> frames = scenario_frames("two_rooms", 1, 4);
    const Frame closed = frames.front();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const View view = frames[i].view;
        frames[i] = closed;
        frames[i].view = view;
        frames[i].light_volumes = {{.kind = VolumeKind::cascaded_global,
                                    .occlusion = VolumeOcclusion::axial,
                                    .half_extent = {3, 3, 3},
                                    .cells = glm::uvec3(12),
                                    .cascades = 3,
                                    .iterations = 12}};
    }
    const auto session = session_of(frames);
    for (std::size_t i = 0; i < frames.size(); ++i)
        expect_dark_behind_the_door(frames[i], must(session->run(indirect_of(i))), fmt::format("frame {}", i));
}

}  // namespace
}  // namespace strata
