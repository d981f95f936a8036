// Which draws can be seen at all: the target of culling.
#include <gtest/gtest.h>

#include "passes/culling/judge.h"
#include "passes/culling/truth.h"
#include "passes/stage_input.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {

namespace {

std::vector<double> visible_set(const Frame& frame) {
    const ImageSet before;
    const ImageSet truth = culling_truth({frame, before});
    std::vector<double> visible;
    for (std::size_t i = 0; i < frame.draws.size(); ++i) visible.push_back(truth.at("visible").texels[i].x);
    return visible;
}

}  // namespace

TEST(visible_set, leaves_out_what_is_wholly_behind_something_or_out_of_the_picture) {
    Frame frame = tiny::frame(16, 16);
    tiny::add_quad(frame, {4, 4, 8, 8}, 5);  // behind the next one
    tiny::add_quad(frame, {3, 3, 9, 9}, 2);
    tiny::add_quad(frame, {7, 7, 12, 12}, 5);  // looks out from behind it
    tiny::add_quad(frame, {20, 3, 24, 9}, 2);  // right of the picture
    EXPECT_EQ(visible_set(frame), (std::vector<double>{0, 1, 1, 0}));
}

TEST(visible_set, sees_through_what_is_transparent_and_counts_opaque_draws_alone) {
    Frame frame = tiny::frame(16, 16);
    tiny::add_quad(frame, {3, 3, 9, 9}, 2, AlphaMode::blend);
    tiny::add_quad(frame, {4, 4, 8, 8}, 5);
    EXPECT_EQ(visible_set(frame), (std::vector<double>{1, 0}));  // one opaque draw, then unused texels
}

TEST(visible_set, sees_through_the_holes_of_masked_draws) {
    Frame frame = tiny::frame(16, 16);
    tiny::add_quad(frame, {4, 4, 8, 8}, 5);
    const std::uint32_t fence = tiny::add_quad(frame, {3, 3, 9, 9}, 2, AlphaMode::mask);
    tiny::material(frame, fence).base_color.w = 0.25f;
    tiny::material(frame, fence).mask_cutoff = 0.5f;
    EXPECT_EQ(visible_set(frame), (std::vector<double>{1, 0}));
}

TEST(visible_set, judges_holes_before_waste) {
    Frame frame = tiny::frame(16, 16);
    tiny::add_quad(frame, {4, 4, 8, 8}, 5);
    tiny::add_quad(frame, {3, 3, 9, 9}, 2);
    tiny::add_quad(frame, {10, 10, 12, 12}, 2);
    const ImageSet before;
    const StageInput input{frame, before};
    const ImageSet truth = culling_truth(input);
    ImageSet drawn = truth;
    drawn.at("visible").texels[0].x = 1;
    drawn.at("visible").texels[2].x = 0;
    const auto metrics = culling_judge(drawn, truth, input);
    EXPECT_EQ(metrics[0].name, "wrongly hidden");
    EXPECT_EQ(metrics[0].value, 1);
    EXPECT_EQ(metrics[1].value, 1);
    EXPECT_EQ(metrics[2].value, 2);
    EXPECT_EQ(metrics[3].value, 2);
}

/// The quad behind ends .004 pixel before the middle of a pixel beside the one in front: rounding may show it there.
TEST(visible_set, takes_a_draw_that_rounding_may_show_neither_for_hidden_nor_for_seen) {
    Frame frame = tiny::frame(16, 16);
    tiny::add_quad(frame, {4, 4, 9.496, 8}, 5);
    tiny::add_quad(frame, {3, 3, 9, 9}, 2);
    const ImageSet before;
    const StageInput input{frame, before};
    const ImageSet truth = culling_truth(input);
    EXPECT_TRUE(truth.at("visible").undecided[0]);
    EXPECT_FALSE(truth.at("visible").undecided[1]);
    ImageSet drawn = truth;
    for (const double is_drawn : {0., 1.}) {
        drawn.at("visible").texels[0].x = is_drawn;
        const auto metrics = culling_judge(drawn, truth, input);
        EXPECT_EQ(metrics[0].value, 0) << "wrongly hidden";
        EXPECT_EQ(metrics[1].value, 0) << "needlessly drawn";
    }
}

}  // namespace strata
