// Truths where rounding decides: what else a sample may show, against all choices written out and pixels placed by hand.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "passes/gbuffer/judge.h"
#include "passes/gbuffer/truth.h"
#include "passes/reference/settle.h"
#include "passes/stage_input.h"
#include "passes/transparency/truth.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

/// Samples of the middle of a pixel lie this near to a side, in pixels: less than the 1.5 of 256 steps that may be rounded away.
constexpr double beside = 0.004;

/// All images that rounding allows of the fragments: every choice of those that may be absent, every order of those at one depth.
struct AllChoices {
    std::vector<Fragment> certain;
    std::vector<Fragment> optional_ones;
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL};

    void look(glm::dvec3 behind) {
        for (unsigned chosen = 0; chosen < 1u << optional_ones.size(); ++chosen) {
            std::vector<Fragment> present = certain;
            for (std::size_t i = 0; i < optional_ones.size(); ++i)
                if (chosen >> i & 1) present.push_back(optional_ones[i]);
            look_at_orders(present, behind);
        }
    }

private:
    void look_at_orders(const std::vector<Fragment>& present, const glm::dvec3& behind) {
        std::vector<std::size_t> order(present.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        do {
            bool is_sorted = true;  // far to near, but for depths that a float cannot tell apart
            for (std::size_t i = 1; i < order.size(); ++i)
                is_sorted = is_sorted && present[order[i - 1]].depth > present[order[i]].depth * (1 - 1e-7);
            if (!is_sorted) continue;
            glm::dvec3 color = behind;
            for (const std::size_t i : order) color = present[i].color + present[i].transmittance * color;
            low = glm::min(low, color);
            high = glm::max(high, color);
        } while (std::next_permutation(order.begin(), order.end()));
    }
};

Fragment random_fragment(tiny::Random& random, double depth, std::uint32_t submission) {
    Fragment fragment;
    fragment.depth = depth;
    fragment.transmittance = random.inside(0, 1);
    fragment.color = random.inside(0, 2) * (1.0 - fragment.transmittance);
    fragment.submission = submission;
    return fragment;
}

TEST(BlendInterval, IsThatOfAllChoicesAndOrders) {
    tiny::Random random(5);
    for (int turn = 0; turn < 200; ++turn) {
        AllChoices all;
        std::vector<Fragment> fragments;
        std::vector<NearMiss> near_misses;
        for (std::uint32_t i = 0; i < 6; ++i) {
            // The third and fourth, and the fifth and sixth, lie at one depth but for a float's rounding.
            const double depth = i < 2 ? 1 + i : i < 4 ? 3 + i * 1e-7 : 5 + i * 2e-7;
            Fragment fragment = random_fragment(random, depth, i);
            fragment.may_be_absent = random() < 0.4;
            (fragment.may_be_absent ? all.optional_ones : all.certain).push_back(fragment);
            if (fragment.may_be_absent && random() < 0.5) near_misses.push_back({.slot = 0, .fragment = fragment});
            else fragments.push_back(fragment);
        }
        const glm::dvec3 behind = random.inside(0, 1);
        all.look(behind);
        const RadianceInterval interval = blend_interval(fragments, near_misses, behind);
        EXPECT_LT(glm::length(interval.low - all.low), 1e-12) << turn;
        EXPECT_LT(glm::length(interval.high - all.high), 1e-12) << turn;
        const glm::dvec3 exact = exact_blend(fragments, behind);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(interval.low, exact + 1e-12))) << turn;
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(interval.high, exact - 1e-12))) << turn;
    }
}

TEST(BlendInterval, OfTwoTrianglesThatShareASideIsThatOfEitherAndNotOfNone) {
    tiny::Random random(6);
    const Fragment here = random_fragment(random, 2, 7);
    const NearMiss neighbor{.slot = 0, .fragment = random_fragment(random, 2.001, 8), .instead_of = 7};
    const glm::dvec3 behind(100), one = here.color + here.transmittance * behind,
                                  other = neighbor.fragment.color + neighbor.fragment.transmittance * behind;
    const RadianceInterval interval = blend_interval(std::vector{here}, std::vector{neighbor}, behind);
    EXPECT_EQ(interval.low, glm::min(one, other));
    EXPECT_EQ(interval.high, glm::max(one, other));
}

/// A roof whose ridge passes beside the middle of pixels of column 8, and whose left end is beside those of column 3; a wall
/// behind it, or nothing.
Frame roof(AlphaMode mode, bool has_wall) {
    Frame frame = tiny::frame(16, 16);
    if (has_wall) tiny::add_quad(frame, {.left = -1, .top = -1, .right = 17, .bottom = 17}, 9);
    Mesh mesh;
    const double columns[] = {3.5 - beside, 8.5 + beside, 14}, depths[] = {4, 3, 4};
    for (int column = 0; column < 3; ++column)
        for (const double row : {-1.0, 17.0}) {
            mesh.positions.push_back(glm::vec3(tiny::under(frame, columns[column], row, depths[column])));
            mesh.normals.push_back(glm::vec3(0, 0, -1));
        }
    mesh.indices = {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5};
    mesh.normals.clear();
    tiny::add_mesh(frame, std::move(mesh), mode);
    return frame;
}

std::vector<RasterPoint> rivals_at(const VisiblePoints& visible, std::uint32_t x, std::uint32_t y) {
    std::vector<RasterPoint> found;
    std::ranges::copy_if(visible.rivals, std::back_inserter(found), [&](const RasterPoint& p) { return p.x == x && p.y == y; });
    return found;
}

TEST(VisiblePoints, OfASharedSideMayBeOneOfTwoTrianglesAndOfASilhouetteWhatIsBehind) {
    for (const bool has_wall : {false, true}) {
        const Frame frame = roof(AlphaMode::opaque, has_wall);
        const VisiblePoints visible = visible_points(frame, opaque_draws(frame), {.shade_at = ShadeAt::sample});
        const std::uint32_t roof_draw = has_wall ? 1 : 0;
        for (const std::uint32_t y : {1u, 13u}) {  // the diagonals of the quads are elsewhere
            const auto ridge = rivals_at(visible, 8, y), end = rivals_at(visible, 3, y);
            ASSERT_EQ(ridge.size(), 1u) << y;
            EXPECT_EQ(ridge[0].draw, roof_draw);
            EXPECT_NE(ridge[0].triangle, visible.at(8, y).triangle);
            EXPECT_TRUE(visible.at(8, y).undecided);
            ASSERT_EQ(end.size(), 1u) << y;
            EXPECT_EQ(end[0].draw, has_wall ? 0u : no_index);
            EXPECT_TRUE(rivals_at(visible, 11, y).empty());
            EXPECT_FALSE(visible.at(11, y).undecided);
        }
    }
}

TEST(Fragments, OfASharedSideAreOneOfTwoAndOfASilhouetteMayBeAbsent) {
    const Frame frame = roof(AlphaMode::blend, true);
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    const auto ridge = lists.near_misses(8, 1), end = lists.near_misses(3, 1);
    ASSERT_EQ(lists.at(8, 1).size(), 1u);
    EXPECT_FALSE(lists.at(8, 1)[0].may_be_absent);
    ASSERT_EQ(ridge.size(), 1u);
    EXPECT_EQ(ridge[0].instead_of, lists.at(8, 1)[0].submission);
    ASSERT_EQ(lists.at(3, 1).size(), 1u);
    EXPECT_TRUE(lists.at(3, 1)[0].may_be_absent);
    EXPECT_TRUE(end.empty());
}

TEST(Settle, MovesAnUndecidedTexelTowardsTheResultWithinItsInterval) {
    ReferenceImage truth(2, 2, 1, glm::dvec4(3)), got = truth;
    truth.undecided = {false, true, true, true};
    truth.alternatives = {{1, glm::dvec4(1)}, {1, glm::dvec4(5)}, {3, glm::dvec4(4)}};
    got.texels = {glm::dvec4(9), glm::dvec4(0, 2, 7, 3), glm::dvec4(8), glm::dvec4(std::numeric_limits<double>::quiet_NaN())};
    EXPECT_DOUBLE_EQ(settle(got, truth), std::sqrt((4 * 4 + 1) / 4.));
    EXPECT_EQ(truth.undecided, (std::vector<bool>{false, false, true, false})) << "what else the third may be is not known";
    EXPECT_EQ(truth.texels[0], glm::dvec4(3));
    EXPECT_EQ(truth.texels[1], glm::dvec4(1, 2, 5, 3));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(truth.texels[3], glm::dvec4(4)))) << "a result that is not a number does not spread";
}

/// The roof's planes lie at an angle: a sample beside the ridge that shows the other plane is right, one between the planes is
/// off by the angle to the nearer.
TEST(Settle, OfAGBufferTakesTheNearestSurfaceThatRoundingAllows) {
    const Frame frame = roof(AlphaMode::opaque, true);
    const ImageSet truth = gbuffer_truth({frame, {}});
    const ReferenceImage& normals = truth.at("surface_normal");
    const std::size_t i = normals.index(8, 1);
    ASSERT_TRUE(normals.undecided[i]);
    const auto worst_with = [&](const glm::dvec3& normal) {
        ImageSet result = truth, settled = truth;
        for (auto& [name, image] : result)
            for (const Alternative& other : image.alternatives)
                if (other.texel == i) image.texels[i] = other.value;
        result.at("surface_normal").texels[i] = glm::dvec4(normal, result.at("surface_normal").texels[i].w);
        const Metric bound = settle_gbuffer(result, settled);
        EXPECT_EQ(bound.unit, "degrees");
        EXPECT_GT(bound.value, 0);
        EXPECT_EQ(std::ranges::count(settled.at("surface_normal").undecided, true), 0);
        return gbuffer_judge(result, settled, {frame, {}})[1].value;
    };
    const auto other = std::ranges::find(normals.alternatives, i, &Alternative::texel)->value;
    const glm::dvec3 one(normals.texels[i]), two(other);
    const double between = glm::degrees(std::acos(glm::dot(one, two)));
    ASSERT_GT(between, 20);
    EXPECT_NEAR(worst_with(two), 0, 1e-9);
    EXPECT_NEAR(worst_with(glm::normalize(one + 3.0 * two)),
                glm::degrees(std::acos(glm::dot(glm::normalize(one + 3.0 * two), two))), 1e-6)
        << "closer to the other plane";
}

}  // namespace
}  // namespace strata
