// Facts of bounds of shadow maps (docs/algorithms/deferred.md 5.4 to 5.7). Depth is 1 at the light, so the chapter's minimum is
// the greatest depth here, and what it draws at depth d lies at 1 - d.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/shadows/bounds/bounds_model.h"
#include "passes/stage_input.h"
#include "tests/support/random_numbers.h"

namespace strata::shadows {

namespace {

constexpr std::uint32_t size = 128;
constexpr glm::dvec2 tilt{6e-4, 2e-4};  // depth per texel of the chapter's ground
constexpr double rise = 8e-4;           // the sum of both: its unit of bias

double ground(const glm::dvec2& u, const glm::dvec2& slope) { return 0.3 + glm::dot(slope, u); }

ReferenceImage plane_map(const glm::dvec2& slope, std::uint32_t edge = size) {
    ReferenceImage map(edge, edge);
    for (std::uint32_t i = 0; i < edge * edge; ++i) map.texels[i].x = ground(glm::dvec2(i % edge, i / edge) + 0.5, slope);
    return map;
}

struct Boxes {
    int count;
    std::uint32_t most_texels;  ///< per edge, at least 4
};

void add_boxes(ReferenceImage& map, const Boxes& boxes) {
    Numbers random(7);
    const std::uint32_t edge = map.width;
    for (int box = 0; box < boxes.count; ++box) {
        const std::uint32_t x = random.below(edge), y = random.below(edge);
        const std::uint32_t w = 4 + random.below(boxes.most_texels - 3), h = 4 + random.below(boxes.most_texels - 3);
        const double depth = double(random.from(0.45f, 0.9f));
        for (std::uint32_t j = y; j < std::min(y + h, edge); ++j)
            for (std::uint32_t i = x; i < std::min(x + w, edge); ++i) map.at(i, j).x = std::max(map.at(i, j).x, depth);
    }
}

/// Boxes of 4 to 16 texels per edge over the ground.
ReferenceImage boxes_map(const glm::dvec2& slope, int boxes) {
    ReferenceImage map = plane_map(slope);
    add_boxes(map, {boxes, 16});
    return map;
}

Lookup lookup_at(const glm::dvec2& u, double depth, const glm::dvec2& gradient = glm::dvec2(0)) {
    return {.size = size, .u = u, .depth = depth, .gradient = gradient};
}

struct Shares {
    double lit = 0, early = 0;
};

/// Of receivers on the ground, moved towards the light by `bias`, anywhere but at the map's border. Their places are spread
/// evenly (Roberts' R2 sequence): as many at random would stray by .008 from the share they stand for.
Shares shares_on_ground(const ReferenceImage& map, const glm::dvec2& slope, double bias, const BoundsSettings& settings,
                        bool follows = false) {
    constexpr int queries = 4000;
    Shares found;
    for (int i = 0; i < queries; ++i) {
        const glm::dvec2 place = glm::fract(0.5 + double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        const glm::dvec2 u = 16.0 + (map.width - 32.0) * place;
        Lookup at = lookup_at(u, ground(u, slope) + bias, follows ? slope : glm::dvec2(0));
        at.size = map.width;
        const Answer answer = early_answer(map, at, 2 * std::int64_t(settings.reach), settings);
        found.lit += answer == Answer::lit;
        found.early += answer != Answer::expensive;
    }
    return {found.lit / queries, found.early / queries};
}

/// Early answers that filtering in full does not give, at receivers in the map and, if they follow no plane, beyond it.
int violations(const ReferenceImage& map, std::int64_t taps, const BoundsSettings& settings, const glm::dvec2& gradient) {
    Numbers random(5);
    const float beyond = gradient == glm::dvec2(0) ? 4 : 0;
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec2 u(random.from(-beyond, size + beyond), random.from(-beyond, size + beyond));
        const Lookup at = lookup_at(u, double(random.from(-0.1f, 1.1f)), gradient);
        const Answer answer = early_answer(map, at, taps, settings);
        if (answer == Answer::expensive) continue;
        wrong += filter_map(map, at, taps).lit != (answer == Answer::lit ? 1 : 0);
    }
    return wrong;
}

constexpr BoundsForm overlapping = BoundsForm::extremes, slabs = BoundsForm::slabs;

}  // namespace

TEST(shadow_bounds, of_a_map_of_8_texels_are_those_of_the_chapter) {
    ReferenceImage map(8, 8);
    for (std::uint32_t i = 0; i < 64; ++i) map.texels[i].x = 1 - i / 64.0;
    const auto of_block = [&](std::uint32_t x, std::uint32_t y, std::uint32_t reach) {
        const Lookup at{.size = 8, .u = glm::dvec2(x, y) * 4.0 + 1.5};
        const Slab found = slab_of(map, at, {.block = 4, .reach = reach}).kept;
        return 64.0 * glm::dvec2(1 - found.greatest, 1 - found.least);  // the chapter's minimum and maximum
    };
    EXPECT_EQ(of_block(0, 0, 0), glm::dvec2(0, 27));
    EXPECT_EQ(of_block(1, 0, 0), glm::dvec2(4, 31));
    EXPECT_EQ(of_block(0, 1, 0), glm::dvec2(32, 59));
    EXPECT_EQ(of_block(1, 1, 0), glm::dvec2(36, 63));
    EXPECT_EQ(of_block(0, 0, 1), glm::dvec2(0, 64)) << "K = 6, with the border";
    EXPECT_EQ(of_block(1, 1, 1), glm::dvec2(27, 64));
}

TEST(shadow_bounds, never_contradict_the_kernel_where_the_window_is_wide_enough_and_do_where_it_is_a_texel_narrower) {
    const ReferenceImage map = boxes_map(tilt, 60);
    for (const std::uint32_t block : {2u, 4u, 8u})
        for (const std::uint32_t taps : {2u, 4u, 8u}) {
            BoundsSettings settings{.form = overlapping, .block = block, .reach = taps / 2};
            EXPECT_EQ(settings.window(), block + taps);
            EXPECT_EQ(violations(map, taps, settings, glm::dvec2(0)), 0) << block << ", " << taps;
            settings.reach -= 1;
            EXPECT_GT(violations(map, taps, settings, glm::dvec2(0)), settings.reach == 0 ? -1 : 15) << block << ", " << taps;
        }
}

TEST(shadow_bounds, without_a_reach_never_contradict_the_kernel) {
    const ReferenceImage map = boxes_map(tilt, 60);
    for (const std::uint32_t block : {2u, 4u, 8u})
        for (const int taps : {2, 4, 8})
            EXPECT_EQ(violations(map, taps, {.form = overlapping, .block = block, .reach = 0}, glm::dvec2(0)), 0);
}

TEST(shadow_bounds, as_slabs_never_contradict_a_kernel_that_follows_any_plane) {
    const ReferenceImage map = boxes_map(tilt, 60);
    for (const glm::dvec2& gradient : {glm::dvec2(0), tilt, glm::dvec2(-0.01, 0.004)})
        for (const BoundsForm form : {slabs, BoundsForm::planes, overlapping})
            EXPECT_EQ(violations(map, 8, {.form = form, .reach = 4}, gradient), 0);
}

TEST(shadow_bounds, light_the_share_of_planar_ground_that_the_closed_form_gives) {
    constexpr double g = 6e-4;
    const ReferenceImage map = plane_map({g, 0});
    struct Case {
        std::uint32_t reach;
        double bias, lit;
    };
    for (const Case& c : {Case{1, .5, 0}, Case{1, 1, .125}, Case{1, 2.5, .5}, Case{1, 4.5, 1}, Case{4, 4, .125}, Case{4, 5.5, .5},
                          Case{4, 7.5, 1}})
        EXPECT_NEAR(shares_on_ground(map, {g, 0}, c.bias * g, {.form = overlapping, .reach = c.reach}).lit, c.lit, 0.001)
            << c.reach << ", " << c.bias;
    for (const double block : {2, 8}) {
        const BoundsSettings settings{.form = overlapping, .block = std::uint32_t(block), .reach = 2};
        EXPECT_NEAR(shares_on_ground(map, {g, 0}, 4 * g, settings).lit, std::clamp((4 - 2 + .5) / block, 0., 1.), 0.001);
    }
}

TEST(shadow_bounds, as_slabs_light_all_of_tilted_ground_where_level_ones_light_next_to_nothing) {
    const ReferenceImage map = plane_map(tilt);
    const auto percent = [&](BoundsForm form, double bias, bool follows) {
        return 100 * shares_on_ground(map, tilt, bias * rise, {.form = form, .reach = 4}, follows).lit;
    };
    EXPECT_NEAR(percent(overlapping, 4, false), 4.1, 1);
    EXPECT_NEAR(percent(overlapping, 6, false), 66.7, 2);
    EXPECT_GT(percent(slabs, 4, false), 99.9);
    EXPECT_GT(percent(slabs, 6, false), 99.9);
    EXPECT_EQ(percent(overlapping, .25, true), 0);
    EXPECT_EQ(percent(slabs, .25, true), 100);
}

/// Percentages of early answers of the chapter's two receivers on tilted ground, kernel 8 x 8 and blocks of 4.
struct EarlyAnswers {
    double level_extremes, level_slabs, following_extremes, following_slabs;
};

EarlyAnswers early_answers(const ReferenceImage& map, const std::string& name) {
    const auto percent = [&](BoundsForm form, bool follows) {
        return 100 * shares_on_ground(map, tilt, (follows ? .25 : 4) * rise, {.form = form, .reach = 4}, follows).early;
    };
    const EarlyAnswers found{percent(overlapping, false), percent(slabs, false), percent(overlapping, true),
                             percent(slabs, true)};
    testing::Test::RecordProperty("percent of " + name,
                                  fmt::format("{:.2f} {:.2f} {:.2f} {:.2f}", found.level_extremes, found.level_slabs,
                                              found.following_extremes, found.following_slabs));
    return found;
}

// The chapter says 4.9, 75.1, 1.9 and 75.3 % of 30 boxes whose sizes it does not give. Its numbers hang together: windows under a
// box alone (1.9 %) are shadowed, and of those over ground alone slabs light all and extremes 4.1 %.
TEST(shadow_bounds, as_slabs_answer_most_lookups_between_30_boxes) {
    ReferenceImage map = plane_map(tilt, 256);
    add_boxes(map, {30, 28});
    const EarlyAnswers found = early_answers(map, "boxes");
    EXPECT_NEAR(found.level_extremes, 4.9, 1.5);
    EXPECT_NEAR(found.level_slabs, 75.1, 5);
    EXPECT_NEAR(found.following_extremes, 1.9, 1.5);
    EXPECT_NEAR(found.following_slabs, 75.3, 5);
    const double under_boxes = found.following_extremes;
    EXPECT_NEAR(found.level_extremes, under_boxes + .041 * (found.level_slabs - under_boxes), .5);
}

// Slabs light the windows without a leaf, (1 - p)^144 of all if p of the texels are leaves, and extremes 4.1 % of those.
TEST(shadow_bounds, of_both_forms_answer_next_to_nothing_under_leaves) {
    for (const double leaves : {750., 1500., 3000.}) {
        ReferenceImage map = plane_map(tilt, 256);
        Numbers random(1);
        for (int leaf = 0; leaf < leaves; ++leaf) map.at(random.below(256), random.below(256)).x = 0.8;
        const double clear = 100 * std::pow(1 - 1. / (256 * 256), 144 * leaves);
        const EarlyAnswers found = early_answers(map, fmt::format("{} leaves", leaves));
        EXPECT_NEAR(found.level_slabs, clear, 2) << leaves;
        EXPECT_NEAR(found.following_slabs, clear, 2) << leaves;
        EXPECT_NEAR(found.level_extremes, .041 * clear, 1) << leaves;
        EXPECT_EQ(found.following_extremes, 0) << leaves;
    }
}

// Cascades move in steps of 4 texels, so blocks of 2 and of 4 hold the same part of the world in every frame.
TEST(shadow_bounds, stay_with_the_world_when_the_map_moves_by_4_texels) {
    const ReferenceImage before = boxes_map(tilt, 60);
    ReferenceImage after(size, size);
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 4; x < size; ++x) after.at(x, y) = before.at(x - 4, y);
    const auto moves_along = [&](BoundsSettings settings) {
        for (double x = 20.5; x < 40; ++x) {
            const Slab a = slab_of(before, lookup_at({x, 50.5}, 0), settings).kept;
            const Slab b = slab_of(after, lookup_at({x + 4, 50.5}, 0), settings).kept;
            if (a.least != b.least || a.greatest != b.greatest || a.slope != b.slope) return false;
        }
        return true;
    };
    for (const BoundsForm form : {overlapping, slabs}) {
        EXPECT_TRUE(moves_along({.form = form, .block = 2, .reach = 4}));
        EXPECT_TRUE(moves_along({.form = form, .block = 4, .reach = 4}));
        EXPECT_FALSE(moves_along({.form = form, .block = 8, .reach = 4})) << "a step of 4 texels is half a block";
    }
}

TEST(shadow_bounds, settle_equality_as_the_kernel_does_and_leave_what_is_no_number_to_it) {
    const ReferenceImage map(size, size, 1, glm::dvec4(0.5));
    const auto answer = [&](double depth, const glm::dvec2& u = {60, 60}) {
        return early_answer(map, lookup_at(u, depth), 4, {.form = overlapping, .reach = 2});
    };
    EXPECT_EQ(answer(0.5), Answer::lit);
    EXPECT_EQ(answer(std::nextafter(0.5, 0)), Answer::shadowed);
    EXPECT_EQ(answer(1.5), Answer::lit) << "nearer than the light";
    EXPECT_EQ(answer(-0.5), Answer::shadowed);
    EXPECT_EQ(answer(-0.5, {1, 60}), Answer::expensive) << "beyond the border nothing is drawn, which is lit";
    EXPECT_EQ(answer(std::numeric_limits<double>::quiet_NaN()), Answer::expensive);
}

}  // namespace strata::shadows
