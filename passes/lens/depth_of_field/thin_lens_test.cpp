// Depth of field against a traced thin lens, which sees the scene itself. The stage's truth and its technique start from one
// picture from the middle of the lens, so neither can tell the other that both miss what the picture hides.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "capture_format/view.h"
#include "passes/image_set.h"
#include "passes/lens/depth_of_field/focus_model.h"
#include "passes/lens/depth_of_field/truth.h"
#include "passes/lens/lens.shared.h"
#include "passes/stage_input.h"
#include "tests/support/thin_lens.h"

namespace strata::lens {
namespace {

constexpr std::uint32_t extent = 48, places = 256;
constexpr double focus = 2, half_aperture = 1. / 3;

/// 24 pixels for a length of 1 at a depth of 1: a blur of 4 pixels at infinity and at a depth of 1, of 2 at a depth of 4.
Frame before_the_lens() {
    Frame frame;
    frame.view.width = frame.view.height = extent;
    frame.view.projection = perspective(std::numbers::pi / 2, 1, double(frame.view.near));
    frame.background = glm::vec3(.2f);
    frame.lens = {.focus_distance = float(focus), .aperture = float(2 * half_aperture)};
    return frame;
}

/// A rectangle of one radiance between two places of view space, across the view or lying level.
void add_rectangle(Frame& frame, const glm::vec3& low, const glm::vec3& high, float radiance) {
    Mesh mesh;
    const glm::vec3 other = low.z == high.z ? glm::vec3(low.x, high.y, low.z) : glm::vec3(low.x, low.y, high.z);
    mesh.positions = {low, low + high - other, high, other};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    frame.meshes.push_back(std::move(mesh));
    frame.materials.push_back(
        {.lighting_model = LightingModel::unlit, .base_color = glm::vec4(glm::vec3(radiance), 1), .double_sided = true});
    Draw draw;
    draw.mesh = draw.material = static_cast<std::uint32_t>(frame.draws.size());
    frame.draws.push_back(draw);
}

struct Pictures {
    ReferenceImage traced, truth, gathered;
};

Pictures pictures_of(const Frame& frame) {
    UnlitPicture pinhole = unlit_picture(frame);
    const ImageSet before{{"color", pinhole.color}, {"depth_layers", pinhole.depth_layers}};
    const LensParams params{.focus = focus_gather, .focus_taps = focus_taps_256, .focus_reach = .25f};
    Pictures made{.traced = traced_through_lens(frame, places),
                  .truth = seen_through_lens({frame, before}, pinhole.color, places),
                  .gathered = focus_model({frame, before}, pinhole.color, params)};
    made.gathered.undecided.clear();
    return made;
}

/// Over the pixels whose blur does not reach the picture's border: what is outside of it is unknown, too.
double rmse(const ReferenceImage& a, const ReferenceImage& b) {
    constexpr std::uint32_t border = 8;
    double sum = 0;
    for (std::uint32_t y = border; y < extent - border; ++y)
        for (std::uint32_t x = border; x < extent - border; ++x) sum += std::pow(a.at(x, y).x - b.at(x, y).x, 2);
    return std::sqrt(sum) / (extent - 2 * border);
}

/// Stripes of 3 rows of pixels on a floor, from before the plane in focus to behind it: every lens sees what the picture shows.
Frame striped_floor() {
    Frame frame = before_the_lens();
    const auto depth_of_row = [](int below_middle) { return float(.8 * extent / 2 / below_middle); };
    for (int row = 3; row < 36; row += 3)
        add_rectangle(frame, {-40, -.8f, depth_of_row(row + 3)}, {40, -.8f, depth_of_row(row)}, row % 2 == 0 ? .8f : .1f);
    return frame;
}

/// A blurred post of 4 pixels before a wall that is blurred, too.
Frame post_before_wall() {
    Frame frame = before_the_lens();
    add_rectangle(frame, {-20, -20, 4}, {20, 20, 4}, .5f);
    add_rectangle(frame, {-1 / 12.f, -3, 1}, {1 / 12.f, 3, 1}, .9f);
    return frame;
}

/// The same with a light on the wall that the post hides from the middle of the lens.
Frame hidden_light() {
    Frame frame = post_before_wall();
    add_rectangle(frame, {-.2f, -20, 3.99f}, {.2f, 20, 3.99f}, 3);
    return frame;
}

/// Share of a disc of radius 1 on one side of a line at this distance from its middle.
double share_of_disc(double t) {
    t = std::clamp(t, -1., 1.);
    return .5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi;
}

TEST(ThinLens, BlursAnEdgeByTheAreaOfItsDisc) {
    Frame frame = before_the_lens();
    frame.background = glm::vec3(0);
    add_rectangle(frame, {0, -20, 1}, {20, 20, 1}, 1);
    const Pictures made = pictures_of(frame);
    const double radius = std::abs(blur_radius(frame, 1));
    EXPECT_NEAR(radius, 4, 1e-6);
    for (std::uint32_t x = 12; x < 36; ++x) {
        const double wanted = share_of_disc((x + .5 - extent / 2.) / radius);
        EXPECT_NEAR(made.traced.at(x, 24).x, wanted, .02) << x;
        EXPECT_NEAR(made.truth.at(x, 24).x, wanted, .02) << x;
        EXPECT_NEAR(made.gathered.at(x, 24).x, wanted, .13) << x;
    }
}

TEST(ThinLens, SeesAFloorAsTruthAndTechniqueDo) {
    const Pictures made = pictures_of(striped_floor());
    RecordProperty("truth", std::to_string(rmse(made.truth, made.traced)));
    RecordProperty("technique", std::to_string(rmse(made.gathered, made.traced)));
    EXPECT_LT(rmse(made.truth, made.traced), .02);
    EXPECT_LT(rmse(made.gathered, made.traced), .035);
}

TEST(ThinLens, SeesAnEvenWallBehindAPostAsTruthAndTechniqueGuess) {
    const Pictures made = pictures_of(post_before_wall());
    RecordProperty("truth", std::to_string(rmse(made.truth, made.traced)));
    RecordProperty("technique", std::to_string(rmse(made.gathered, made.traced)));
    EXPECT_LT(rmse(made.truth, made.traced), .004);
    EXPECT_LT(rmse(made.gathered, made.traced), .005);
}

TEST(ThinLens, SeesALightThatNoPictureFromItsMiddleKnows) {
    const Pictures made = pictures_of(hidden_light()), without = pictures_of(post_before_wall());
    EXPECT_EQ(rmse(made.truth, without.truth), 0) << "the picture hides all of the light";
    EXPECT_EQ(rmse(made.gathered, without.gathered), 0);
    RecordProperty("truth", std::to_string(rmse(made.truth, made.traced)));
    RecordProperty("technique", std::to_string(rmse(made.gathered, made.traced)));
    EXPECT_GT(rmse(made.truth, made.traced), .25);
    EXPECT_GT(rmse(made.gathered, made.traced), .25);
    EXPECT_LT(rmse(made.truth, made.gathered), .005) << "held against each other, they are right";
}

}  // namespace
}  // namespace strata::lens
