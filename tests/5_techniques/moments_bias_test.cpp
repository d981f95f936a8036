// The bias of transparency/moments where it is large enough to be seen. The published one of FP32 sums is 5e-7: a shader that
// mixed in twice as much would give the same picture.
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/agreement.h"

namespace strata {
namespace {

class MomentsBias : public testing::TestWithParam<std::string> {};

TEST_P(MomentsBias, MixesInAsMuchAsTheModelAtTwentyTimesThePublished) {
    const std::vector<Card> panes{{.center = {0, 0, 2}, .half = 1.5f, .color = {.8f, .3f, .1f, .5f}},
                                  {.center = {0, 0, 3}, .half = 2, .color = {.1f, .4f, .9f, .5f}},
                                  {.center = {0, 0, 5}, .half = 4, .color = {.9f, .9f, .2f, .5f}}};
    const auto session = session_of(std::vector<Frame>{frame_of_cards(panes, 16)});
    const Technique& moments = *must(find_technique("transparency/moments"));
    const auto error_at = [&](const std::string& bias) {
        const Request request{.choices = chosen({"transparency/moments"}, {GetParam(), "storage=half", "bias=" + bias})};
        const Accuracy accuracy = must(session->judge(request, Stage::transparency));
        expect_within_tolerance(accuracy, moments, request);
        return accuracy.technique_errors.front().value;
    };
    EXPECT_GT(error_at("20"), 1.05 * error_at("10")) << "so much is seen of twice the bias";
}

INSTANTIATE_TEST_SUITE_P(Kinds, MomentsBias, testing::Values("kind=power4", "kind=power6", "kind=power8"),
                         [](const auto& tested) { return tested.param.substr(5); });

}  // namespace
}  // namespace strata
