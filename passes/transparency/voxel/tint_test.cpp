// Facts about color where T(z) has one channel (docs/algorithms/transparency.md 6.12).
#include "passes/transparency/functions/tint_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/transparency/functions/model.h"
#include "passes/transparency/sample_blend.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

Fragment glass(double depth, glm::dvec3 t, double reflected) {
    return {.depth = depth, .color = glm::dvec3(reflected), .transmittance = t, .alpha = 1};
}

/// The luminance of the exact T(z): what one channel holds at its best.
Transmittance exact_luminance(std::span<const Fragment> fragments) {
    return [fragments](const Fragment& at) {
        double through = 1;
        for (const Fragment& f : fragments)
            if (f.depth < at.depth) through *= luminance(f.transmittance);
        return glm::dvec3(through);
    };
}
const Transmittance nothing_hides = [](const Fragment&) { return glm::dvec3(1); };

glm::dvec3 tinted(std::span<const Fragment> fragments, double behind, std::uint32_t tint, double fog_density = 0) {
    std::vector<Fragment> fogged(fragments.begin(), fragments.end());
    for (Fragment& f : fogged) f.fog = std::exp(-fog_density * f.depth);
    return function_blend(fogged, glm::dvec3(behind), exact_luminance(fogged), {.tint = tint});
}

double largest_difference(glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

const glm::dvec3 green(.2, .8, .2);

TEST(Tint, SkewsWhatASingleGlassReflectsAsTheChapterSays) {
    const std::array single{glass(1, green, .1)};
    EXPECT_NEAR(luminance(green), .62912, 1e-12);
    const glm::dvec3 skewed = skew(skew_depths(single[0], 1));
    EXPECT_NEAR(skewed.x, .317904, 5e-7);
    EXPECT_NEAR(skewed.y, 1.271617, 5e-7);
    const glm::dvec3 surface = tinted(single, 0, tint_skew);
    EXPECT_LT(largest_difference(surface, {.0318, .1272, .0318}), 5e-5);
    EXPECT_LT(largest_difference(tinted(single, 0, tint_corrected), glm::dvec3(.1)), 1e-12);
}

TEST(Tint, LeavesTheBackgroundExact) {
    const std::array panes{glass(1, green, .1), glass(2, {.9, .3, .1}, .05)};
    for (const std::uint32_t tint : {tint_total, tint_skew, tint_corrected})
        for (const double fog : {0., .3}) {
            const glm::dvec3 background = tinted(panes, 1, tint, fog) - tinted(panes, 0, tint, fog);
            EXPECT_LT(largest_difference(background, panes[0].transmittance * panes[1].transmittance), 1e-12) << tint;
        }
}

TEST(Tint, IsExactOnGraySmokeBehindGlass) {
    const std::array fragments{glass(1, green, .1), layer(2, .5, .8)};
    const glm::dvec3 wanted = exact_blend(fragments, glm::dvec3(.3));
    EXPECT_LT(largest_difference(tinted(fragments, .3, tint_corrected), wanted), 1e-12);
    EXPECT_GT(largest_difference(tinted(fragments, .3, tint_total), wanted), .1);
}

TEST(Tint, RestoresASingleLayerInAnyFogAndOfAnyColor) {
    const std::array colors{green, glm::dvec3(0, 1, 0), glm::dvec3(1e-9, .5, 1), glm::dvec3(0, 0, .3)};
    for (const glm::dvec3 color : colors)
        for (const double fog : {0., .2, 3.}) {
            const std::array single{glass(2, color, .1)};
            EXPECT_LT(largest_difference(tinted(single, 0, tint_corrected, fog), glm::dvec3(.1)), 1e-12);
        }
    // Fogged glass tints less what is behind it: nothing at all from far away.
    const std::array far{glass(100, green, 0), layer(101, .5, 1)};
    const glm::dvec3 seen = tinted(far, 0, tint_skew, 1);
    EXPECT_NEAR(seen.x, seen.y, 1e-12);
}

TEST(Tint, IsNothingToWhatIsGray) {
    const std::array smoke{layer(1, .3, .7), layer(7, .5, .2), layer(20, .2, .9)};
    for (const std::uint32_t tint : {tint_skew, tint_corrected})
        EXPECT_LT(largest_difference(tinted(smoke, .4, tint), tinted(smoke, .4, tint_total)), 1e-12);
}

TEST(Tint, ReachesWhatIsInFrontOfTheGlassToo) {
    const std::array fragments{layer(1, .5, .8), glass(2, green, 0)};
    EXPECT_LT(largest_difference(exact_blend(fragments, glm::dvec3(0)), glm::dvec3(.4)), 1e-12);
    EXPECT_LT(largest_difference(tinted(fragments, 0, tint_corrected), {.2332, .4664, .2332}), 5e-5);
}

/// Clear plastic an eighth of an inch before red glass that is nearly opaque: in one slice, and told apart.
TEST(Tint, FailsOnBackToBackGlass) {
    const std::array fragments{layer(1, .1, .5), glass(1.003, {.3, .02, .02}, .02)};
    EXPECT_LT(largest_difference(exact_blend(fragments, glm::dvec3(0)), glm::dvec3(.068)), 1e-12);
    const auto in_one_slice = [&](std::uint32_t tint) {
        return function_blend(fragments, glm::dvec3(0), nothing_hides, {.tint = tint});
    };
    EXPECT_LT(largest_difference(in_one_slice(tint_total), {.0639, .0636, .0636}), 1e-4);
    EXPECT_LT(largest_difference(in_one_slice(tint_skew), {.2402, .0160, .0160}), 1e-4);
    EXPECT_LT(largest_difference(in_one_slice(tint_corrected), {.1898, .0296, .0296}), 1e-4);
    // More slices do not help: the glass is seen with .9 either way, and its skew knows no order.
    EXPECT_LT(largest_difference(tinted(fragments, 0, tint_corrected), {.1957, .0335, .0335}), 1e-4);
}

}  // namespace
}  // namespace strata::transparency
