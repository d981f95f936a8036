// Gathered bounced light: the target of techniques of indirect light, against form factors and energy that closed forms give.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "captures/scenarios.h"
#include "passes/gbuffer/truth.h"
#include "passes/indirect/direct_light.h"
#include "passes/indirect/truth.h"
#include "passes/reference/lights.h"
#include "passes/reference/standard_error.h"
#include "passes/stage_input.h"
#include "tests/4_references/estimates.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {

namespace {

using std::numbers::pi;

/// A lit surface somewhere, of which light is asked: no geometry.
struct Receiver {
    glm::dvec3 position{0}, normal{0, 0, 1};
};

/// Every pixel sees the same receiver, a meter before the eye, by rays that are parallel but for 1e-9: each pixel is one more
/// estimate of the same light.
ReferenceImage gathered(Frame frame, const Receiver& receiver, const GatheredDirections& directions, std::uint32_t size = 1) {
    const Frame narrow = tiny::frame(size, size, 1, 1e-9);
    frame.view = narrow.view;
    frame.view.origin = receiver.position - glm::dvec3(0, 0, 1);
    const ImageSet before{{"surface_normal", ReferenceImage(size, size, 1, glm::dvec4(receiver.normal, 1))},
                          {"surface_material", ReferenceImage(size, size, 1, {double(LightingModel::lambert), 0, 1, 0})}};
    return gathered_light({frame, before}, directions);
}

/// Irradiance / pi, red.
double light_at(const Frame& frame, const Receiver& receiver, const GatheredDirections& directions = {.side = 96, .batches = 1}) {
    return gathered(frame, receiver, directions).at(0, 0).x;
}

/// A Lambert rectangle center +- u +- v.
struct Rectangle {
    glm::dvec3 center{0}, u{0.5, 0, 0}, v{0, 0.5, 0};
};
std::uint32_t add_rectangle(Frame& frame, const Rectangle& r, float albedo = 1) {
    const std::array corners{r.center - r.u - r.v, r.center + r.u - r.v, r.center + r.u + r.v,
                             r.center - r.u - r.v, r.center + r.u + r.v, r.center - r.u + r.v};
    const std::uint32_t draw = tiny::add_triangles(frame, corners);
    tiny::material(frame, draw).lighting_model = LightingModel::lambert;
    tiny::material(frame, draw).base_color = glm::vec4(glm::vec3(albedo), 1);
    return draw;
}

Light directional(glm::vec3 direction, float irradiance) {
    Light light;
    light.type = LightType::directional;
    light.direction = direction;
    light.intensity = glm::vec3(irradiance);
    return light;
}

/// A unit square at z = 0 of albedo .5 under 10 W/m^2 along -z: it sends out 5 W/m^2. The receiver is a meter above its middle.
struct LitSquare {
    Frame frame = tiny::frame(1, 1);
    Receiver receiver{{0, 0, 1}, {0, 0, -1}};
    std::uint32_t square = add_rectangle(frame, {}, 0.5f);

    LitSquare() { frame.lights = {directional({0, 0, -1}, 10)}; }
    double light() const { return light_at(frame, receiver); }
};
constexpr double radiosity = 5, above_square = 0.23945647;  // the form factor: docs/algorithms/lighting.md T0.4

/// A cube around the origin with edges of 2, of albedo .5.
Frame closed_box() {
    Frame frame = tiny::frame(1, 1);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 center(0), u(0), v(0);
            center[axis] = side;
            u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
            add_rectangle(frame, {center, u, v}, 0.5f);
        }
    return frame;
}

/// The mean over a rectangle of light that arrives there, at the middles of steps x steps parts.
double mean_light(const Frame& frame, const Rectangle& on, const glm::dvec3& normal, int steps,
                  const GatheredDirections& directions = {.side = 48, .batches = 1}) {
    double sum = 0;
    for (int i = 0; i < steps * steps; ++i) {
        const glm::dvec2 p = 2.0 * (glm::dvec2(i % steps, i / steps) + 0.5) / double(steps) - 1.0;
        sum += light_at(frame, {on.center + on.u * p.x + on.v * p.y, normal}, directions);
    }
    return sum / (steps * steps);
}

}  // namespace

TEST(gathered_light, above_the_middle_of_a_sunlit_square_is_its_radiosity_times_the_form_factor) {
    LitSquare lit;
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square, 0.002);
    lit.frame.lights.clear();
    lit.frame.sun.direction = glm::normalize(glm::vec3(0.8f, 0, -0.6f));
    lit.frame.sun.irradiance = glm::vec3(10);
    EXPECT_NEAR(lit.light() * pi / radiosity, 0.6 * above_square, 0.0015) << "the sun stands lower";
}

TEST(gathered_light, between_squares_is_what_their_form_factor_says) {  // docs/algorithms/lighting.md T0.5
    const LitSquare lit;
    const Rectangle opposite{.center = {0, 0, 1}}, beside{.center = {0.5, 0, 0.5}, .u = {0, 0, 0.5}, .v = {0, 0.5, 0}};
    EXPECT_NEAR(mean_light(lit.frame, opposite, {0, 0, -1}, 8) * pi / radiosity, 0.19982490, 0.001);
    EXPECT_NEAR(mean_light(lit.frame, beside, {-1, 0, 0}, 12) * pi / radiosity, 0.20004378, 0.002);
}

TEST(gathered_light, in_a_box_whose_walls_are_all_equally_bright_is_the_same_everywhere) {
    Frame frame = closed_box();
    for (const glm::vec3 along : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
        for (const float sign : {-1.0f, 1.0f}) frame.lights.push_back(directional(sign * along, 3));
    for (const Receiver& receiver :
         {Receiver{{0, 0, 0}, {0, 0, 1}}, Receiver{{0.3, -0.9, 0.5}, glm::normalize(glm::dvec3(1, 2, 3))},
          Receiver{{1, 0.99, -0.99}, {-1, 0, 0}}, Receiver{{0.2, -0.3, 1.0005}, {0, 0, -1}}})
        EXPECT_NEAR(light_at(frame, receiver, {.side = 8, .batches = 1}) * pi, 0.5 * 3, 1e-9);
}

TEST(gathered_light, on_all_walls_of_a_closed_box_is_the_flux_of_its_lamp_times_the_albedo) {
    Frame frame = closed_box();
    frame.lights = {Light{.intensity = glm::vec3(2), .range = 1e5f, .shadow = {.casts = true}}};
    const double flux = 4 * pi * 2, area = 24;
    EXPECT_NEAR(mean_light(frame, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, {0, 0, -1}, 8) * pi * area, 0.5 * flux, 0.004 * flux);
}

// docs/algorithms/lighting.md 8, (2): of B = M (1 + rho + rho^2 + ...) two bounces are rho and rho^2.
TEST(gathered_light, of_two_bounces_in_an_evenly_lit_box_is_its_albedo_and_its_square) {
    Frame frame = closed_box();
    for (const glm::vec3 along : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
        for (const float sign : {-1.0f, 1.0f}) frame.lights.push_back(directional(sign * along, 3));
    for (const Receiver& receiver :
         {Receiver{{0.3, -0.9, 0.5}, glm::normalize(glm::dvec3(1, 2, 3))}, Receiver{{1, 0.99, -0.99}, {-1, 0, 0}}})
        EXPECT_NEAR(light_at(frame, receiver, {.side = 8, .batches = 1, .bounces = 2}) * pi, (0.5 + 0.25) * 3, 1e-9);
}

TEST(gathered_light, of_two_bounces_brings_all_that_walls_of_a_box_reflect_twice) {
    Frame frame = closed_box();
    frame.lights = {Light{.intensity = glm::vec3(2), .range = 1e5f, .shadow = {.casts = true}}};
    const double flux = 4 * pi * 2, area = 24;
    const GatheredDirections two{.side = 48, .batches = 1, .bounces = 2};
    EXPECT_NEAR(mean_light(frame, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, {0, 0, -1}, 8, two) * pi * area, 0.75 * flux, 0.006 * flux);
}

/// Two squares that face each other: what the second reflects back of what the first sent it, by sums over both.
TEST(gathered_light, of_two_bounces_between_squares_is_what_their_form_factors_say) {
    LitSquare lit;  // the light passes the square at z = 1, which casts no shadow, and which it lights from behind
    const std::uint32_t opposite = add_rectangle(lit.frame, {.center = {0, 0, 1}}, 0.8f);
    lit.frame.lights[0].shadow.casts = false;
    constexpr int steps = 24;
    const auto middle = [](int i, double z) {
        return glm::dvec3((i % steps + 0.5) / steps - 0.5, (i / steps + 0.5) / steps - 0.5, z);
    };
    const auto kernel = [](const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 way = b - a;
        return way.z * way.z / (pi * glm::dot(way, way) * glm::dot(way, way)) / (steps * steps);
    };
    const Receiver receiver{{0.1, 0.05, 0.001}, {0, 0, 1}};
    double wanted = 0;
    for (int i = 0; i < steps * steps; ++i) {
        double received = 0;
        for (int k = 0; k < steps * steps; ++k) received += radiosity * kernel(middle(i, 1), middle(k, 0));
        wanted += 0.8 * received * kernel(receiver.position, middle(i, 1));
    }
    EXPECT_EQ(light_at(lit.frame, receiver), 0) << "the square opposite is lit on its back alone";
    EXPECT_NEAR(light_at(lit.frame, receiver, {.side = 320, .batches = 1, .bounces = 2}) * pi, wanted, 0.04 * wanted);
    tiny::material(lit.frame, opposite).lighting_model = LightingModel::unlit;
    EXPECT_EQ(light_at(lit.frame, receiver, {.side = 8, .batches = 1, .bounces = 2}), 0);
}

TEST(gathered_light, errs_by_its_own_standard_error_which_stratification_makes_shrink_faster_than_noise) {
    const LitSquare lit;
    const double wanted = radiosity * above_square / pi;
    double before = 0;
    for (const std::uint32_t side : {8u, 16u, 32u}) {
        const ReferenceImage many = gathered(lit.frame, lit.receiver, {.side = side, .batches = 4}, 16);
        const double expected = standard_error(many)->rmse;
        double squares = 0, sum = 0;
        for (const glm::dvec4& texel : many.texels) {
            squares += (texel.x - wanted) * (texel.x - wanted) / 256;
            sum += texel.x / 256;
        }
        EXPECT_NEAR(std::sqrt(squares) / expected, 1, 0.2) << side;
        EXPECT_NEAR(sum, wanted, 4 * expected / std::sqrt(256)) << side << ": the mean of 256 estimates is biased";
        if (before > 0) {
            EXPECT_LT(expected, 0.46 * before) << side << ": four times the directions, half the noise at least";
        }
        before = expected;
    }
}

TEST(gathered_light, has_the_mean_of_the_closed_form_and_half_a_percent_of_bias_shows) {
    LitSquare lit;
    add_rectangle(lit.frame, {.center = lit.receiver.position, .u = {1e-3, 0, 0}, .v = {0, 1e-3, 0}});  // rays leave it itself
    const double wanted = radiosity * above_square / pi;
    const ReferenceImage many = gathered(lit.frame, lit.receiver, {.side = 64, .batches = 1}, 28);
    const Biases found = biases(many, wanted);
    EXPECT_LE(found.false_alarms, 2) << "of 28 at a level of .01";
    EXPECT_EQ(found.noticed, 28) << "biases of .5 %";
    EXPECT_GT(found.probability, .001) << "the mean of all";
}

TEST(gathered_light, is_the_same_in_every_run_and_at_every_sample_of_one_surface) {
    const LitSquare lit;
    const ReferenceImage once = gathered(lit.frame, lit.receiver, {.side = 4, .batches = 2}, 4);
    EXPECT_EQ(once.texels, gathered(lit.frame, lit.receiver, {.side = 4, .batches = 2}, 4).texels);
    Frame frame = lit.frame;
    frame.view = tiny::frame(1, 1, 4, 1e-9).view;
    ImageSet before{{"surface_normal", ReferenceImage(1, 1, 4, {0, 0, -1, 1})}, {"surface_material", ReferenceImage(1, 1, 4)}};
    before["surface_normal"].at(0, 0, 3) = {0, 1, 0, 1};
    const ReferenceImage light = gathered_light({frame, before}, {.side = 4, .batches = 1});
    EXPECT_EQ(light.at(0, 0, 1), light.at(0, 0, 0));
    EXPECT_NE(light.at(0, 0, 3), light.at(0, 0, 0)) << "another surface";
    before["surface_normal"].at(0, 0, 2) = glm::dvec4(0);
    EXPECT_EQ(gathered_light({frame, before}, {.side = 4, .batches = 1}).at(0, 0, 2), glm::dvec4(0)) << "no surface";
}

TEST(gathered_light, comes_from_what_is_lit_and_reflects_diffusely) {
    const auto changed = [](auto&& change) {
        LitSquare lit;
        change(lit.frame, tiny::material(lit.frame, lit.square));
        return lit.light();
    };
    EXPECT_EQ(changed([](Frame&, Material& m) { m.lighting_model = LightingModel::unlit; }), 0);
    EXPECT_EQ(changed([](Frame&, Material& m) { m.lighting_model = LightingModel::ggx, m.metallic = 1; }), 0) << "a mirror";
    EXPECT_EQ(changed([](Frame& f, Material& m) { f.lights.clear(), m.emissive = glm::vec3(1); }), 0) << "no light";
    EXPECT_EQ(changed([](Frame& f, Material&) { f.lights[0].direction = {0, 0, 1}; }), 0) << "lit from behind";
    EXPECT_EQ(changed([](Frame& f, Material&) { f.lights[0].intensity = glm::vec3(-1); }), 0) << "a dark";
    const double plain = LitSquare().light();
    EXPECT_NEAR(changed([](Frame&, Material& m) { m.lighting_model = LightingModel::ggx, m.metallic = 0.25f; }), 0.75 * plain,
                1e-9);
    EXPECT_NEAR(changed([](Frame& f, Material& m) {
                    m.double_sided = false, std::swap(f.meshes[0].indices[1], f.meshes[0].indices[2]),
                    std::swap(f.meshes[0].indices[4], f.meshes[0].indices[5]);
                }),
                plain, 1e-9)
        << "a back reflects, too";
}

TEST(gathered_light, is_stopped_by_surfaces_on_either_leg) {
    LitSquare lit;
    // A black sheet half way over one half of the square: where it is seen from the middle, nothing comes from.
    add_rectangle(lit.frame, {.center = {5, 0, 0.5}, .u = {5, 0, 0}, .v = {0, 5, 0}}, 0);
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square / 2, 0.002);
    // Over the receiver it is in the way of the light alone, and of light that casts shadows.
    lit.frame.meshes[1].positions = {{0, -5, 2}, {9, -5, 2}, {9, 5, 2}, {0, -5, 2}, {9, 5, 2}, {0, 5, 2}};
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square, 0.002);
    lit.frame.lights[0].shadow.casts = true;
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square / 2, 0.002);
    lit.frame.draws[1].casts_shadow = false;
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square, 0.002);
}

TEST(gathered_light, is_stopped_by_blockers_on_its_way_back_but_for_their_portals) {
    LitSquare lit;
    lit.frame.blockers = {{.center = {0, 0, 0.5}, .half_u = 9, .half_v = 9}};
    EXPECT_EQ(lit.light(), 0) << "no light lists the blocker";
    lit.frame.portals = {{.center = {5, 0, 0.5}, .half_u = 5, .half_v = 9}};
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square / 2, 0.002) << "a portal over one half";
    lit.frame.portals[0].half_u = 0;
    EXPECT_EQ(lit.light(), 0) << "a closed portal";
    lit.frame.portals.clear();
    lit.frame.blockers[0].one_sided = true;
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square, 0.002) << "its normal points away from the square";
    lit.frame.blockers[0].u = {-1, 0, 0};
    EXPECT_EQ(lit.light(), 0) << "its normal points to the square";
}

TEST(gathered_light, is_stopped_by_the_blockers_of_its_light_on_its_way_there) {
    LitSquare lit;
    lit.frame.blockers = {{.center = {5, 0, 2}, .half_u = 5, .half_v = 9}};
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square, 0.002) << "the light does not list it";
    lit.frame.lights[0].blockers = {0};
    EXPECT_NEAR(lit.light() * pi / radiosity, above_square / 2, 0.002);
}

TEST(direct_light, of_every_type_is_in_the_mean_what_the_reference_integrates) {
    Frame frame = tiny::frame(1, 1);
    const indirect::LitSide side{{0.2, -0.1, 2}, glm::normalize(glm::dvec3(0.1, 0.2, -1))};
    SurfacePoint white{.position = side.position, .normal = side.normal};
    white.model = LightingModel::lambert;
    for (const LightType type : {LightType::omni, LightType::round_spot, LightType::square_spot, LightType::tube,
                                 LightType::sphere, LightType::disc, LightType::rectangle, LightType::directional}) {
        Light light;
        light.type = type;
        light.position = {0.5, 0.2, 1};
        light.direction = glm::normalize(glm::vec3(-0.2f, -0.1f, 1));
        light.axis_u = glm::normalize(glm::cross(light.direction, glm::vec3(0, 1, 0)));
        light.intensity = {1, 2, 3};
        light.range = 2.5f;
        light.source_radius = 0.3f;
        light.half_extent = {0.4f, 0.2f};
        frame.lights = {light};
        const indirect::DirectLight direct(frame);
        glm::dvec3 mean(0);
        constexpr int steps = 64;
        for (int i = 0; i < steps * steps; ++i)
            mean += direct.irradiance(0, side, (glm::dvec2(i % steps, i / steps) + 0.5) / double(steps)) / double(steps * steps);
        const glm::dvec3 wanted = pi * exact_reflected(frame, white, light, {.tolerance = 1e-6});
        EXPECT_GT(wanted.x, 0.01);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / wanted[c], 1, 1e-3) << "type " << int(type) << " channel " << c;
    }
}

TEST(direct_light, of_a_soft_source_is_hidden_by_the_share_that_is_covered) {
    Frame frame = tiny::frame(1, 1);
    add_rectangle(frame, {.center = {5, 0, 1}, .u = {5, 0, 0}, .v = {0, 5, 0}});
    for (const LightType type : {LightType::omni, LightType::round_spot, LightType::directional}) {
        Light light = directional({0, 0, 1}, 1);
        light.type = type;
        light.source_radius = 0.4f;
        light.shadow = {.casts = true, .soft = true};
        frame.sun.angular_radius = 0.2f;
        frame.lights = {light};
        const indirect::DirectLight direct(frame);
        constexpr int steps = 16;
        int lit = 0;
        for (int i = 0; i < steps * steps; ++i)
            lit += direct.irradiance(0, {{0, 0, 2}, {0, 0, -1}}, (glm::dvec2(i % steps, i / steps) + 0.5) / double(steps)).x > 0;
        EXPECT_EQ(lit, steps * steps / 2) << "type " << int(type) << ": the sheet covers one half";
    }
}

/// What is gathered in two_rooms over the frames in which its door opens: the means in the right room and in the left one.
struct Rooms {
    double dark = 0, lit = 0, brightest_in_the_dark = 0;
    std::size_t dark_samples = 0;
};
Rooms two_rooms(std::uint32_t frame) {
    const Frame built = (*find_scenario("two_rooms"))->build(frame, {.width = 48, .height = 27, .frames = 8});
    const ImageSet before = gbuffer_truth({built, {}});
    const ReferenceImage light = gathered_light({built, before}, {.side = 6, .batches = 1});
    Rooms rooms;
    std::size_t lit_samples = 0;
    for (std::uint32_t y = 0; y < light.height; ++y)
        for (std::uint32_t x = 0; x < light.width; ++x) {
            const double z = before.at("surface_normal").at(x, y).w, value = light.at(x, y).x;
            if (z <= 0) continue;
            const glm::dvec3 position = pixel_ray(built, x + 0.5, y + 0.5) * z;
            const bool is_right = (built.view.origin + glm::transpose(built.view.to_view) * position).x > 0;
            (is_right ? rooms.dark : rooms.lit) += value;
            ++(is_right ? rooms.dark_samples : lit_samples);
            if (is_right) rooms.brightest_in_the_dark = std::max(rooms.brightest_in_the_dark, value);
        }
    rooms.dark /= double(rooms.dark_samples);
    rooms.lit /= double(lit_samples);
    return rooms;
}

TEST(gathered_light, passes_no_closed_door_and_more_of_it_the_wider_the_door_is_open) {
    const Rooms closed = two_rooms(0), half = two_rooms(4), open = two_rooms(7);
    EXPECT_GT(closed.dark_samples, 300u);
    EXPECT_EQ(closed.brightest_in_the_dark, 0);
    EXPECT_GT(closed.lit, 0.1);
    EXPECT_GT(half.dark, 0.001 * half.lit);
    EXPECT_GT(open.dark, 1.3 * half.dark);
    EXPECT_LT(open.dark, 0.5 * open.lit);
}

}  // namespace strata
