// Which pixels show a draw.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/reference/fragments.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

TEST(DrawCover, OfAllOpaqueDrawsIsWhereDepthIsAndEachPixelShowsOne) {
    for (const char* scenario : {"opaque_only", "materials"}) {
        const auto session = scenario_session(scenario);
        const Frame frame = must(session->frame(0));
        const auto depth = must(session->run({.outputs = {"depth_layers"}})).images.at("depth_layers");
        std::vector<int> showing(std::size_t(frame.view.width) * frame.view.height);
        std::size_t hidden = 0, shown = 0, empty = 0, several = 0;
        for (const std::uint32_t draw : opaque_draws(frame)) {
            const auto cover = must(session->draw_cover({}, draw));
            ASSERT_EQ(cover.size(), showing.size());
            for (std::size_t i = 0; i < cover.size(); ++i) showing[i] += cover[i] == Cover::shown;
            hidden += std::size_t(std::ranges::count(cover, Cover::hidden));
        }
        for (std::size_t i = 0; i < showing.size(); ++i) {
            const bool is_surface = texel(depth, std::uint32_t(i % frame.view.width), std::uint32_t(i / frame.view.width)).x > 0;
            EXPECT_EQ(showing[i] > 0, is_surface) << scenario << " " << i;
            shown += showing[i] > 0;
            several += showing[i] > 1;  // where surfaces meet
            empty += !is_surface;
        }
        EXPECT_GT(shown, 500u) << scenario;
        EXPECT_GT(hidden, 0u) << scenario;
        EXPECT_LT(several, shown / 20) << scenario << " " << empty;
    }
}

TEST(DrawCover, OfTransparentDrawsAndEmittersIsWhereTheirFragmentsAre) {
    const auto session = scenario_session("glass_and_smoke");
    const Frame frame = must(session->frame(0));
    const Request request;
    std::vector<bool> shows(std::size_t(frame.view.width) * frame.view.height);
    for (const std::uint32_t draw : transparent_draws(frame)) {
        const auto cover = must(session->draw_cover(request, draw));
        for (std::size_t i = 0; i < cover.size(); ++i) shows[i] = shows[i] || cover[i] == Cover::shown;
    }
    const FragmentLists& fragments = *must(session->transparent_fragments(request));
    std::size_t found = 0;
    for (std::size_t i = 0; i < shows.size(); ++i) {
        const bool has = !fragments.at(std::uint32_t(i % frame.view.width), std::uint32_t(i / frame.view.width)).empty();
        EXPECT_TRUE(shows[i] || !has) << i;  // the other way round not: what adds and hides nothing is dropped
        found += has;
    }
    EXPECT_GT(found, 500u);
}

TEST(DrawCover, FollowsTheEye) {
    const auto session = scenario_session("opaque_only");
    const std::uint32_t draw = opaque_draws(must(session->frame(0))).front();
    EXPECT_GT(std::ranges::count(must(session->draw_cover({}, draw)), Cover::shown), 0);
    EXPECT_EQ(std::ranges::count(must(session->draw_cover({.variant = {.eye = {.dolly = 1000}}}, draw)), Cover::shown), 0);
    EXPECT_THAT(session->draw_cover({}, 1000), FailsWith("frame.no_draw", Field("draw", 1000)));
}

}  // namespace
}  // namespace strata
