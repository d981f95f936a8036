// Glass and smoke in two rooms, one of them lit by a lamp: what light volumes give to surfaces that are not in the G-buffer. A
// technique of transparency blends what all of them shade alike.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/reference/shade.h"
#include "passes/registry.h"
#include "replay/images/host_image.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/errors.h"
#include "tests/support/every_nth.h"
#include "tests/support/print.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr glm::vec3 paint{.8f, .6f, .4f};

/// A square of 1 m, its face to the front.
void add_pane(Frame& frame, const glm::dvec3& middle, AlphaMode mode, float alpha) {
    Mesh mesh;
    for (const glm::vec2 at : {glm::vec2(-.5f, -.5f), glm::vec2(.5f, -.5f), glm::vec2(.5f, .5f), glm::vec2(-.5f, .5f)})
        mesh.positions.emplace_back(at, 0);
    mesh.normals.assign(4, {0, 0, 1});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    frame.meshes.push_back(std::move(mesh));
    frame.materials.push_back({.name = "pane",
                               .lighting_model = LightingModel::lambert,
                               .alpha_mode = mode,
                               .base_color = glm::vec4(paint, alpha),
                               .double_sided = true});
    Draw pane{.name = "pane",
              .mesh = static_cast<std::uint32_t>(frame.meshes.size() - 1),
              .material = static_cast<std::uint32_t>(frame.materials.size() - 1)};
    pane.to_world[3] = glm::dvec4(middle, 1);
    pane.previous_to_world = pane.to_world;
    pane.casts_shadow = false;  // nor does it reflect light into the volume: the same light, whatever it is
    frame.draws.push_back(pane);
}

// In the room with the lamp, and in the other one: so near the wall between them, which ends at .05, that cells of the first
// room, with middles at -.1, are among the eight around.
constexpr glm::dvec3 lit_pane{-1.4, 1.4, -1.2}, dark_pane{.58, 1.4, -1.2}, lit_puff{-3, 1, -1}, dark_puff{.2, .6, -.6};
constexpr glm::dvec3 dark_edge{.2, 1.4, -1.2};  // of the pane

struct Panes {
    AlphaMode mode = AlphaMode::blend;
    float alpha = 1;
};

void add_panes_and_puffs(Frame& frame, const Panes& panes) {
    for (const glm::dvec3& middle : {lit_pane, dark_pane}) add_pane(frame, middle, panes.mode, panes.alpha);
    Emitter smoke{.name = "smoke"};
    for (const glm::dvec3& center : {lit_puff, dark_puff})
        smoke.particles.push_back({.center = center, .size = .2f, .color = paint, .alpha = panes.alpha});
    frame.emitters.push_back(smoke);
}

/// The door closed in the first, open in the second.
std::vector<Frame> rooms(const Panes& panes = {}) {
    std::vector<Frame> frames = scenario_frames("two_rooms", 1, 2);
    for (Frame& frame : frames) add_panes_and_puffs(frame, panes);
    return frames;
}

glm::uvec2 pixel_of(const Frame& frame, const glm::dvec3& world) {
    const glm::dvec4 clip = glm::dmat4(frame.view.projection) * glm::dvec4(to_view(frame, world), 1);
    return {(clip.x / clip.w + 1) / 2 * frame.view.width, (clip.y / clip.w + 1) / 2 * frame.view.height};
}

Request request_of(std::size_t frame, const std::vector<std::string>& uses, const std::vector<std::string>& sets = {}) {
    return {.variant = {.frame = frame}, .choices = chosen(uses, sets), .outputs = {"color"}};
}

/// What the volumes add to a pixel.
class Bounced {
public:
    Bounced(Session& session, std::size_t frame, const std::string& technique, const std::vector<std::string>& sets = {})
        : frame_(must(session.frame(frame))),
          with_(must(session.run(request_of(frame, {"indirect/lpv", technique}, sets)))),
          without_(must(session.run(request_of(frame, {"indirect/ambient", technique})))) {}

    glm::dvec3 at(const glm::dvec3& world) const {
        const glm::uvec2 p = pixel_of(frame_, world);
        return glm::dvec3(texel(with_.images.at("color"), p.x, p.y) - texel(without_.images.at("color"), p.x, p.y));
    }

private:
    Frame frame_;
    Run with_, without_;
};

TEST(LitGlass, IsExactlyDarkBehindAClosedDoorAndNotBehindAnOpenOne) {
    const auto session = session_of(rooms());
    const Bounced closed(*session, 0, "transparency/sorted_lists"), open(*session, 1, "transparency/sorted_lists");
    for (const glm::dvec3& dark : {dark_pane, dark_edge, dark_puff}) {
        EXPECT_EQ(closed.at(dark), glm::dvec3(0));
        EXPECT_GT(open.at(dark).y, 1e-4);
    }
    for (const glm::dvec3& lit : {lit_pane, lit_puff}) EXPECT_GT(closed.at(lit).y, .02);
}

/// A volume that ends within the left room, and cascades of another cell size around it.
void add_volumes(Frame& frame) {
    LightVolume part = frame.light_volumes.front();
    part.center.x = -2.7, part.half_extent.x = 1.6f, part.cells.x = 8;
    frame.light_volumes = {part,
                           {.kind = VolumeKind::cascaded_global,
                            .occlusion = VolumeOcclusion::axial,
                            .half_extent = glm::vec3(4),
                            .cells = glm::uvec3(16),
                            .cascades = 2,
                            .iterations = 16}};
}

/// What the volumes add to a pane of glass against what they give to an opaque one in its place, which the device stores as half
/// floats: lavapipe rounds them towards zero, once for each grid. The G-buffer rounds normal and depth, too, which was 5e-4.
void expect_alike(Session& session, std::size_t glass, std::size_t opaque, const std::string& rule, int grids) {
    const Frame frame = must(session.frame(glass));
    const Bounced seen(session, glass, "transparency/sorted_lists", {rule});
    Request request = request_of(opaque, {"indirect/lpv"}, {rule});
    request.outputs = {"indirect"};
    const auto run = must(session.run(request));
    int lit = 0;
    for (const glm::dvec3& pane : {lit_pane, dark_pane})
        for (const glm::dvec3& aside : {glm::dvec3(0), glm::dvec3(.3, .3, 0), glm::dvec3(-.3, .2, 0), glm::dvec3(.2, -.3, 0)}) {
            const glm::uvec2 p = pixel_of(frame, pane + aside);
            const glm::dvec3 wanted = glm::dvec3(paint) * glm::dvec3(texel(run.images.at("indirect"), p.x, p.y));
            const glm::dvec3 got = seen.at(pane + aside);
            lit += wanted.x > 1e-4;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(got[c], wanted[c], (grids * 0x1p-10 + 1e-3) * wanted[c] + 1e-8) << rule << ", " << c;
        }
    EXPECT_GT(lit, 5) << rule << ": of eight places; a pane takes nothing of sources that face as it does";
}

TEST(LitGlass, GetsWhatAnOpaqueSurfaceInItsPlaceGets) {
    std::vector<Frame> frames{rooms()[1], rooms({.mode = AlphaMode::opaque})[1]};
    for (int i = 0; i < 2; ++i) add_volumes(frames.emplace_back(frames[std::size_t(i)]));
    const auto session = session_of(frames);
    expect_alike(*session, 0, 1, "irradiance=cell", 1);
    expect_alike(*session, 0, 1, "irradiance=face", 1);
    expect_alike(*session, 2, 3, "irradiance=cell", 3);
    expect_alike(*session, 2, 3, "cell_storage=half", 3);
}

/// Panes all over the rooms, in three volumes, among so many blockers.
Frame glass_among(std::size_t blockers) {
    Frame frame = with_random_blockers(blockers, 6);
    add_panes_and_puffs(frame, {.alpha = .5f});
    for (int i = 0; i < 24; ++i)
        add_pane(frame, {-4.2 + 1.2 * (i % 8), .6 + .8 * (i / 8), -3.4 + .4 * (i % 5)}, AlphaMode::blend, .5f);
    add_volumes(frame);
    return frame;
}

double total_difference(const HostImage& a, const HostImage& b) {
    double sum = 0;
    for (std::uint32_t y = 0; y < a.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < a.shape.extent.width; ++x) sum += std::abs((texel(a, x, y) - texel(b, x, y)).y);
    return sum;
}

// 70 blockers take three words of a list, so that its last texel is half empty.
TEST(LitGlass, AsksTheBlockersNearItsMacroCellAndGetsTheBitsOfAskingAll) {
    const auto session = session_of({glass_among(70)});
    const auto color = [&](const std::string& set) {
        const Request request = request_of(0, {"indirect/lpv", "transparency/alpha_blend"}, {"iterations=8", "map_size=32", set});
        return must(session->run(request)).images.at("color");
    };
    const HostImage near = color("macro_cells=on"), all = color("macro_cells=off"), through_walls = color("taps=all");
    EXPECT_TRUE(near.texels == all.texels);
    EXPECT_GT(total_difference(near, through_walls), 1);
}

// A fragment asks at most fifty portals about a way, not all of the frame.
TEST(LitGlass, IsLitThroughAThousandWindows) {
    Frame frame = with_a_thousand_windows();
    add_panes_and_puffs(frame, {.alpha = .6f});
    const auto session = session_of({frame});
    const Request request = request_of(0, {"indirect/lpv", "transparency/sorted_lists"});
    const Accuracy accuracy = must(session->judge(request, Stage::transparency, Against::model));
    expect_within_tolerance(accuracy, *must(find_technique("transparency/sorted_lists")), request);
    EXPECT_GE(accuracy.compared - accuracy.trivial, 500u);
}

/// So many blockers smaller than a hair around the dark pane, whose planes part it from the cells beside it: all ways are tested,
/// none is stopped.
Frame glass_in_dust(std::uint32_t grains) {
    Frame frame = rooms()[1];
    constexpr float grain = 1e-5f;
    for (std::uint32_t i = 0; i < grains; ++i)
        frame.blockers.push_back({.center = {dark_pane.x, 1.2 + .035 * (i % 40), -1.5 + .035 * (i / 40)},
                                  .u = {0, 1, 0},
                                  .v = {0, 0, 1},
                                  .half_u = grain,
                                  .half_v = grain});
    return frame;
}

// Each blocker that is near takes up to 42 turns of a fragment's loops.
TEST(ExhaustiveLitGlass, AmongManyBlockersIsRightOrRefused) {
    const auto session = session_of({glass_in_dust(0), glass_in_dust(1540), glass_in_dust(1560)});
    const auto color = [&](std::size_t frame) {
        return session->run(request_of(frame, {"indirect/lpv", "transparency/sorted_lists"}, {"iterations=8"}));
    };
    const auto alone = must(color(0)), dusty = must(color(1));
    double worst = 0;
    for (std::uint32_t y = 0; y < alone.height; ++y)
        for (std::uint32_t x = 0; x < alone.width; ++x)
            worst = std::max(worst,
                             double(std::abs((texel(alone.images.at("color"), x, y) - texel(dusty.images.at("color"), x, y)).y)));
    EXPECT_LT(worst, 1e-4) << "5e-6: other constants of a shader round otherwise. Loops that a driver ends leave taps out.";
    const auto refused = color(2);
    ASSERT_EQ(!refused, !has(session->device().capabilities, Capability::long_loops));
    if (!refused) {
        EXPECT_EQ(refused.error().fault, Fault::device_lacks);
    }
}

/// In volumes of so many cells each way, around panes and puffs.
Frame rooms_in_cascades(std::uint32_t cells, std::uint32_t cascades) {
    Frame frame = rooms()[0];
    frame.light_volumes = {{.kind = VolumeKind::cascaded_global,
                            .half_extent = glm::vec3(10),
                            .cells = glm::uvec3(cells),
                            .cascades = cascades,
                            .iterations = 1}};
    return frame;
}

// Nothing is allocated before a frame is refused.
TEST(LitGlass, IsRefusedWhereTheDeviceCannotHoldItsVolumes) {
    const auto session = session_of({rooms_in_cascades(200, 1), rooms_in_cascades(256, 8)});
    if (session->device().max_buffer_bytes > 256u << 20 || session->device().max_image_extent > 65'536)
        GTEST_SKIP() << "this device holds 8 million cells";
    const auto run = [&](std::size_t frame) { return session->run(request_of(frame, {"indirect/lpv"})); };
    EXPECT_THAT(run(0), FailsWith("device.buffer_too_large")) << "8 million cells of 120 bytes";
    EXPECT_THAT(run(1), FailsWith("device.image_too_large", Field("image", "volume_light"), Field("width", 4096),
                                  Field("height", 196609)))
        << "134 million cells, each with two records";
}

class LitGlassBy : public testing::TestWithParam<const Technique*> {};

double difference_from_truth(const Accuracy& accuracy) {
    return std::ranges::find(accuracy.technique_errors, "relative rmse", &Metric::name)->value;
}

TEST_P(LitGlassBy, IsWhatModelAndTruthSay) {
    const Technique& technique = *GetParam();
    static const auto session = session_of(rooms({.alpha = .6f}));
    const Request request = request_of(1, {"indirect/lpv", std::string(technique.name)});
    const Accuracy accuracy = must(session->judge(request, Stage::transparency, Against::model_and_truth));
    if (!accuracy.not_supported.empty()) GTEST_SKIP() << accuracy.not_supported;
    expect_within_tolerance(accuracy, technique, request);
    EXPECT_GE(accuracy.compared - accuracy.trivial, 500u);
    // The panes and puffs hide nothing of each other, and no technique is wrong about a lone layer but by its formats:
    // most, 7.7e-4, the eighth of an alpha that transparency/a_buffer stores.
    EXPECT_LT(difference_from_truth(accuracy), 1e-3);
}

std::string lit_by_technique(const testing::TestParamInfo<const Technique*>& tested) {
    return as_identifier(std::string(tested.param->name));
}

/// Those whose models rasterize one object after the other among them.
std::vector<const Technique*> some_techniques() {
    std::vector<const Technique*> some = every_nth(3, techniques_of(Stage::transparency));
    for (const Technique* technique : techniques_of(Stage::transparency))
        if (technique->abilities.sorts_objects && std::ranges::count(some, technique) == 0) some.push_back(technique);
    return some;
}

INSTANTIATE_TEST_SUITE_P(Some, LitGlassBy, testing::ValuesIn(some_techniques()), lit_by_technique);
INSTANTIATE_TEST_SUITE_P(Exhaustive, LitGlassBy, testing::ValuesIn(techniques_of(Stage::transparency)), lit_by_technique);

TEST(LitGlass, KeepsItsLightWhereTheTruthTakesTheOpaqueSurfaces) {
    const auto session = session_of(rooms());
    const Request request = request_of(1, {"indirect/lpv"});
    const Frame frame = must(session->frame(1));
    const ImageSet black{{"indirect", ReferenceImage(frame.view.width, frame.view.height)}};
    const auto as_found = must(session->run(request)), as_given = must(session->run_from(request, Stage::indirect, black));
    const glm::uvec2 p = pixel_of(frame, lit_pane);
    EXPECT_EQ(texel(as_found.images.at("color"), p.x, p.y), texel(as_given.images.at("color"), p.x, p.y));
}

}  // namespace
}  // namespace strata
