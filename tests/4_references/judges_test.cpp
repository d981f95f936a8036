// The judges of the stages: a result against the truth, on images small enough to work their figures out by hand. Those of
// culling and shadows have tests beside their truths, too.
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "passes/combine/judge.h"
#include "passes/edges/judge.h"
#include "passes/gbuffer/judge.h"
#include "passes/indirect/judge.h"
#include "passes/lighting/judge.h"
#include "passes/reference/difference.h"
#include "passes/reference/display_light.h"
#include "passes/reference/place_code.h"
#include "passes/reference/shade.h"
#include "passes/reference/standard_error.h"
#include "passes/stage_input.h"
#include "passes/transparency/judge.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();

/// The light that sRGB encodes as a share of white above .04 (IEC 61966-2-1).
double srgb_light(double encoded) { return std::pow((encoded + .055) / 1.055, 2.4); }

using Metrics = std::map<std::string, double>;

Metrics by_name(const std::vector<Metric>& metrics) {
    Metrics named;
    for (const Metric& metric : metrics) named[metric.name] = metric.value;
    return named;
}

/// Two equal images of 2 x 1 with two layers, 3 in every channel.
struct Pair {
    ReferenceImage truth{2, 1, 2, glm::dvec4(3)}, got = truth;
};

}  // namespace

TEST(difference, is_of_every_color_channel_every_texel_and_every_layer) {
    for (int channel = 0; channel < 3; ++channel)
        for (std::size_t texel = 0; texel < 4; ++texel) {
            Pair pair;
            pair.got.texels[texel][channel] = 1;
            const Difference d = difference(pair.got, pair.truth);
            EXPECT_DOUBLE_EQ(d.rmse, std::sqrt(4. / 12));
            EXPECT_DOUBLE_EQ(d.relative, std::sqrt(4. / (12 * 9)));
            EXPECT_DOUBLE_EQ(d.worst, 2);
            EXPECT_DOUBLE_EQ(d.bias, -2. / 12);
        }
}

TEST(display_error, is_of_values_as_srgb_encodes_them) {
    ReferenceImage got(2, 1, 1, glm::dvec4(.5)), wanted = got;
    wanted.texels[1].y = .25;
    const DisplayError error = display_error(got, wanted);
    const double off = .7353569830524495 - .5370987304831942;  // IEC 61966-2-1 of .5 and .25
    EXPECT_NEAR(error.worst, off, 1e-15);
    EXPECT_NEAR(error.rmse, off / std::sqrt(6.), 1e-15);
    EXPECT_EQ(error.over_1_255, .5);
    EXPECT_EQ(error.over_5_255, .5);
    EXPECT_EQ(error.pixels, 2u);
    // Below .0031308 the curve is a line of slope 12.92: 2/255 apart is over 1 step and not over 5.
    got.texels[1] = glm::dvec4(0), wanted.texels[1] = glm::dvec4(2 / 255. / 12.92);
    EXPECT_NEAR(display_error(got, wanted).rmse, 2 / 255. / std::sqrt(2.), 1e-15);
    EXPECT_EQ(display_error(got, wanted).over_1_255, .5);
    EXPECT_EQ(display_error(got, wanted).over_5_255, 0);
}

TEST(display_error, is_of_what_a_pixel_shows) {
    ReferenceImage got(2, 1, 2), wanted = got;
    got.texels = {glm::dvec4(1), glm::dvec4(0), glm::dvec4(0), glm::dvec4(0)};
    wanted.texels = {glm::dvec4(0), glm::dvec4(0), glm::dvec4(1), glm::dvec4(0)};
    EXPECT_EQ(display_error(got, wanted).rmse, 0) << "its samples' mean";
    got.undecided = {true, false, false, true};
    EXPECT_DOUBLE_EQ(display_error(got, wanted).rmse, std::sqrt(.5)) << "of those that are decided";
    EXPECT_EQ(display_error(got, wanted, {false, true}).rmse, 0);
    EXPECT_EQ(display_error(got, wanted, {false, true}).pixels, 1u);
    EXPECT_DOUBLE_EQ(display_error(got, wanted, {true, false}).rmse, 1) << "of the pixels that change";
    got.undecided = {true, true, true, true};
    EXPECT_EQ(display_error(got, wanted).pixels, 0u);
    EXPECT_EQ(display_error(got, wanted).rmse, 0);
}

TEST(display_error, knows_what_clips_and_how_few_pixels_it_is_in) {
    // 3,000 pixels: 750 white, 750 black, 1,500 gray. Three, a thousandth, are off by 4/255 and 1,500 by 1/255.
    ReferenceImage wanted(100, 30, 1, glm::dvec4(srgb_light(.5)));
    for (std::size_t i = 0; i < 1500; ++i) wanted.texels[i] = glm::dvec4(i < 750 ? 2. : -1.);
    EXPECT_EQ(display_error(wanted, wanted).clipped_share, .5);
    EXPECT_EQ(display_error(wanted, wanted).concentration, 0);
    ReferenceImage got = wanted;
    for (std::size_t i = 1500; i < 3000; ++i) got.texels[i] = glm::dvec4(srgb_light(.5 + 1 / 255.));
    EXPECT_NEAR(display_error(got, wanted).concentration, 3 / 1500., 1e-12);
    for (std::size_t i = 1500; i < 1503; ++i) got.texels[i] = glm::dvec4(srgb_light(.5 - 40 / 255.));
    EXPECT_NEAR(display_error(got, wanted).concentration, 4800 / (4800. + 1497), 1e-12);
    wanted.texels[1500].x = 1;  // one color alone
    EXPECT_EQ(display_error(wanted, wanted).clipped_share, .5);
}

TEST(display_error, is_not_decided_by_one_bright_sample) {
    // A picture of .3 with one sample as bright as the sun, of which another picture has a tenth, and 2 % too dark elsewhere.
    ReferenceImage wanted(100, 100, 1, glm::dvec4(.3)), got(100, 100, 1, glm::dvec4(.294));
    wanted.texels[5050] = glm::dvec4(1e8), got.texels[5050] = glm::dvec4(1e7);
    EXPECT_NEAR(difference(got, wanted).relative, .9, 1e-6);
    const DisplayError error = display_error(tone_mapped(got, 1, 4), tone_mapped(wanted, 1, 4));
    const auto shown = [](double x) { return 1.055 * std::pow(x * (1 + x / 16) / (1 + x), 1 / 2.4) - .055; };
    EXPECT_NEAR(error.rmse, (shown(.3) - shown(.294)) * std::sqrt(.9999), 1e-12);
}

TEST(display_error, of_nan_on_one_side_is_infinite) {
    ReferenceImage got(2, 1, 1, glm::dvec4(.5)), wanted = got;
    got.texels[0].z = nan_value;
    EXPECT_EQ(display_error(tone_mapped(got, 1, 4), tone_mapped(wanted, 1, 4)).rmse, endless);
    got.texels[0].z = endless;
    EXPECT_EQ(tone_mapped(got, 1, 4).texels[0].z, 1) << "white";
    got.texels[0].z = -endless;
    EXPECT_EQ(tone_mapped(got, 1, 4).texels[0].z, 0) << "black";
}

TEST(display_error, of_alternatives_is_of_encoded_ones) {
    ReferenceImage truth(1, 1, 1, glm::dvec4(.5));
    truth.alternatives = {{0, glm::dvec4(.25)}};
    EXPECT_NEAR(srgb_encoded(truth).texels[0].x, .7353569830524495, 1e-15);
    EXPECT_NEAR(srgb_encoded(truth).alternatives[0].value.x, .5370987304831942, 1e-15);
}

TEST(standard_error, is_what_the_rmse_of_an_estimate_is_expected_to_be) {
    Pair pair;
    EXPECT_FALSE(standard_error(pair.truth)) << "exact";
    pair.truth.standard_error.resize(4);
    pair.truth.standard_error[2] = {3, 0, 4};
    EXPECT_DOUBLE_EQ(standard_error(pair.truth)->rmse, 5 / std::sqrt(12.));
    EXPECT_DOUBLE_EQ(standard_error(pair.truth)->relative, 5 / std::sqrt(12 * 9.));
    pair.truth.undecided = {false, false, true, false};
    EXPECT_EQ(standard_error(pair.truth)->rmse, 0);
}

TEST(difference, leaves_out_what_is_undecided_on_either_side) {
    Pair pair;
    pair.got.texels[0].x = pair.got.texels[3].x = 100;
    pair.got.undecided = {true, false, false, false};
    pair.truth.undecided = {false, false, false, true};
    EXPECT_EQ(difference(pair.got, pair.truth).worst, 0);
    EXPECT_EQ(difference(pair.got, pair.truth).compared, 2u);
}

TEST(difference, of_nan_on_one_side_is_infinite_and_on_both_sides_nothing) {
    for (std::size_t texel = 0; texel < 4; ++texel) {
        Pair pair;
        pair.got.texels[texel].z = nan_value;
        const Difference d = difference(pair.got, pair.truth);
        EXPECT_EQ(d.rmse, endless);
        EXPECT_EQ(d.relative, endless);
        EXPECT_EQ(d.worst, endless);
        pair.truth.texels[texel].z = nan_value;
        EXPECT_EQ(difference(pair.got, pair.truth).rmse, 0);
        EXPECT_EQ(difference(pair.got, pair.truth).worst, 0);
    }
}

TEST(lighting_judge, gives_the_rmse_in_radiance_relative_and_the_worst) {
    Pair pair;
    pair.got.at(1, 0, 1).y = 0;
    const Frame frame = tiny::frame(2, 1);
    const Metrics metrics = by_name(lighting_judge({{"light", pair.got}}, {{"light", pair.truth}}, {frame, {}}));
    EXPECT_DOUBLE_EQ(metrics.at("rmse"), std::sqrt(9. / 12));
    EXPECT_DOUBLE_EQ(metrics.at("relative rmse"), std::sqrt(1. / 12));
    EXPECT_DOUBLE_EQ(metrics.at("worst"), 3);
}

TEST(indirect_judge, tells_light_where_there_is_none_from_other_errors) {
    Pair pair;
    for (ReferenceImage* image : {&pair.got, &pair.truth}) image->at(1, 0, 1) = glm::dvec4(0);  // no surface
    pair.truth.at(0, 0) = pair.truth.at(0, 0, 1) = pair.got.at(0, 0) = {0, 0, 0, 1};
    pair.got.at(0, 0, 1) = {0.5, 1, 0, 1};
    pair.got.at(1, 0).y = 0;
    const Frame frame = tiny::frame(2, 1);
    const auto judged = [&] {
        return by_name(indirect_judge({{"indirect", pair.got}}, {{"indirect", pair.truth}}, {frame, {}}));
    };
    Metrics metrics = judged();
    EXPECT_DOUBLE_EQ(metrics.at("rmse"), std::sqrt((9 + 0.25 + 1) / 12));
    EXPECT_DOUBLE_EQ(metrics.at("relative rmse"), std::sqrt((9 + 0.25 + 1) / 12 / (9. / 4)));
    EXPECT_DOUBLE_EQ(metrics.at("worst"), 3);
    EXPECT_DOUBLE_EQ(metrics.at("leak"), 0.25 / 3);
    EXPECT_DOUBLE_EQ(metrics.at("dark"), 100 * 2. / 3);
    pair.got.at(0, 0, 1) = {0, 0, 0, 1};
    EXPECT_EQ(judged().at("leak"), 0);
    pair.got.at(0, 0, 1).x = nan_value;
    EXPECT_EQ(judged().at("leak"), endless);
    pair.truth.at(0, 0).x = 1;
    EXPECT_EQ(judged().at("leak"), 0) << "a black sample at an edge is no dark room";
    EXPECT_EQ(judged().at("dark"), 0);
}

TEST(combine_judge, judges_the_picture_first_and_radiance_where_the_truth_has_it) {
    Pair color;
    const ReferenceImage display(2, 1, 1, glm::dvec4(.5));
    ReferenceImage darker = display;
    darker.at(0, 0).x = .25;
    color.got.at(1, 0, 1).z = 6;
    const Frame frame = tiny::frame(2, 1);
    const ImageSet got{{"display", darker}, {"color", color.got}};
    const auto both = combine_judge(got, {{"display", display}, {"color", color.truth}}, {frame, {}});
    ASSERT_EQ(both.size(), 3u);
    const double off = .7353569830524495 - .5370987304831942;  // as sRGB encodes them
    EXPECT_NEAR(both[0].value, off / std::sqrt(6.), 1e-15);
    EXPECT_NEAR(both[1].value, off, 1e-15);
    EXPECT_DOUBLE_EQ(both[2].value, std::sqrt(1. / 12));
    EXPECT_EQ(combine_judge(got, {{"display", display}}, {frame, {}}).size(), 2u) << "color was drawn over";
}

TEST(edges_judge, tells_missed_edges_from_needless_ones) {
    ReferenceImage truth(4, 1), got(4, 1);
    truth.texels[0].x = truth.texels[1].x = 1;
    got.texels[1].x = got.texels[2].x = got.texels[3].x = 1;
    const Frame frame = tiny::frame(4, 1, 4);
    const Metrics metrics = by_name(edges_judge({{"edges", got}}, {{"edges", truth}}, {frame, {}}));
    EXPECT_EQ(metrics.at("missed"), 25);
    EXPECT_EQ(metrics.at("needless"), 50);
    EXPECT_EQ(metrics.at("shaded per sample"), 75);
}

TEST(edges_judge, counts_decided_pixels_only) {
    ReferenceImage truth(4, 1), got(4, 1);
    truth.texels[0].x = 1;  // missed, but rounding decides it
    got.texels[1].x = 1;    // needless, but rounding decides it
    truth.texels[2].x = got.texels[2].x = 1;
    truth.undecided = {true, false, false, false};
    got.undecided = {false, true, false, false};
    const Frame frame = tiny::frame(4, 1, 4);
    const Metrics metrics = by_name(edges_judge({{"edges", got}}, {{"edges", truth}}, {frame, {}}));
    EXPECT_EQ(metrics.at("missed"), 0);
    EXPECT_EQ(metrics.at("needless"), 0);
    EXPECT_EQ(metrics.at("shaded per sample"), 50) << "of two pixels that are decided";
}

namespace {

/// Four samples in a row, three of them of a surface at 5 m that faces the eye.
ImageSet decoded_surfaces() {
    ImageSet images{{"surface_normal", ReferenceImage(4, 1, 1, {0, 0, -1, 5})},
                    {"surface_color", ReferenceImage(4, 1, 1, {.5, .5, .5, .5})},
                    {"surface_material", ReferenceImage(4, 1, 1, {0, .5, .5, 0})}};
    images.at("surface_normal").texels[3] = glm::dvec4(0);
    return images;
}

Metrics gbuffer_metrics(const ImageSet& got, const ImageSet& truth) {
    const Frame frame = tiny::frame(4, 1);
    return by_name(gbuffer_judge(got, truth, {frame, {}}));
}

}  // namespace

TEST(gbuffer_judge, finds_nothing_in_equal_surfaces) {
    for (const auto& [name, value] : gbuffer_metrics(decoded_surfaces(), decoded_surfaces()))
        EXPECT_NEAR(value, 0, 1e-12) << name;
}

TEST(gbuffer_judge, gives_each_attribute_a_metric_of_its_own) {
    const ImageSet truth = decoded_surfaces();
    ImageSet got = truth;
    const double angle = std::numbers::pi / 6;
    got.at("surface_normal").texels[2] = {std::sin(angle), 0, -std::cos(angle), 6};
    got.at("surface_color").texels[0] = {.5, .8, .5, .2};
    got.at("surface_material").texels[1] = {3, .9, .4, 0};
    const Metrics metrics = gbuffer_metrics(got, truth);
    EXPECT_NEAR(metrics.at("normal angle rms"), 30 / std::sqrt(3), 1e-9);
    EXPECT_NEAR(metrics.at("normal angle worst"), 30, 1e-9);
    EXPECT_NEAR(metrics.at("normal angle mean"), 10, 1e-9);
    EXPECT_NEAR(metrics.at("position along"), .2 / std::sqrt(3), 1e-9);
    EXPECT_NEAR(metrics.at("position across"), 0, 1e-9);
    EXPECT_NEAR(metrics.at("base color rmse"), std::sqrt(.09 / 9), 1e-9);
    EXPECT_NEAR(metrics.at("roughness rmse"), .3 / std::sqrt(3), 1e-9);
    EXPECT_NEAR(metrics.at("metallic rmse"), .4 / std::sqrt(3), 1e-9);
    EXPECT_NEAR(metrics.at("occlusion rmse"), .1 / std::sqrt(3), 1e-9);
    EXPECT_NEAR(metrics.at("other lighting model"), 100. / 3, 1e-9);
    EXPECT_EQ(metrics.at("coverage differs"), 0);
}

/// A depth that is right at the wrong place of the pixel: a quarter of a pixel aside is an error across the ray, and no other.
TEST(gbuffer_judge, tells_positions_beside_the_ray_from_those_along_it) {
    const ImageSet truth = decoded_surfaces();
    ImageSet got = truth;
    got.at("surface_material").texels[1].w = place_code({.25, 0});
    const Frame frame = tiny::frame(4, 1);
    const glm::dvec3 right = pixel_ray(frame, 1.5, .5), wrong = pixel_ray(frame, 1.75, .5);
    const double sine = glm::length(glm::cross(right, wrong)) / glm::dot(right, right);
    const Metrics metrics = gbuffer_metrics(got, truth);
    EXPECT_NEAR(metrics.at("position across"), sine / std::sqrt(3), 1e-9);
    const double along = glm::dot(wrong - right, right) / glm::dot(right, right);
    EXPECT_NEAR(metrics.at("position along"), std::abs(along) / std::sqrt(3), 1e-9);
}

TEST(PlaceCode, KeepsStandardSamplesExactlyAndOthersTo8192thsOfAPixel) {
    for (std::uint32_t sample = 0; sample < 4; ++sample) {
        const glm::dvec2 offset = sample_position(4, sample) - .5;
        EXPECT_EQ(offset_of_place_code(double(float(place_code(offset)))), offset);
    }
    EXPECT_EQ(place_code({0, 0}), 0) << "the pixel's center is 0, which images without a place have";
    for (const glm::dvec2 offset : {glm::dvec2(.3, -.3), glm::dvec2(-.001, .001), glm::dvec2(.4996, -.4996)}) {
        const glm::dvec2 kept = offset_of_place_code(double(float(place_code(offset))));
        EXPECT_LE(glm::length(kept - offset), .75 / 4096) << offset.x;
    }
}

TEST(gbuffer_judge, counts_surfaces_that_are_missing_or_too_many_and_leaves_out_undecided_samples) {
    ImageSet truth = decoded_surfaces(), got = truth;
    got.at("surface_normal").texels[0] = glm::dvec4(0);
    got.at("surface_normal").texels[3] = {0, 0, -1, 5};
    EXPECT_EQ(gbuffer_metrics(got, truth).at("coverage differs"), 2);
    truth.at("surface_normal").undecided = {true, false, false, false};
    EXPECT_EQ(gbuffer_metrics(got, truth).at("coverage differs"), 1);
}

TEST(gbuffer_judge, takes_nan_for_an_infinite_error) {
    const ImageSet truth = decoded_surfaces();
    for (const int channel : {0, 1, 2}) {
        ImageSet got = truth;
        got.at("surface_normal").texels[1][channel] = nan_value;
        EXPECT_EQ(gbuffer_metrics(got, truth).at("normal angle rms"), endless) << channel;
        EXPECT_EQ(gbuffer_metrics(got, truth).at("normal angle worst"), endless) << channel;
    }
    ImageSet got = truth;
    got.at("surface_color").texels[1].y = nan_value;
    EXPECT_EQ(gbuffer_metrics(got, truth).at("base color rmse"), endless);
    got.at("surface_normal").texels[1].w = nan_value;
    EXPECT_EQ(gbuffer_metrics(got, truth).at("coverage differs"), 1) << "a depth that is NaN is no surface";
}

/// Light where a quarter is .004 for .003, seen at an exposure of 1, and the same in units of a millionth.
TEST(transparency_judge, gives_the_same_relative_errors_in_every_unit_of_light) {
    for (const double unit : {1., 0x1p20, 0x1p-20}) {
        ReferenceImage truth(4, 1, 1, glm::dvec4(.003 * unit)), got = truth;
        got.texels[2] = glm::dvec4(.004 * unit);
        Frame frame = tiny::frame(4, 1);
        frame.view.exposure = float(1 / unit);
        const Metrics metrics = by_name(transparency_judge({{"color", got}}, {{"color", truth}}, {frame, {}}));
        EXPECT_NEAR(metrics.at("P99"), .001 / .013, 1e-12) << unit;
        EXPECT_EQ(metrics.at("over 2 %"), 25) << unit;
        EXPECT_EQ(metrics.at("over 10 %"), 0) << unit;
    }
}

/// NaN is displayed as black: a black pixel of the truth must not excuse it.
TEST(transparency_judge, takes_nan_for_wrong_wherever_it_is) {
    ReferenceImage truth(4, 1), got(4, 1);
    got.texels[3].y = nan_value;
    const Frame frame = tiny::frame(4, 1);
    const Metrics metrics = by_name(transparency_judge({{"color", got}}, {{"color", truth}}, {frame, {}}));
    EXPECT_EQ(metrics.at("rmse"), endless);
    EXPECT_EQ(metrics.at("worst"), endless);
    EXPECT_EQ(metrics.at("P99"), endless);
    EXPECT_EQ(metrics.at("over 10 %"), 25);
    EXPECT_EQ(metrics.at("off by 1/255"), 25);
}

TEST(transparency_judge, sees_every_channel_and_the_last_texel_of_the_last_layer) {
    for (int channel = 0; channel < 3; ++channel) {
        Pair pair;
        pair.got.at(1, 0, 1)[channel] = 6;
        Frame frame = tiny::frame(2, 1);
        frame.film.white = 8;  // both are below it
        const Metrics metrics = by_name(transparency_judge({{"color", pair.got}}, {{"color", pair.truth}}, {frame, {}}));
        EXPECT_DOUBLE_EQ(metrics.at("rmse"), std::sqrt(9. / 12));
        EXPECT_DOUBLE_EQ(metrics.at("worst"), 3);
        EXPECT_DOUBLE_EQ(metrics.at("bias"), 3. / 12);
        EXPECT_DOUBLE_EQ(metrics.at("P99"), 3 / 3.01);
        EXPECT_EQ(metrics.at("over 10 %"), 25);
        EXPECT_EQ(metrics.at("off by 1/255"), 25);
    }
}

}  // namespace strata
