// A probe replays no more of the frame than what decides a pixel's fragments: what it finds is what the whole frame gives.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/reference/ordering.h"
#include "passes/reference/textures.h"
#include "passes/registry.h"
#include "replay/probe/order.h"
#include "replay/probe/probe.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

bool are_equal(const Fragment& a, const Fragment& b) {
    return a.depth == b.depth && a.color == b.color && a.transmittance == b.transmittance && a.emission == b.emission &&
           a.alpha == b.alpha && a.distortion == b.distortion && a.layer == b.layer && a.submission == b.submission;
}

std::vector<Fragment> copy(std::span<const Fragment> list) { return {list.begin(), list.end()}; }

TEST(ProbedPixel, ARowOfFragmentsIsThatOfTheWholeFrame) {
    for (const std::uint32_t samples : {1u, 4u}) {
        const auto session = scenario_session("glass_and_smoke", samples);
        std::size_t compared = 0;
        for (std::uint32_t y = 0; y < must(session->frame(0)).view.height; y += 31) {
            const FragmentLists row = *must(session->row_fragments({}, y)), &all = *must(session->transparent_fragments({}));
            ASSERT_EQ(row.width(), all.width());
            ASSERT_EQ(row.samples(), samples);
            for (std::uint32_t x = 0; x < all.width(); ++x)
                for (std::uint32_t sample = 0; sample < samples; ++sample) {
                    const auto a = copy(row.at(x, y, sample)), b = copy(all.at(x, y, sample));
                    ASSERT_TRUE(std::ranges::equal(a, b, are_equal)) << x << ", " << y << ", sample " << sample;
                    ASSERT_EQ(row.undecided(x, y, sample), all.undecided(x, y, sample));
                    compared += a.size();
                }
        }
        EXPECT_GT(compared, 100u);
    }
}

TEST(ProbedPixel, EveryTechniqueShowsWhatItShowsOfTheFragmentsOfTheWholeFrame) {
    const auto session = scenario_session("glass_and_smoke");
    const Frame frame = must(session->frame(0));
    const PixelAt at{frame.view.width / 2, frame.view.height / 2};
    const auto fragments = copy((*must(session->transparent_fragments({}))).at(at.x, at.y));
    ASSERT_FALSE(fragments.empty());
    const DepthRange range = transparent_depth_range(frame);
    const ProbedStack stack{
        .fragments = fragments, .nearest = double(range.nearest), .farthest = double(range.farthest), .seed = frame.seed};
    const Probe of_stack = must(probe(*session, stack, {.samples = 32})),
                of_pixel = must(probe(*session, {}, at, {.samples = 32}));
    ASSERT_EQ(of_pixel.curves.size(), techniques_of(Stage::transparency).size());
    for (std::size_t i = 0; i < of_pixel.curves.size(); ++i) {
        const ProbeCurve &a = of_pixel.curves[i], &b = of_stack.curves[i];
        EXPECT_EQ(a.through, b.through) << a.variant;
        EXPECT_EQ(a.at_fragments, b.at_fragments) << a.variant;
        EXPECT_EQ(a.total, b.total) << a.variant;
        EXPECT_EQ(a.notes, b.notes) << a.variant;
    }
}

/// The displayed pixel of a replay, as sRGB encodes it.
glm::dvec3 displayed(Session& session, Request request, const std::string& technique, PixelAt at) {
    request.choices = chosen({technique});
    request.outputs = {"display"};
    const glm::dvec4 light = texel(must(session.run(request)).images.at("display"), at.x, at.y);
    return {linear_to_srgb(light.x), linear_to_srgb(light.y), linear_to_srgb(light.z)};
}

void expect_display_errors(Session& session, const Request& request, PixelAt at, const Probe& made) {
    const glm::dvec3 exact = displayed(session, request, "transparency/sorted_lists", at);
    for (const ProbeCurve& curve : made.curves) {
        if (!curve.not_supported.empty()) continue;
        const double off = glm::length(displayed(session, request, curve.variant, at) - exact) / std::sqrt(3.);
        EXPECT_NEAR(curve.metrics.display_error.value(), off, 2e-3) << curve.variant;
    }
}

// Every fragment is a card of its own in a probe: only the frame shows that objects are sorted as wholes, and which layers are
// kept.
TEST(ProbedPixel, DisplaysTheErrorOfTheFrameAndRanksByIt) {
    Session& session = session_of_scenarios();
    const Request request = on_scenario("smoke_grenade");
    const PixelAt at{80, 45};
    const Probe made = must(probe(session, request, at, {.samples = 32}));
    expect_display_errors(session, request, at, made);
    const auto place_of = [&](std::string_view technique) {
        const auto order = best_first(made);
        return std::ranges::find(order, technique, &ProbeCurve::variant) - order.begin();
    };
    EXPECT_LE(place_of("transparency/sorted_lists"), 1);
    EXPECT_GE(place_of("transparency/alpha_blend"), 10) << "exact about fragments, and wrong in the frame";
}

// Its fragments are those of one sample, and a display shows all four.
TEST(ProbedPixel, DisplaysTheErrorOfAllSamples) {
    Session& session = session_of_scenarios();
    const Request request = on_scenario("smoke_grenade", 4);
    const PixelAt at{80, 45, 2};
    const Probe made = must(probe(session, request, at, {.variants = {"transparency/weighted"}, .samples = 8}));
    EXPECT_GT(made.curves.front().metrics.display_error.value(), .01);
    expect_display_errors(session, request, at, made);
}

TEST(ProbedPixel, AnEmptyPixelNamesTheNearestOneWithAFragmentInAnyRow) {
    const auto session = scenario_session("three_panes");
    const FragmentLists lists = *must(session->transparent_fragments({}));
    for (std::uint32_t y = 0; y < lists.height(); ++y) {
        if (!lists.at(0, y).empty()) continue;
        const auto made = probe(*session, {}, {0, y}, {});
        ASSERT_THAT(made, FailsWith("probe.no_fragment", Field("x", 0), Field("y", y), Field("nearest_x", testing::_)));
        EXPECT_EQ(made.error().fault, Fault::usage);
        return;
    }
    FAIL() << "every pixel of the first column has a fragment";
}

}  // namespace
}  // namespace strata
