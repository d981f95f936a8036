// Two pictures against each other: what the panel says is what the session's own images say.
#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/registry.h"
#include "replay/images/image_io.h"
#include "tests/7_inspector/desk.h"
#include "tests/7_tool/process.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"
#include "ui/compare/compare_numbers.h"
#include "ui/compare/compare_side.h"
#include "ui/compare/flip_colors.h"
#include "ui/picture/picture_view.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

SidePicture picture(std::uint32_t width, const std::vector<float>& values) {
    HostImage image{{.extent = {width, static_cast<std::uint32_t>(values.size()) / width, 1}, .format = Format::r32f}, {}};
    const auto bytes = std::as_bytes(std::span(values));
    image.texels.assign(bytes.begin(), bytes.end());
    return {.image = std::make_shared<HostImage>(std::move(image))};
}

ComparedPictures occlusion_compared(const std::vector<float>& a, const std::vector<float>& b) {
    return must(compare({"occlusion", picture(2, a), picture(2, b)}));
}

TEST(ComparedPictures, TheNumbersAreThoseOfAHandCalculation) {
    const ComparedPictures made = occlusion_compared({1, 2, 3, 4}, {1, 2, 3, 2});
    EXPECT_EQ(rmse_text(made), "RMSE 1, 36.5 % of A");  // sqrt(4 / 4), sqrt(4 / 30)
    EXPECT_EQ(worst_text(made), "worst 2 at 1 1");
    EXPECT_EQ(differing_text(made), "1 of 4 texels differ");
    EXPECT_EQ(texel(*made.difference, 1, 1).x, -2);
    EXPECT_FLOAT_EQ(static_cast<float>(texel(*made.relative, 1, 1).x), .5f);  // 2 / max(4, sqrt(7.5))
    EXPECT_EQ(made.flip, nullptr);
}

TEST(ComparedPictures, WhatIsNoNumberIsCountedAndStaysSoInTheMaps) {
    const ComparedPictures made = occlusion_compared({1, nan, nan, 4}, {1, nan, 3, HUGE_VALF});
    EXPECT_THAT(oddities_text(made), HasSubstr("NaN: 2 in A, 1 in B"));
    EXPECT_THAT(oddities_text(made), HasSubstr("infinite: 0 in A, 1 in B"));
    EXPECT_THAT(oddities_text(made), HasSubstr("2 values in one alone"));
    EXPECT_TRUE(std::isnan(texel(*made.difference, 0, 1).x));
    EXPECT_TRUE(std::isnan(texel(*made.relative, 0, 1).x));
    EXPECT_TRUE(std::isinf(texel(*made.relative, 1, 1).x));
    EXPECT_EQ(made.measured.error.rmse, 0) << "over what is finite in both";
}

TEST(ComparedPictures, ATexelThatATruthCannotDecideCountsAsEqual) {
    ReferenceImage truth(2, 1);
    truth.channels = 4;
    truth.at(0, 0) = {1, 0, 0, 0};
    truth.at(1, 0) = {9, 0, 0, 0};
    truth.undecided = {false, true};
    const ComparedPictures made = must(compare({"occlusion", picture_of(truth), picture(2, {3, 4})}));
    EXPECT_EQ(made.undecided, 1u);
    EXPECT_EQ(differing_text(made), "1 of 2 texels differ");
    EXPECT_EQ(made.measured.error.worst, 2);
}

TEST(ComparedPictures, OfOtherSizesASentenceHasBoth) {
    EXPECT_THAT(compare({"occlusion", picture(2, {1, 2, 3, 4}), picture(3, {1, 2, 3})}),
                FailsWith("image.shapes_differ", Field("a", "2 x 2, r32f"), Field("b", "3 x 1, r32f")));
}

TEST(ComparedPictures, AScaleEndsAtARoundNumber) {
    EXPECT_DOUBLE_EQ(round_up(.013), .02);
    EXPECT_DOUBLE_EQ(round_up(5), 5);
    EXPECT_DOUBLE_EQ(round_up(51), 100);
    EXPECT_DOUBLE_EQ(round_up(0), 1);
}

/// The panel in front, the recorded frame against this replay.
Desk& comparing() {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Compare"));
    must(desk.player->choose("Compare/A/source", "as recorded"));
    must(desk.player->choose("Compare/B/source", "this replay"));
    must(desk.player->click("Compare/Wipe"));
    must(desk.player->wait());
    return desk;
}

template <typename T>
T asked(Desk& desk, std::function<Result<T>(Session&)> question) {
    const auto job = desk.inspector->replayer().start<T>([question](Session& session, Progress&) { return question(session); });
    must(desk.player->wait());
    return must(*job->result());
}

HostImage display(Desk& desk, Request request) {
    request.outputs = {"display"};
    return asked<HostImage>(desk, [request](Session& session) -> Result<HostImage> {
        auto run = session.run(request);
        if (!run) return run.error();
        return run->images.at("display");
    });
}

void change_technique(Desk& desk) {
    desk.model().use(*must(find_technique("transparency/weighted")));
    must(desk.player->wait());
}

TEST(Compare, ARecordedFrameIsTheSameUntilATechniqueIsChanged) {
    Desk& desk = comparing();
    EXPECT_EQ(desk.said("Compare/state"), "bit for bit the same");
    change_technique(desk);
    const HostImage a = display(desk, {}), b = display(desk, desk.model().request());
    const ImageComparison wanted = must(compare_images("display", a, b, {}));
    EXPECT_GT(wanted.error.over_limit, 0u);
    EXPECT_EQ(desk.said("Compare/flip mean"), fmt::format("FLIP {:.4g}", wanted.flip->mean));
    EXPECT_THAT(desk.said("Compare/rmse"), HasSubstr(fmt::format("RMSE {:.4g},", wanted.error.rmse)));
    desk.expect_no_conflicts();
    must(desk.player->click("Compare/worst"));
    const WorstPixel& worst = wanted.error.worst_pixel;
    EXPECT_EQ(desk.model().pin, glm::ivec2(worst.x, worst.y));
    EXPECT_THAT(desk.said("Compare/values"), HasSubstr(fmt::format("{} {} ", worst.x, worst.y)));
}

TEST(Compare, EveryWayToLookDrawsAndItsLegendHasNumbers) {
    Desk& desk = comparing();
    change_technique(desk);
    for (const char* mode : {"Wipe", "Side by side", "Flip", "Difference", "Relative", "FLIP"}) {
        SCOPED_TRACE(mode);
        must(desk.player->click(fmt::format("Compare/{}", mode)));
        must(desk.player->wait());
        EXPECT_THAT(desk.said("Compare/legend"), HasSubstr(" to "));
        desk.expect_no_conflicts();
    }
}

TEST(Compare, TheMapOfFlipShowsClosePicturesByAGainThatItsLegendSays) {
    Desk& desk = comparing();
    change_technique(desk);
    must(desk.player->click("Compare/FLIP"));
    must(desk.player->click("Compare/auto"));
    must(desk.player->wait());
    const std::string mean = desk.said("Compare/flip mean");
    const double end = std::stod(desk.said("Compare/high"));
    EXPECT_LT(end, 1) << "the pictures are close";
    EXPECT_EQ(desk.said("Compare/legend"), fmt::format("0 to {:.3g}", end));
    EXPECT_THAT(desk.said("Compare/caption"), HasSubstr(fmt::format("FLIP times {:.4g},", 1 / end)));
    must(desk.player->type("Compare/flip gain", "1"));
    must(desk.player->wait());
    EXPECT_EQ(desk.said("Compare/legend"), "0 to 1");
    EXPECT_EQ(desk.said("Compare/flip mean"), mean);
    EXPECT_THAT(desk.said("Compare/caption"), testing::StartsWith("FLIP, 0"));
    must(desk.player->click("Compare/auto"));
}

TEST(FlipColors, AreBlackAtZeroAndBrightestAtTheEndOfTheScale) {
    const Texels colors = flip_colors(*picture(3, {0, .05f, .5f}).image, .05);
    const std::vector<float> brightest(colors.rgba.begin() + 4, colors.rgba.begin() + 8);
    EXPECT_LT(colors.rgba[0] + colors.rgba[1] + colors.rgba[2], .05f);
    EXPECT_GT(brightest[0] + brightest[1] + brightest[2], 2);
    EXPECT_TRUE(std::equal(brightest.begin(), brightest.end(), colors.rgba.begin() + 8)) << "what lies above is not told apart";
}

TEST(Compare, TheDividerHasAOnItsLeftAndBOnItsRight) {
    Desk& desk = comparing();
    change_technique(desk);
    const HostImage a = display(desk, {}), b = display(desk, desk.model().request());
    const auto [width, height, depth] = a.shape.extent;
    desk.model().view = {4, width / 2.0, height / 2.0};
    must(desk.player->wait());
    const WidgetRecord canvas = desk.widget("Compare/picture");
    const Placement placement = place(desk.model().view, canvas.from, {canvas.to.x - canvas.from.x, canvas.to.y - canvas.from.y},
                                      Texels{width, height, {}});
    const Picture window = must(desk.player->picture());
    std::size_t unlike = 0;
    for (const std::uint32_t x : {width / 2 - 9, width / 2 + 9})
        for (std::uint32_t y = height / 2 - 12; y < height / 2 + 12; ++y) {
            const ImVec2 at = placement.on_screen(x + .5, y + .5);
            const std::size_t first = 3 * (static_cast<std::size_t>(at.y) * window.width + static_cast<std::size_t>(at.x));
            const glm::dvec4 wanted = texel(x < width / 2 ? a : b, x, y), other = texel(x < width / 2 ? b : a, x, y);
            for (glm::length_t c = 0; c < 3; ++c)
                ASSERT_EQ(window.rgb[first + static_cast<std::size_t>(c)], display_byte(wanted[c])) << x << ' ' << y;
            unlike += display_byte(wanted.x) != display_byte(other.x);
        }
    EXPECT_GT(unlike, 0u) << "a comparison of equal columns says nothing";
}

TEST(Compare, TheDividerCanBePulled) {
    Desk& desk = comparing();
    const WidgetRecord canvas = desk.widget("Compare/picture");
    must(desk.player->move("Compare/picture", .5f, .3f));
    must(desk.player->pull((canvas.to.x - canvas.from.x) / 4, 0));
    EXPECT_EQ(desk.said("Compare/picture"), "A 75 %, then B");
    EXPECT_EQ(desk.model().view, PictureView()) << "the pictures stay where they are";
    must(desk.player->pull((canvas.from.x - canvas.to.x) / 4, 0));
    EXPECT_EQ(desk.said("Compare/picture"), "A 50 %, then B");
}

TEST(Compare, SpaceFlipsBetweenAAndB) {
    Desk& desk = comparing();
    must(desk.player->key("a"));
    EXPECT_EQ(desk.said("Compare/picture"), "A  as recorded");
    must(desk.player->key("space"));
    EXPECT_EQ(desk.said("Compare/picture"), "B  this replay");
    must(desk.player->key("space"));
    EXPECT_EQ(desk.said("Compare/picture"), "A  as recorded");
}

TEST(Compare, APngOfTheReplayIsTheSameAndABrokenPathIsASentence) {
    Desk& desk = comparing();
    must(write_png(folder() / "a.png", display(desk, {})));
    must(desk.player->choose("Compare/A/source", "image file"));
    must(desk.player->type("Compare/A/file", (folder() / "a.png").string()));
    must(desk.player->wait());
    EXPECT_EQ(desk.said("Compare/state"), "bit for bit the same");
    must(desk.player->type("Compare/A/file", (folder() / "b.png").string()));
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Compare/state"), HasSubstr("A: cannot read "));
}

TEST(Compare, AVariantIsThatTechniqueWithItsSettings) {
    Desk& desk = comparing();
    must(desk.player->choose("Compare/A/source", "other technique"));
    must(desk.player->choose("Compare/A/stage", "transparency"));
    must(desk.player->choose("Compare/A/technique", "weighted"));
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Compare/differing"), testing::Not(testing::StartsWith("0 of")));
    change_technique(desk);
    EXPECT_EQ(desk.said("Compare/state"), "bit for bit the same");
}

TEST(Compare, ATruthIsHeldAgainstWhatItsStageLeft) {
    Desk& desk = comparing();
    desk.model().image = {.name = "color"};
    must(desk.player->choose("Compare/A/source", "truth"));
    must(desk.player->wait());
    ASSERT_EQ(desk.said("Compare/after"), "transparency");
    const auto wanted = asked<double>(desk, [](Session& session) -> Result<double> {
        const ReferenceImage truth = must(session.truth({}, Stage::transparency)).at("color");
        ReferenceImage got;
        for (const PassImages& pass : must(session.pass_images({})))
            if (pass.stage == Stage::transparency) got = in_double(pass.images.at("color"));
        double sum = 0;
        for (std::size_t i = 0; i < truth.texels.size(); ++i) {
            const glm::dvec4 apart = truth.texels[i] - got.texels.at(i);
            if (truth.undecided.empty() || !truth.undecided[i]) sum += glm::dot(apart, apart);
        }
        return std::sqrt(sum / (4 * static_cast<double>(truth.texels.size())));
    });
    EXPECT_GT(wanted, 0);
    EXPECT_NEAR(std::stod(desk.said("Compare/rmse").substr(5)), wanted, 1e-3 * wanted + 1e-7);
}

/// The truth's other channels are 0: it was red, over a gray scale.
TEST(Compare, ATruthOfOneNumberIsGray) {
    Desk& desk = comparing();
    desk.model().select_frame(frame_of("corners"));
    desk.model().image = {.name = "occlusion"};
    must(desk.player->choose("Compare/A/source", "truth"));
    must(desk.player->wait());
    const WidgetRecord canvas = desk.widget("Compare/picture");
    const Picture window = must(desk.player->picture());
    std::size_t lit = 0;
    for (float x = canvas.from.x + 60; x < canvas.from.x + (canvas.to.x - canvas.from.x) * .4f; x += 7) {
        const auto y = static_cast<std::size_t>((canvas.from.y + canvas.to.y) / 2);
        const std::size_t at = 3 * (y * window.width + static_cast<std::size_t>(x));
        lit += window.rgb[at] > std::byte{40};
        ASSERT_LT(std::abs(int(window.rgb[at]) - int(window.rgb[at + 1])), 12) << x;
    }
    EXPECT_GT(lit, 3u);
}

TEST(Compare, ASideThatHasNothingSaysWhy) {
    Desk& desk = comparing();
    must(desk.player->choose("Compare/A/source", "expectation"));
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Compare/state"), HasSubstr("no expected results"));
    must(desk.player->choose("Compare/A/source", "truth"));
    desk.model().image = {.name = "edges"};
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Compare/state"), HasSubstr("A: "));
}

TEST(Expectation, APictureThatIsKeptIsWhatTheRecordedChoicesGave) {
    ASSERT_EQ(strata("record three_panes -o panes.strata --size 96x54").code, 0);
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    const Subject subject{"display", std::nullopt};
    {
        const auto session = must(Session::open(folder() / "panes.strata", {}));
        EXPECT_THAT(expected_picture(*session, {}, subject), FailsWith("expectation.hash_only", Field("image", "display")));
    }
    ASSERT_EQ(strata("accept panes.strata --with-images").code, 0);
    const auto session = must(Session::open(folder() / "panes.strata", {}));
    const SidePicture expected = must(expected_picture(*session, {}, subject));
    const HostImage display = must(session->run({})).images.at("display");
    EXPECT_EQ(hash_of(*expected.image), hash_of(display));
    EXPECT_EQ(expected.image->shape, display.shape);
}

}  // namespace
}  // namespace strata::ui
