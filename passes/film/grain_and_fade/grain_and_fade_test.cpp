// Facts of grain and fading (docs/algorithms/deferred.md 8.9, T-PP-6): what noise must be, derived without its bits.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/film/grain_model.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::film {

Technique grain_and_fade();
ImageSet grain_and_fade_model(const StageInput&, const Settings&);

namespace {

Frame grainy(float grain, float fade = 0) {
    Frame frame = one_pixel(1);
    frame.film.grain = grain;
    frame.film.fade = fade;
    return frame;
}

/// A gray tile of 64 x 64 pixels after the film.
ReferenceImage aged_tile(const Frame& frame, std::string_view form) {
    static const Technique technique = grain_and_fade();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("grain", form));
    return grain_and_fade_model({frame, {{"display", ReferenceImage(64, 64, 1, glm::dvec4(.4, .4, .4, 1))}}}, settings)
        .at("display");
}

double mean(const ReferenceImage& image) {
    double sum = 0;
    for (const glm::dvec4& texel : image.texels) sum += texel.x;
    return sum / double(image.texels.size());
}

TEST(Grain, HasEveryValueOnceInATile) {
    for (const double time : {0., 1. / 24, 7200.}) {
        Frame frame = grainy(1);
        frame.time = time;
        std::set<std::uint32_t> ranks;
        for (std::uint32_t y = 64; y < 128; ++y)
            for (std::uint32_t x = 0; x < 64; ++x) ranks.insert(grain_rank(frame, x, y, 24));
        EXPECT_EQ(ranks.size(), 4096u);
        EXPECT_EQ(*ranks.rbegin(), 4095u);
    }
}

TEST(Grain, LeavesTheMeanOfATileAsItIs) {
    EXPECT_NEAR(mean(aged_tile(grainy(.5f), "centered")), .4, 1e-12);
    EXPECT_NEAR(mean(aged_tile(grainy(.5f), "xray")) / .4, 1 + .5 * (2 * 128 / 255. - 1), 1e-4) << "1.0039 by bytes around 128";
    EXPECT_EQ(mean(aged_tile(grainy(.5f), "off")), mean(aged_tile(grainy(0), "centered")));
}

TEST(Grain, NeighborsKnowNothingOfEachOther) {
    const Frame frame = grainy(1);
    for (const glm::uvec2 step : {glm::uvec2(1, 0), glm::uvec2(0, 1), glm::uvec2(1, 1), glm::uvec2(2, 0), glm::uvec2(0, 8)}) {
        double sum = 0;
        for (std::uint32_t y = 0; y < 256; ++y)
            for (std::uint32_t x = 0; x < 256; ++x)
                sum += (grain_rank(frame, x, y, 24) / 4095. - .5) * (grain_rank(frame, x + step.x, y + step.y, 24) / 4095. - .5);
        EXPECT_LT(std::abs(sum / (65536. / 12)), .03) << step.x << " " << step.y << ": 4 standard deviations are .016";
    }
}

TEST(Grain, IsRedrawnAtItsRateWhateverTheFrameRate) {
    Frame frame = grainy(1);
    const auto at = [&](double time) {
        frame.time = time;
        return grain_rank(frame, 5, 6, 24) * 4096 + grain_rank(frame, 50, 60, 24);
    };
    EXPECT_EQ(at(0), at(.041));
    EXPECT_NE(at(0), at(.042));
    EXPECT_EQ(at(86400.001), at(86400.04)) << "after a day, too";
    EXPECT_NE(at(86400.001), at(86400.043));
    frame.seed = 9;
    const auto other = at(0);
    frame.seed = 0;
    EXPECT_NE(at(0), other);
}

TEST(Grain, FadesLast) {
    EXPECT_NEAR(mean(aged_tile(grainy(0, .25f), "centered")), .3, 1e-12);
    EXPECT_EQ(mean(aged_tile(grainy(.5f, 2), "centered")), 0) << "more than black is black";
    const ReferenceImage strong = aged_tile(grainy(3), "centered");
    for (const glm::dvec4& texel : strong.texels) EXPECT_GE(texel.x, 0);
}

}  // namespace
}  // namespace strata::film
