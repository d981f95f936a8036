// Traced shadows: the target of shadow techniques. The eye at the origin looks along +z at a wall 10 m away.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "passes/shadows/judge.h"
#include "passes/shadows/truth.h"
#include "passes/stage_input.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {

namespace {

constexpr std::uint32_t size = 32;

// The wall fills the picture; the sun shines on it along its normal, past a card that hides pixels 8..16 from the eye and,
// half way to the wall, shades 12..16.
struct Stand {
    Frame frame = tiny::frame(size, size);
    ImageSet before;

    Stand() {
        tiny::add_quad(frame, {-2, -2, size + 2, size + 2}, 10);
        tiny::add_quad(frame, {8, 8, 16, 16}, 5);
        frame.sun.direction = glm::vec3(glm::transpose(frame.view.to_view) * glm::dvec3(0, 0, 1));
        frame.sun.irradiance = {1, 1, 1};
        frame.sun.shadow.casts = true;
        const double wall = double(frame.view.near) / 10;
        before["depth_layers"] = ReferenceImage(size, size, 1, glm::dvec4(wall, 0, 0, 1));
        before["surface_normal"] = ReferenceImage(size, size, 1, glm::dvec4(0, 0, -1, 10));
    }
    ReferenceImage traced() const { return shadows_truth({frame, before}).at("visibility"); }
};

}  // namespace

TEST(traced_shadow, of_parallel_light_is_as_large_as_what_casts_it) {
    const ReferenceImage visibility = Stand().traced();
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const bool shaded = x >= 12 && x < 16 && y >= 12 && y < 16;  // half the card's 8 pixels, twice as far away
            EXPECT_EQ(visibility.at(x, y).x, shaded ? 0 : 1) << x << ", " << y;
        }
    }
}

TEST(traced_shadow, is_cast_by_nothing_that_does_not_cast) {
    Stand stand;
    stand.frame.draws[1].casts_shadow = false;
    EXPECT_EQ(stand.traced().at(14, 14).x, 1);
}

TEST(traced_shadow, of_a_spot_ends_at_the_light) {
    Stand stand;
    stand.frame.sun.irradiance = {};
    const glm::dvec3 behind_the_card = tiny::under(stand.frame, 12, 12, 6);
    stand.frame.lights = {{.type = LightType::round_spot,
                           .position = behind_the_card,
                           .direction = stand.frame.sun.direction,
                           .range = 100,
                           .shadow = {.casts = true}}};
    EXPECT_EQ(stand.traced().at(14, 14).x, 1);
    stand.frame.lights[0].position = tiny::under(stand.frame, 12, 12, 4);
    EXPECT_EQ(stand.traced().at(12, 12).x, 0);
}

// A card hides the left half of the wall from whatever shines straight at it from before the card, 5 m away; a pixel of the wall
// has .625 m. An edge at t of a disc's radius from its middle uncovers .5 + (t sqrt(1 - t^2) + asin t) / pi of it.
class HalfCovered {
public:
    HalfCovered() {
        stand.frame.draws.pop_back();
        tiny::add_quad(stand.frame, {-100, -100, 16, 132}, 5);
        stand.frame.sun.shadow.soft = true;
    }
    void expect_share(double source_width_on_wall) const {
        const ReferenceImage visibility = stand.traced();
        for (std::uint32_t x = 0; x < size; ++x) {
            const double t = std::clamp((x + 0.5 - 16) * 0.625 / (0.5 * source_width_on_wall), -1.0, 1.0);
            const double share = 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi;
            EXPECT_NEAR(visibility.at(x, 16).x, share, 0.012) << x;
        }
    }
    Stand stand;
};

TEST(traced_shadow, of_a_soft_sun_is_the_covered_share_of_its_disc) {
    HalfCovered half;
    half.stand.frame.sun.angular_radius = 0.1f;
    half.expect_share(2 * std::tan(0.1) * 5);
}

TEST(traced_shadow, of_a_soft_light_is_the_covered_share_of_its_source_by_similar_triangles) {
    for (const LightType type : {LightType::round_spot, LightType::omni}) {
        HalfCovered half;
        half.stand.frame.sun.irradiance = {};
        half.stand.frame.lights = {{.type = type,
                                    .position = tiny::under(half.stand.frame, 16, 16, 2),
                                    .direction = half.stand.frame.sun.direction,
                                    .range = 100,
                                    .source_radius = 0.5f,
                                    .shadow = {.casts = true, .soft = true}}};
        half.expect_share(2 * 0.5 * 5 / 3.0);  // the card is 3 m from the light, the wall 5 m farther
    }
}

TEST(traced_shadow, of_a_light_that_is_not_soft_has_no_penumbra_whatever_its_radius) {
    HalfCovered half;
    half.stand.frame.sun.shadow.soft = false;
    half.stand.frame.sun.angular_radius = 0.2f;
    half.expect_share(1e-9);
}

TEST(traced_shadow, judges_light_where_shadow_should_be) {
    const Stand stand;
    const StageInput input{stand.frame, stand.before};
    const ImageSet truth = shadows_truth(input);
    const ImageSet lit = {{"visibility", ReferenceImage(size, size, 1, glm::dvec4(1))}};
    const auto metrics = shadows_judge(lit, truth, input);
    EXPECT_EQ(metrics[0].name, "rmse");
    EXPECT_EQ(metrics[0].value, 0.125);  // 16 of 1024 pixels
    EXPECT_EQ(metrics[1].value, 100.0 / 64);
    EXPECT_EQ(metrics[2].value, 0);
}

}  // namespace strata
