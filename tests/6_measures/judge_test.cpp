// The judge: a result against its model and the stage's truth. Every verdict about a technique rests on it, so its numbers are
// worked out by hand here.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/reference/fragments.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "replay/session/judgment.h"

namespace strata {
namespace {

using testing::HasSubstr;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// A technique of the transparency stage whose model gives the images that were there before.
struct Judged {
    Technique technique{.stage = Stage::transparency,
                        .name = "transparency/made_here",
                        .model = [](const StageInput& input, const Settings&) { return input.before; }};
    Frame frame;
    Features features;
    ImageSet model, result;

    /// Both images are 3 x 2 with two layers, and 2 in every channel: the root mean square is 2.
    Judged() { model["color"] = result["color"] = ReferenceImage(3, 2, 2, glm::dvec4(2)); }

    Accuracy against_model() const {
        const Choice choice{&technique, {}};
        return judge_stage({frame, features, choice, model, result, Against::model});
    }
    Accuracy against_truth(const ImageSet& truth) const {
        const Choice choice{&technique, {}};
        return judge_stage({frame, features, choice, model, result, Against::truth, &truth});
    }
    ReferenceImage& wanted() { return model.at("color"); }
    ReferenceImage& got() { return result.at("color"); }
};

TEST(Judge, FindsNothingBetweenEqualImages) {
    const Accuracy accuracy = Judged().against_model();
    EXPECT_EQ(accuracy.incomparable, "");
    EXPECT_EQ(accuracy.model_rmse, 0);
    EXPECT_EQ(accuracy.model_worst, 0);
    EXPECT_EQ(accuracy.compared, 12u);
    EXPECT_EQ(accuracy.undecided, 0u);
    EXPECT_EQ(accuracy.trivial, 0u);
}

/// 3 instead of 2 is wrong by a half; of four channels of twelve texels that is sqrt(1/4 / 48).
TEST(Judge, FindsADifferenceInAnyChannelAlone) {
    for (const glm::length_t channel : {0, 1, 2, 3}) {
        Judged judged;
        judged.got().at(1, 0)[channel] = 3;
        const Accuracy accuracy = judged.against_model();
        EXPECT_DOUBLE_EQ(accuracy.model_worst, .5) << "channel " << channel;
        EXPECT_DOUBLE_EQ(accuracy.model_rmse, std::sqrt(.25 / 48)) << "channel " << channel;
        EXPECT_EQ(accuracy.worst.got[channel], 3);
        EXPECT_EQ(accuracy.worst.wanted[channel], 2);
    }
}

TEST(Judge, FindsADifferenceInAnyTexelAndSaysWhereItIs) {
    for (std::uint32_t layer = 0; layer < 2; ++layer)
        for (std::uint32_t y = 0; y < 2; ++y)
            for (std::uint32_t x = 0; x < 3; ++x) {
                Judged judged;
                judged.got().at(x, y, layer).z = 1;
                const Accuracy accuracy = judged.against_model();
                EXPECT_DOUBLE_EQ(accuracy.model_rmse, std::sqrt(.25 / 48));
                EXPECT_EQ(accuracy.worst.image, "color");
                EXPECT_EQ(accuracy.worst.x, x);
                EXPECT_EQ(accuracy.worst.y, y);
                EXPECT_EQ(accuracy.worst.layer, layer);
            }
}

TEST(Judge, NamesTheWorstOfSeveralTexels) {
    Judged judged;
    judged.got().at(0, 0).x = 2.5;
    judged.got().at(1, 1, 1).y = 6;
    judged.got().at(2, 1, 1).z = 4;
    const Accuracy accuracy = judged.against_model();
    EXPECT_DOUBLE_EQ(accuracy.model_worst, 2);
    EXPECT_DOUBLE_EQ(accuracy.model_rmse, std::sqrt((.0625 + 4 + 1) / 48));
    EXPECT_EQ(accuracy.worst.x, 1u);
    EXPECT_EQ(accuracy.worst.layer, 1u);
}

/// Half the texels are 0: the root mean square is sqrt(2). A 0 that became 1 is wrong by 1 / sqrt(2), a 2 by 1/2.
TEST(Judge, MeasuresAgainstTheValueOrTheRootMeanSquareWhicheverIsLarger) {
    Judged judged;
    for (std::size_t i = 0; i < 6; ++i) judged.got().texels[i] = judged.wanted().texels[i] = glm::dvec4(0);
    judged.got().texels[0].x = 1;
    EXPECT_DOUBLE_EQ(judged.against_model().model_worst, std::sqrt(.5));
    judged.got().texels[0].x = 0;
    judged.got().texels[7].x = 1;
    EXPECT_DOUBLE_EQ(judged.against_model().model_worst, .5);
    EXPECT_EQ(judged.against_model().trivial, 6u);
}

TEST(Judge, CountsOneChannelOnlyWhereTheImageHasOne) {
    Judged judged;
    judged.got().channels = judged.wanted().channels = 1;
    judged.got().at(0, 0).y = 9;  // means nothing
    judged.got().at(1, 0).x = 3;
    EXPECT_DOUBLE_EQ(judged.against_model().model_rmse, std::sqrt(.25 / 12));
}

TEST(Judge, LeavesOutWhatTheModelCannotDecide) {
    Judged judged;
    judged.wanted().undecided.assign(12, false);
    judged.wanted().undecided[11] = true;
    judged.wanted().texels[11] = glm::dvec4(1e6);  // is not part of the root mean square
    judged.got().texels[0].x = 3;
    const Accuracy accuracy = judged.against_model();
    EXPECT_DOUBLE_EQ(accuracy.model_worst, .5);
    EXPECT_DOUBLE_EQ(accuracy.model_rmse, std::sqrt(.25 / 44));
    EXPECT_EQ(accuracy.compared, 11u);
    EXPECT_EQ(accuracy.undecided, 1u);
}

TEST(Judge, TakesNanOnOneSideForAnInfiniteErrorAndOnBothSidesForNone) {
    Judged judged;
    judged.got().at(2, 1, 1).w = not_a_number;
    EXPECT_EQ(judged.against_model().model_worst, infinity);
    EXPECT_EQ(judged.against_model().model_rmse, infinity);
    EXPECT_EQ(judged.against_model().worst.layer, 1u);
    judged.wanted().at(2, 1, 1).w = not_a_number;
    EXPECT_EQ(judged.against_model().model_worst, 0);
    judged.got().at(2, 1, 1).w = 2;
    EXPECT_EQ(judged.against_model().model_worst, infinity);
}

/// The texels beside it are judged as ever.
TEST(Judge, IsNotBlindedByATexelOfTheModelThatIsNotFinite) {
    for (const double odd : {not_a_number, infinity}) {
        Judged judged;
        judged.got().texels[5] = judged.wanted().texels[5] = glm::dvec4(odd);
        judged.got().texels[6] = judged.wanted().texels[6] = glm::dvec4(0);
        EXPECT_EQ(judged.against_model().model_worst, 0);
        judged.got().texels[0].y = 3;
        EXPECT_DOUBLE_EQ(judged.against_model().model_worst, .5);
    }
}

TEST(Judge, SumsUpOverAllImages) {
    Judged judged;
    judged.model["depth_layers"] = judged.result["depth_layers"] = ReferenceImage(3, 2, 1, glm::dvec4(1));
    judged.got().at(0, 0).x = 3;
    judged.result["depth_layers"].at(2, 0).x = 2;
    const Accuracy accuracy = judged.against_model();
    EXPECT_DOUBLE_EQ(accuracy.model_rmse, std::sqrt((.25 / 4 + 1. / 4) / 18));
    EXPECT_EQ(accuracy.worst.image, "depth_layers");
}

/// A result that was cut to the model's size, or an image that was passed over, would look perfect.
void expect_incomparable(const Judged& judged, const std::string& sentence) {
    const Accuracy accuracy = judged.against_model();
    EXPECT_THAT(accuracy.incomparable, HasSubstr(sentence));
    EXPECT_EQ(accuracy.model_rmse, infinity);
    EXPECT_EQ(accuracy.model_worst, infinity);
    EXPECT_EQ(accuracy.compared, 0u);
}

TEST(Judge, RefusesAResultOfAnotherShape) {
    const struct {
        ReferenceImage image;
        std::string sentence;
    } cases[] = {{ReferenceImage(4, 2, 2, glm::dvec4(2)), "color is 4 x 2 with 2 layers, the model's is 3 x 2 with 2 layers"},
                 {ReferenceImage(2, 2, 2, glm::dvec4(2)), "color is 2 x 2"},
                 {ReferenceImage(2, 3, 2, glm::dvec4(2)), "color is 2 x 3"},
                 {ReferenceImage(3, 2, 1, glm::dvec4(2)), "color is 3 x 2 with 1 layer,"},
                 {ReferenceImage(3, 2, 4, glm::dvec4(2)), "color is 3 x 2 with 4 layers"}};
    for (const auto& each : cases) {
        Judged judged;
        judged.got() = each.image;
        expect_incomparable(judged, each.sentence);
    }
    Judged judged;
    judged.got().channels = 3;
    expect_incomparable(judged, "color has 3 channels, the model's has 4");
}

TEST(Judge, RefusesAResultThatLacksAnImageOrHasOneThatTheModelDoesNotGive) {
    Judged judged;
    judged.result.clear();
    expect_incomparable(judged, "the model gives color, the result does not have it");
    judged.result = std::exchange(judged.model, {});
    expect_incomparable(judged, "the model gives no image of this frame");
    judged.model["light"] = judged.result["light"] = ReferenceImage(1, 1);
    expect_incomparable(judged, "the result has color, the model does not give it");
}

/// The stage draws over one of twelve samples of 2, where 3 is right and 3.3 is drawn: a tenth of what is right there, and far
/// less of the frame.
TEST(Judge, MeasuresWhatTheStageTouchesAlsoAlone) {
    Judged judged;
    ImageSet truth = judged.model;
    truth.at("color").at(1, 0) = glm::dvec4(3);
    judged.got().at(1, 0) = glm::dvec4(3.3);
    const Accuracy accuracy = judged.against_truth(truth);
    const auto relative = [](const std::vector<Metric>& metrics) {
        return std::ranges::find(metrics, "relative rmse", &Metric::name)->value;
    };
    EXPECT_DOUBLE_EQ(accuracy.touched_share, 1. / 12);
    EXPECT_NEAR(relative(accuracy.touched), .1, 1e-12);
    EXPECT_NEAR(relative(accuracy.technique_errors), std::sqrt(.09 / (11 * 4 + 9)), 1e-12);
    truth.at("color").at(2, 0) *= 1 + 0x1p-23;
    EXPECT_DOUBLE_EQ(judged.against_truth(truth).touched_share, 1. / 12) << "a rounded sample is not drawn over";
    EXPECT_TRUE(judged.against_truth(judged.model).touched.empty()) << "nothing is drawn over";
    EXPECT_EQ(judged.against_truth(judged.model).footing->pixels, 0u) << "no ground for an answer";
    EXPECT_EQ(accuracy.footing->pixels, 1u);
    EXPECT_NEAR(accuracy.footing->brightest_share, 1, 1e-12);
    EXPECT_EQ(accuracy.footing->x, 1u);
}

/// A sample of 2 beside one that the stage draws over dims what the pixel shows of it.
TEST(Judge, MeasuresWhatADisplayShowsOfThePixelsThatTheStageChanges) {
    Judged judged;
    judged.frame.view.exposure = .25f;
    ImageSet truth = judged.model;
    truth.at("color").at(1, 0) = glm::dvec4(3);
    judged.got().at(1, 0) = glm::dvec4(3.3);
    const auto display = [](const std::vector<Metric>& metrics) {
        return std::ranges::find(metrics, "display rmse", &Metric::name)->value;
    };
    const auto curve = [white = double(1.7f)](double x) { return x * (1 + x / (white * white)) / (1 + x); };
    const auto pixel = [&](double radiance) { return 1.055 * std::pow((curve(radiance / 4) + curve(.5)) / 2, 1 / 2.4) - .055; };
    const double off = pixel(3.3) - pixel(3);
    const Accuracy accuracy = judged.against_truth(truth);
    EXPECT_NEAR(display(accuracy.touched), off, 1e-12);
    EXPECT_NEAR(display(accuracy.technique_errors), off / std::sqrt(6.), 1e-12);
    judged.got().at(1, 0) = glm::dvec4(not_a_number);
    EXPECT_EQ(display(judged.against_truth(truth).touched), HUGE_VAL);
}

/// One of twelve samples of 2 is 3, or 1 as far as rounding decides.
TEST(Judge, TakesTheDistanceToAllThatRoundingAllows) {
    Judged judged;
    ImageSet truth = judged.model;
    ReferenceImage& color = truth.at("color");
    color.at(1, 0) = glm::dvec4(3);
    color.undecided.assign(color.texels.size(), false);
    color.undecided[color.index(1, 0, 0)] = true;
    color.alternatives = {{color.index(1, 0, 0), glm::dvec4(1)}};
    const auto worst = [](const Accuracy& accuracy) {
        return std::ranges::find(accuracy.technique_errors, "worst", &Metric::name)->value;
    };
    const Accuracy between = judged.against_truth(truth);
    EXPECT_EQ(worst(between), 0);
    EXPECT_DOUBLE_EQ(between.undecided_share, 1. / 12);
    EXPECT_EQ(between.unjudged_share, 0);
    ASSERT_TRUE(between.undecided_bound);
    EXPECT_EQ(between.undecided_bound->name, "relative rmse");
    EXPECT_DOUBLE_EQ(between.undecided_bound->value, 2 / std::sqrt(12.) / 2);
    judged.got().at(1, 0) = glm::dvec4(.25);
    EXPECT_DOUBLE_EQ(worst(judged.against_truth(truth)), .75);
    judged.got().at(1, 0) = glm::dvec4(7);
    EXPECT_DOUBLE_EQ(worst(judged.against_truth(truth)), 4);
    judged.got().at(1, 0) = glm::dvec4(not_a_number);
    EXPECT_EQ(worst(judged.against_truth(truth)), HUGE_VAL);
}

TEST(Judge, SaysHowManySamplesItLeavesOut) {
    Judged judged;
    ImageSet truth = judged.model;
    ReferenceImage& color = truth.at("color");
    color.at(1, 0) = color.at(2, 0) = glm::dvec4(3);
    color.undecided.assign(color.texels.size(), false);
    color.undecided[color.index(1, 0, 0)] = true;
    const Accuracy some = judged.against_truth(truth);
    EXPECT_DOUBLE_EQ(some.undecided_share, 1. / 12);
    EXPECT_DOUBLE_EQ(some.unjudged_share, 1. / 12) << "what else it may be is not known";
    EXPECT_DOUBLE_EQ(some.touched_share, 2. / 12) << "also what is left out is touched";
    color.undecided.assign(color.texels.size(), true);
    const Accuracy none = judged.against_truth(truth);
    EXPECT_TRUE(none.technique_errors.empty()) << "not an error of 0";
    EXPECT_EQ(none.not_supported, "no sample can be judged: rounding decides what each of them shows");
}

/// SwiftShader snaps corners to 1/16 pixel: near the sides of triangles it covers other samples than the model. On a device that
/// snaps to 1/256 pixel that is a bug.
TEST(Judge, TakesNanInResultAndTruthForNoAgreement) {
    Judged judged;
    ImageSet truth = judged.model;
    ReferenceImage& color = truth.at("color");
    color.at(1, 0).y = judged.got().at(1, 0).y = not_a_number;
    judged.got().at(2, 0).x = 4;  // wrong by 2 in one of three channels of eleven texels
    const Accuracy some = judged.against_truth(truth);
    EXPECT_EQ(some.not_numbers, 1u);
    ASSERT_FALSE(some.technique_errors.empty());
    EXPECT_DOUBLE_EQ(some.technique_errors.front().value, std::sqrt(4. / 33));
    color.texels.assign(12, glm::dvec4(not_a_number));
    judged.got() = color;
    const Accuracy all = judged.against_truth(truth);
    EXPECT_EQ(all.not_numbers, 12u);
    EXPECT_TRUE(all.technique_errors.empty());
    EXPECT_THAT(all.not_supported, HasSubstr("12 of them are NaN"));
}

TEST(Judge, ComparesNoSampleWhoseCoverageHangsOnTheStepsOfTheDevice) {
    Judged judged;
    judged.frame = frame_of_cards(std::array{Card{.center = {0, 0, 3}, .half = .91875f}}, 16);
    judged.model["color"] = judged.result["color"] = ReferenceImage(16, 16, 1, glm::dvec4(2));
    const std::vector<bool> near = samples_near_sides(judged.frame, 24);
    const auto count = static_cast<std::size_t>(std::ranges::count(near, true));
    ASSERT_GT(count, 0u);
    ASSERT_LT(count, near.size() / 4);
    for (std::size_t i = 0; i < near.size(); ++i)
        if (near[i]) judged.got().texels[i] = glm::dvec4(3);
    const auto at = [&](std::uint32_t steps, Against against) {
        const Choice choice{&judged.technique, {}};
        return judge_stage({.frame = judged.frame,
                            .features = judged.features,
                            .choice = choice,
                            .before = judged.model,
                            .result = judged.result,
                            .against = against,
                            .truth = &judged.model,
                            .snap_steps = steps});
    };
    EXPECT_EQ(at(256, Against::model).model_worst, .5);
    EXPECT_EQ(at(16, Against::model).model_worst, 0);
    EXPECT_EQ(at(16, Against::model).undecided, count);
    EXPECT_GT(at(256, Against::truth).technique_errors.front().value, 0);
    EXPECT_EQ(at(16, Against::truth).technique_errors.front().value, 0);
}

/// No model reads them.
TEST(Judge, DoesNotAskAModelForImagesThatOnlyTheirTechniqueCanRead) {
    Judged judged;
    judged.technique.stage = Stage::shadows;
    judged.model = judged.result = {{"visibility", ReferenceImage(1, 1, 1, glm::dvec4(1))}};
    judged.result["shadow_maps"] = ReferenceImage(1, 1);
    EXPECT_EQ(judged.against_model().incomparable, "");
}

TEST(Judge, RefusesATruthOfAnotherExtentAndCallsEveryFigureInfinite) {
    Judged judged;
    const ImageSet equal = judged.result;
    EXPECT_EQ(judged.against_truth(equal).incomparable, "");
    EXPECT_EQ(judged.against_truth(equal).technique_errors.front().value, 0);
    const ImageSet larger{{"color", ReferenceImage(6, 4, 2, glm::dvec4(2))}};
    const Accuracy accuracy = judged.against_truth(larger);
    EXPECT_EQ(accuracy.incomparable, "color is 3 x 2 with 2 layers, the truth's is 6 x 4 with 2 layers");
    ASSERT_EQ(accuracy.technique_errors.size(), judged.against_truth(equal).technique_errors.size());
    for (const Metric& metric : accuracy.technique_errors) EXPECT_EQ(metric.value, infinity) << metric.name;
    EXPECT_EQ(accuracy.flip, std::nullopt);

    judged.result.clear();
    EXPECT_EQ(judged.against_truth(equal).incomparable, "the truth has color, the result does not have it");
    EXPECT_EQ(judged.against_truth({}).incomparable, "the truth of transparency gives no image of this frame");
    EXPECT_EQ(judged.against_truth({}).technique_errors.front().value, infinity);
}

}  // namespace
}  // namespace strata
