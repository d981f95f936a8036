// Glass and smoke in two rooms, one of them lit by a lamp: what light volumes give to surfaces that are not in the G-buffer. A
// technique of transparency blends what all of them shade alike.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "passes/reference/shade.h"
#include "passes/registry.h"
#include "replay/images/host_image.h"
#include "replay/report/picture_error.h"
#include "tests/support/agreement.h"
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

// In the room with the lamp, and in the other one.
constexpr glm::dvec3 lit_pane{-1.4, 1.4, -1.2}, dark_pane{1.4, 1.4, -1.2}, lit_puff{-3, 1, -1}, dark_puff{3, 1, -1};

struct Panes {
    AlphaMode mode = AlphaMode::blend;
    float alpha = 1;
};

/// The door closed in the first, open in the second.
std::vector<Frame> rooms(const Panes& panes = {}) {
    std::vector<Frame> frames = scenario_frames("two_rooms", 1, 2);
    for (Frame& frame : frames) {
        for (const glm::dvec3& middle : {lit_pane, dark_pane}) add_pane(frame, middle, panes.mode, panes.alpha);
        Emitter smoke{.name = "smoke"};
        for (const glm::dvec3& center : {lit_puff, dark_puff})
            smoke.particles.push_back({.center = center, .size = .4f, .color = paint, .alpha = panes.alpha});
        frame.emitters.push_back(smoke);
    }
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
    const auto session = must(Session::open(rooms(), {.validation = true}));
    const Bounced closed(*session, 0, "transparency/sorted_lists"), open(*session, 1, "transparency/sorted_lists");
    for (const glm::dvec3& dark : {dark_pane, dark_puff}) {
        EXPECT_EQ(closed.at(dark), glm::dvec3(0));
        EXPECT_GT(open.at(dark).y, 1e-4);
    }
    for (const glm::dvec3& lit : {lit_pane, lit_puff}) EXPECT_GT(closed.at(lit).y, .02);
}

TEST(LitGlass, GetsWhatAnOpaqueSurfaceInItsPlaceGets) {
    for (const char* rule : {"irradiance=cell", "irradiance=face"}) {
        const auto glass = must(Session::open(rooms(), {.validation = true}));
        const auto opaque = must(Session::open(rooms({.mode = AlphaMode::opaque}), {.validation = true}));
        const Bounced seen(*glass, 1, "transparency/sorted_lists", {rule});
        Request request = request_of(1, {"indirect/lpv"}, {rule});
        request.outputs = {"indirect"};
        const Run run = must(opaque->run(request));
        const Frame frame = must(opaque->frame(1));
        for (const glm::dvec3& pane : {lit_pane, dark_pane})
            for (const glm::dvec3& aside :
                 {glm::dvec3(0), glm::dvec3(.3, .3, 0), glm::dvec3(-.3, .2, 0), glm::dvec3(.2, -.3, 0)}) {
                const glm::uvec2 p = pixel_of(frame, pane + aside);
                const glm::dvec3 wanted = glm::dvec3(paint) * glm::dvec3(texel(run.images.at("indirect"), p.x, p.y));
                const glm::dvec3 got = seen.at(pane + aside);
                EXPECT_GT(wanted.x, 1e-4);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], wanted[c], 1e-3 * wanted[c] + 1e-7) << rule;
            }
    }
}

TEST(LitGlass, IsLitAlikeByEveryTechnique) {
    const auto session = must(Session::open(rooms({.alpha = .6f}), {.validation = true}));
    const Bounced exact(*session, 1, "transparency/sorted_lists");
    for (const Technique* technique : techniques_of(Stage::transparency)) {
        SCOPED_TRACE(technique->name);
        const Bounced bounced(*session, 1, std::string(technique->name));
        for (const glm::dvec3& place : {lit_pane, dark_pane, lit_puff, dark_puff}) {
            const glm::dvec3 got = bounced.at(place), wanted = exact.at(place);
            printf("%s %g %g  ratio %g\n", technique->name.data(), got.y, wanted.y, got.y / wanted.y);
        }
    }
}

class LitGlassBy : public testing::TestWithParam<const Technique*> {};

TEST_P(LitGlassBy, IsWhatTheModelSays) {
    const Technique& technique = *GetParam();
    static const auto session = must(Session::open(rooms({.alpha = .6f}), {.validation = true}));
    const Request request = request_of(1, {"indirect/lpv", std::string(technique.name)});
    const Accuracy accuracy = must(session->judge(request, Stage::transparency, Against::model_and_truth));
    if (!accuracy.not_supported.empty()) GTEST_SKIP() << accuracy.not_supported;
    expect_within_tolerance(accuracy, technique, request);
    printf("%s model %g %g", technique.name.data(), accuracy.model_rmse, accuracy.model_worst);
    for (const Figure& figure : accuracy.method) printf("  %s %g", figure.name.c_str(), figure.value);
    printf("\n");
}

INSTANTIATE_TEST_SUITE_P(Techniques, LitGlassBy, testing::ValuesIn(techniques_of(Stage::transparency)),
                         [](const auto& tested) { return as_identifier(std::string(tested.param->name)); });

TEST(LitGlass, KeepsItsLightWhereTheTruthTakesTheOpaqueSurfaces) {
    const auto session = must(Session::open(rooms(), {.validation = true}));
    const Request request = request_of(1, {"indirect/lpv"});
    const ImageSet truth = must(session->truth(request, Stage::indirect));
    const Run as_found = must(session->run(request)), as_given = must(session->run_from(request, Stage::indirect, truth));
    const glm::uvec2 p = pixel_of(must(session->frame(1)), lit_pane);
    EXPECT_EQ(texel(as_found.images.at("color"), p.x, p.y), texel(as_given.images.at("color"), p.x, p.y));
}

}  // namespace
}  // namespace strata
