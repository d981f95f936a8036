// Materials that distort what is behind them (docs/algorithms/transparency.md 6.13): every technique sees the background sum d
// T(z) away.
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/transparency/truth.h"
#include "replay/images/image_io.h"
#include "tests/support/every_nth.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::uint32_t extent = 16;
const double slant = .25;  // x of the glass's normal

/// Stripes to see through what is put before them: column x has radiance x / 16.
Frame stripes_behind(std::vector<Card> cards, std::uint32_t samples = 1) {
    for (std::uint32_t x = 0; x < extent; ++x)
        cards.push_back({.center = {(2 * (x + .5) / extent - 1) * 20, 0, 20},
                         .half = 20.f / extent,
                         .color = {glm::vec3(float(x) / extent), 1},
                         .alpha_mode = AlphaMode::opaque});
    Frame frame = frame_of_cards(cards, extent);
    frame.view.samples = samples;
    for (Draw& draw : frame.draws)
        if (frame.materials[draw.material].alpha_mode == AlphaMode::opaque) draw.to_world[1] *= extent;
    return frame;
}

/// Glass that shows what is `columns` further right, before or behind other cards.
Card bending_glass(double z, double columns) {
    return {.center = {0, 0, z},
            .half = 40,
            .color = {0, 0, 0, 0},
            .tilt = -std::asin(slant),
            .distortion = float(columns / extent / slant)};
}

/// Radiance along the middle row.
std::vector<double> row_of(Session& session, std::size_t frame, std::string_view technique) {
    const HostImage color =
        must(session.run({.variant = {.frame = frame}, .choices = chosen({std::string(technique)}), .outputs = {"color"}}))
            .images.at("color");
    const ReferenceImage image = in_double(color);
    std::vector<double> row;
    for (std::uint32_t x = 0; x < extent; ++x) row.push_back(image.at(x, extent / 2).x);
    return row;
}

class Distortion : public testing::TestWithParam<std::string_view> {
protected:
    static Session& session() {
        static const auto open = must(
            Session::open({stripes_behind({bending_glass(10, 2)}),
                           stripes_behind({bending_glass(10, 4), {.center = {0, 0, 5}, .color = {0, 0, 0, .5f}}}),
                           stripes_behind({bending_glass(5, 4), {.center = {0, 0, 10}, .half = 20, .color = {0, 0, 0, .5f}}})},
                          {.validation = true}));
        return *open;
    }
    double largest_error(std::size_t frame, double columns, double through) {
        const std::vector<double> row = row_of(session(), frame, GetParam());
        double largest = 0;
        for (std::uint32_t x = 0; x + 4 < extent; ++x)
            largest = std::max(largest, std::abs(row[x] - through * (x + columns) / extent));
        return largest;
    }
};

TEST_P(Distortion, ShowsWhatIsFurtherRight) { EXPECT_LT(largest_error(0, 2, 1), 2e-3); }
/// Undimmed it would be .125 off; T(z) of a wavelet is 1.7e-2 from .5 there.
TEST_P(Distortion, IsDimmedByWhatIsInFront) { EXPECT_LT(largest_error(1, 2, .5), 2.5e-2); }
TEST_P(Distortion, IsNotDimmedByWhatIsBehind) { EXPECT_LT(largest_error(2, 4, .5), 5e-3); }

TEST_P(Distortion, CostsNothingWhereNothingDistorts) {
    const auto steps = [&](const std::vector<Card>& cards) {
        const auto fresh = session_of({stripes_behind(cards)});
        return must(fresh->run({.choices = chosen({std::string(GetParam())})})).steps.size();
    };
    Card plain = bending_glass(10, 0), bending = bending_glass(10, 2);
    plain.color.w = bending.color.w = .5f;
    EXPECT_GT(steps({bending}), steps({plain}));
}

std::vector<std::string_view> names_of_techniques() {
    std::vector<std::string_view> names;
    for (const Technique& technique : techniques())
        if (technique.stage == Stage::transparency) names.push_back(technique.name);
    return names;
}

std::string bending_technique_name(const testing::TestParamInfo<std::string_view>& info) {
    return std::string(info.param.substr(info.param.find('/') + 1));
}

INSTANTIATE_TEST_SUITE_P(Some, Distortion, testing::ValuesIn(every_nth(3, names_of_techniques())), bending_technique_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, Distortion, testing::ValuesIn(names_of_techniques()), bending_technique_name);

/// Offsets are summed with the T(z) of their fragments: .02 behind t = .5 and .04 before it.
TEST(DistortionTruth, SumsOffsetsByTransmittance) {
    const Fragment near{.depth = 1, .distortion = {.04, 0}}, half{.depth = 2, .transmittance = glm::dvec3(.5), .alpha = .5},
        far{.depth = 3, .distortion = {.02, -.01}};
    const glm::dvec2 offset = exact_distortion(std::array{far, half, near});
    EXPECT_NEAR(offset.x, .05, 1e-15);
    EXPECT_NEAR(offset.y, -.005, 1e-15);
}

}  // namespace
}  // namespace strata
