// Which way the device rounds what it blends: what it measures of itself holds for sums of many layers, and decides whether a
// model of a technique that blends agrees with it.
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/shader_interop.h"
#include "passes/technique.h"
#include "replay/measure/measured_rounding.h"
#include "replay/session/judgment.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

/// The optical depth of 200 layers of alpha .01, blended layer by layer: 2.010, were nothing rounded.
double sum_of_layers(Format format) {
    TestFrame frame;
    frame.shader("constant.frag", R"(
        layout(push_constant) uniform Push { vec4 color; };
        layout(location = 0) out vec4 out_color;
        void main() { out_color = color; })");
    Image sum = frame.graph.create("sum", {.extent = {1, 1}, .format = format});
    frame.graph.clear(sum, {});
    for (int i = 0; i < 200; ++i) frame.graph.fullscreen("constant").adds_to(sum).push(glm::vec4(float(-std::log(.99))));
    return texel(frame.result(sum), 0, 0).x;
}

/// With 6 bits behind the leading one a step is 1/128 below 1, 1/64 below 2 and 1/32 beyond: rounded towards zero, the sum stops
/// at 1, where a layer of .01005 is less than a step; to nearest at 2, where it is less than half. 10 bits lose a step now and
/// then.
TEST(MeasuredRounding, IsThatOfASumOfTwoHundredLayers) {
    const BlendRounding rounding = measured_rounding(shared_device());
    EXPECT_EQ(sum_of_layers(Format::r16f), rounding.half == Rounding::towards_zero ? 1.96484375 : 1.990234375);
    EXPECT_EQ(sum_of_layers(Format::r11g11b10f), rounding.packed == Rounding::towards_zero ? 1 : 2);
}

Frame two_hundred_cards() {
    std::vector<Card> cards;
    for (int i = 0; i < 200; ++i) cards.push_back({.center = {0, 0, 2 + .03 * i}, .color = {.8f, .4f, .2f, .01f}});
    return frame_of_cards(cards, 8);
}

Rounding other(Rounding r) { return r == Rounding::to_nearest ? Rounding::towards_zero : Rounding::to_nearest; }

/// A technique that keeps sums in half floats, or in 11 and 10 bits.
struct Blended {
    std::string_view technique, param, value;
    Rounding BlendRounding::*decides;
};
void PrintTo(const Blended& b, std::ostream* out) { *out << b.technique << " " << b.param << "=" << b.value; }

class RoundedModel : public testing::TestWithParam<Blended> {};

TEST_P(RoundedModel, AgreesWithTheDeviceByItsRoundingAlone) {
    const auto& [name, param, value, decides] = GetParam();
    const Technique& technique = *must(find_technique(name));
    Choice choice{&technique, Settings(technique.params)};
    must(choice.settings.set(param, value));
    const Frame frame = two_hundred_cards();
    const auto session = must(Session::open({frame}, {.validation = true}));
    const auto run = must(session->run({.choices = chosen({std::string(name)}, choice.settings.lines()), .outputs = {"color"}}));
    const Features features = frame_features(frame);
    const ImageSet before{{"color", ReferenceImage(8, 8, 1, {0, 0, 0, 1})}}, result{{"color", in_double(run.images.at("color"))}};

    JudgedStage judged{frame, features, choice, before, result, Against::model};
    judged.rounding = measured_rounding(shared_device());
    const double error = judge_stage(judged).model_rmse;
    judged.rounding.*decides = other(judged.rounding.*decides);
    EXPECT_LT(5 * error, judge_stage(judged).model_rmse) << error;
}

INSTANTIATE_TEST_SUITE_P(Techniques, RoundedModel,
                         testing::Values(Blended{"transparency/weighted", "weight", "constant", &BlendRounding::half},
                                         Blended{"transparency/wavelet", "storage", "half", &BlendRounding::half},
                                         Blended{"transparency/stochastic", "correction", "alpha", &BlendRounding::half},
                                         Blended{"transparency/weighted_additive", "reveal", "r16f", &BlendRounding::half},
                                         Blended{"transparency/exact_function", "accumulation", "half", &BlendRounding::half},
                                         Blended{"transparency/exact_function", "accumulation", "packed",
                                                 &BlendRounding::packed}));

}  // namespace
}  // namespace strata
