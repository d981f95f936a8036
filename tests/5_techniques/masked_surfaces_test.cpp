// Which samples masked surfaces cover on the device, mode by mode: what docs/algorithms/deferred.md 4 says (T-AT-1 to 4), and
// what the models say of a fence and of foliage.
#include <bit>
#include <cstring>
#include <span>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "captures/cards.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/bands.h"
#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/registry.h"
#include "tests/support/agreement.h"
#include "tests/support/chessboard.h"
#include "tests/support/mean_coverages.h"
#include "tests/support/print.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using namespace gbuffer;

/// The modes by name, as --set takes them.
std::span<const std::string_view> modes() {
    for (const Param& param : (*find_technique("gbuffer/octahedral"))->params)
        if (param.name == "masked") return param.choices;
    return {};
}

Request with(std::uint32_t mode, const std::vector<std::string>& more = {}) {
    std::vector<std::string> sets{fmt::format("masked={}", modes()[mode])};
    sets.insert(sets.end(), more.begin(), more.end());
    return {.choices = chosen({"gbuffer/octahedral"}, sets), .outputs = {"depth_layers"}};
}

/// Bit i of a pixel: sample i has a surface.
struct Masks {
    std::uint32_t width = 0;
    std::vector<std::uint32_t> of;

    std::uint32_t at(std::uint32_t x, std::uint32_t y) const { return of[std::size_t(y) * width + x]; }
    /// The share of all samples of a rectangle of pixels.
    double coverage(glm::uvec2 begin, glm::uvec2 extent, std::uint32_t samples = 4) const {
        double covered = 0;
        for (std::uint32_t y = 0; y < extent.y; ++y)
            for (std::uint32_t x = 0; x < extent.x; ++x) covered += std::popcount(at(begin.x + x, begin.y + y));
        return covered / (samples * extent.x * extent.y);
    }
};

Masks masks_of(Session& session, const Request& request) {
    const ReferenceImage depth = in_double(must(session.run(request)).images.at("depth_layers"));
    Masks masks{.width = depth.width, .of = std::vector<std::uint32_t>(std::size_t(depth.width) * depth.height)};
    for (std::size_t i = 0; i < depth.texels.size(); ++i)
        if (depth.texels[i].x > 0) masks.of[i % masks.of.size()] |= 1u << i / masks.of.size();
    return masks;
}

constexpr std::uint32_t edge = 32, tile = 4;  // pixels of an image, and of a card in it

/// A card over a tile of 4 x 4 pixels, which its sides follow exactly.
Card card_over(std::uint32_t number, float alpha, double depth = 1) {
    const double pixel = 2.0 / edge, across = number % (edge / tile), down = number / (edge / tile);
    const glm::dvec3 center((across * tile + 2) * pixel - 1, 1 - (down * tile + 2) * pixel, 1);
    return {.center = center * depth, .half = float(2 * pixel * depth), .color = {1, 1, 1, alpha}, .alpha_mode = AlphaMode::mask};
}

Frame frame_of(const std::vector<Card>& cards, std::uint32_t samples = 4) {
    Frame frame = frame_of_cards(cards, edge);
    frame.view.samples = samples;
    return frame;
}

/// Alphas 0, 1/16 .. 1, tile by tile.
Frame sixteenths(std::uint32_t samples) {
    std::vector<Card> cards;
    for (std::uint32_t k = 0; k <= 16; ++k) cards.push_back(card_over(k, float(k) / 16));
    return frame_of(cards, samples);
}

glm::uvec2 corner_of(std::uint32_t number) { return {number % (edge / tile) * tile, number / (edge / tile) * tile}; }

TEST(MaskedSurfaces, OfConstantAlphaCoverTheSamplesThatTheTablesSay) {
    constexpr std::uint32_t band_modes[] = {masked_a2c_1, masked_a2c_2, masked_a2c_or, masked_full_step, masked_unbiased};
    for (const std::uint32_t samples : {1u, 4u}) {
        const auto session = session_of({sixteenths(samples)});
        for (const std::uint32_t mode : band_modes) {
            const Masks got = masks_of(*session, with(mode));
            for (std::uint32_t k = 0; k <= 16; ++k)
                for (std::uint32_t i = 0; i < tile * tile; ++i) {
                    const glm::uvec2 at = corner_of(k) + glm::uvec2(i % tile, i / tile);
                    ASSERT_EQ(got.at(at.x, at.y), sample_mask(mode, samples, k / 16.0, {at.x, at.y, k, 0}))
                        << modes()[mode] << " at " << samples << ": " << k << "/16 in pixel " << at.x << ", " << at.y;
                }
        }
    }
}

TEST(MaskedSurfaces, CoverSixteenthsOnAverageAsTheChapterSays) {
    const auto session = session_of({sixteenths(4)});
    for (const MeanCoverages& row : mean_coverages) {
        const Masks got = masks_of(*session, with(row.mode));
        std::string measured;
        for (std::size_t i = 0; i < table_alphas.size(); ++i) {
            const double coverage = got.coverage(corner_of(table_alphas[i]), {tile, tile});
            measured += fmt::format("{} ", coverage);
            EXPECT_EQ(coverage, row.at[i]) << modes()[row.mode] << " at " << table_alphas[i] << "/16";
        }
        RecordProperty(std::string(modes()[row.mode]), measured);
    }
    const Masks clipped = masks_of(*session, with(masked_clip));
    EXPECT_EQ(clipped.coverage(corner_of(7), {tile, tile}), 0);
    EXPECT_EQ(clipped.coverage(corner_of(8), {tile, tile}), 1);
}

TEST(MaskedSurfaces, OfAlphaOneHaveNoCracksByAnyMode) {
    const std::vector<Card> cards{{.center = {0, 0, 3}, .half = 2, .tilt = 0.7},
                                  {.center = {0.5, 0.4, 2}, .half = 0.6f, .tilt = -0.5}};
    std::vector<Frame> frames;
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask}) {
        std::vector<Card> same = cards;
        for (Card& card : same) card.alpha_mode = mode;
        frames.push_back(frame_of(same));
    }
    const auto session = session_of(frames);
    const std::vector<std::uint32_t> solid = masks_of(*session, with(masked_clip)).of;
    EXPECT_GT(std::ranges::count(solid, 15u), 100);
    for (std::uint32_t mode = 0; mode < modes().size(); ++mode) {
        Request request = with(mode);
        request.variant.frame = 1;
        EXPECT_EQ(masks_of(*session, request).of, solid) << modes()[mode];
        set(request, "attributes=sample");
        EXPECT_EQ(masks_of(*session, request).of, solid) << modes()[mode] << ", attributes at the sample";
    }
}

/// Cards whose alpha grows from left to right and reaches .5 at x = 1 + (number + .5) / 16 of their four pixels: by the colors of
/// vertices, or by a texture of two texels.
enum class AlphaBy { vertices, texture };
Frame half_planes(AlphaBy by, bool downwards) {
    std::vector<Card> cards;
    for (std::uint32_t number = 0; number < 16; ++number) cards.push_back(card_over(number, 1));
    Frame frame = frame_of(cards);
    const Mesh square = frame.meshes[0];
    if (by == AlphaBy::texture) {
        const float texels[] = {1, 1, 1, 0, 1, 1, 1, 1};
        Texture& ramp = frame.textures.emplace_back(Texture{.format = TextureFormat::rgba32f, .width = 2, .height = 1});
        ramp.address = AddressMode::clamp;
        ramp.texels.resize(sizeof texels);
        std::memcpy(ramp.texels.data(), texels, sizeof texels);
    }
    for (std::uint32_t number = 0; number < 16; ++number) {
        Mesh mesh = square;
        for (const glm::vec3& corner : mesh.positions) {
            const float along = downwards ? 2 - 2 * corner.y : 2 + 2 * corner.x;  // pixels from the card's left or upper side
            const float alpha = 0.5f + (along - (1 + (float(number) + 0.5f) / 16)) / 8;
            if (by == AlphaBy::vertices) mesh.colors.emplace_back(1, 1, 1, alpha);
            else mesh.uv0.emplace_back(0.25f + 0.5f * alpha, 0.5f);
        }
        frame.draws[number].mesh = static_cast<std::uint32_t>(frame.meshes.size());
        if (by == AlphaBy::texture) frame.materials[number].base_color_texture.texture = 0;
        frame.meshes.push_back(std::move(mesh));
    }
    return frame;
}

TEST(MaskedSurfaces, OfHalfPlanesStepAtTheSamplesPlaces) {
    const auto session = must(Session::open({half_planes(AlphaBy::vertices, false), half_planes(AlphaBy::vertices, true),
                                             half_planes(AlphaBy::texture, false), half_planes(AlphaBy::texture, true)},
                                            {.validation = true}));
    constexpr double along_x[] = {.375, .875, .125, .625}, along_y[] = {.125, .375, .625, .875};
    for (std::size_t frame = 0; frame < 4; ++frame)
        for (const std::uint32_t mode : {masked_per_sample, masked_per_sample_fine}) {
            Request request = with(mode);
            request.variant.frame = frame;
            const Masks got = masks_of(*session, request);
            for (std::uint32_t number = 0; number < 16; ++number) {
                std::uint32_t wanted = 0;
                for (std::uint32_t i = 0; i < 4; ++i)
                    if ((frame % 2 == 1 ? along_y : along_x)[i] > (number + .5) / 16) wanted |= 1u << i;
                const glm::uvec2 at = corner_of(number) + (frame % 2 == 1 ? glm::uvec2(2, 1) : glm::uvec2(1, 2));
                EXPECT_EQ(got.at(at.x, at.y), wanted) << modes()[mode] << " frame " << frame << " edge " << number;
            }
        }
}

/// A chessboard over four pixels.
Frame minified_chessboard(float cutoff) {
    Frame frame = frame_of({card_over(0, 1)});
    paint_chessboard(frame, cutoff);
    return frame;
}

TEST(MaskedSurfaces, OfAMinifiedChessboardVanishOrGrowSolidWhereTheyAreTestedAndFadeInBands) {
    const auto session = session_of({minified_chessboard(200.f / 255), minified_chessboard(.5f)});
    struct Row {
        std::uint32_t mode;
        double above, at_half;  // with a cutoff of 200 / 255, and of .5
    };
    for (const Row& row : {Row{masked_clip, 0, 1},
                           {masked_per_sample, 0, 1},
                           {masked_per_sample_fine, 0, 1},
                           {masked_a2c_1, .5, .5},
                           {masked_a2c_2, .5, .5},
                           {masked_a2c_or, .5, .5},
                           {masked_full_step, .5, .5},
                           {masked_unbiased, .5, .5},
                           {masked_mip_coverage, 1, 1}}) {
        Request request = with(row.mode);
        EXPECT_EQ(masks_of(*session, request).coverage({0, 0}, {tile, tile}), row.above) << modes()[row.mode];
        request.variant.frame = 1;
        EXPECT_EQ(masks_of(*session, request).coverage({0, 0}, {tile, tile}), row.at_half) << modes()[row.mode];
    }
}

TEST(MaskedSurfaces, OverEachOtherHideMoreWhereTheirPatternsDiffer) {
    const std::vector<Card> two{{.center = {0, 0, 2}, .half = 3, .color = {1, 1, 1, .5f}, .alpha_mode = AlphaMode::mask},
                                {.center = {0, 0, 3}, .half = 4, .color = {1, 1, 1, .5f}, .alpha_mode = AlphaMode::mask}};
    const auto session = session_of({frame_of(two)});
    const auto coverage = [&](std::uint32_t mode) { return masks_of(*session, with(mode)).coverage({0, 0}, {edge, edge}); };
    EXPECT_EQ(coverage(masked_a2c_1), .5);
    EXPECT_EQ(coverage(masked_a2c_2), .5);
    // A pixel's union has a standard deviation of .177; there are 1024.
    EXPECT_NEAR(coverage(masked_unbiased), .75, 4 * .177 / 32);
}

/// The device's table; what Vulkan says of it is in tests/6_replay/executor_raster_test.cpp.
TEST(MaskedSurfaces, OfConstantAlphaByHardwareAreTheDevicesTable) {
    const auto session = session_of({sixteenths(4)});
    const Masks got = masks_of(*session, with(masked_hardware));
    double last = 0;
    std::string table;
    for (std::uint32_t k = 0; k <= 16; ++k) {
        const double coverage = got.coverage(corner_of(k), {tile, tile});
        table += fmt::format("{}{:x}", k == 0 ? "" : " ", got.at(corner_of(k).x, corner_of(k).y));
        EXPECT_GE(coverage, last) << k << "/16";
        last = coverage;
    }
    RecordProperty("masks of k/16", table);
    EXPECT_EQ(got.coverage(corner_of(0), {tile, tile}), 0);
    EXPECT_EQ(got.coverage(corner_of(16), {tile, tile}), 1);
}

/// In two passes a sample that only the first one drew would have a depth and no surface. SwiftShader has surfaces of depth 0.
TEST(MaskedSurfaces, ByHardwareHaveASurfaceWhereverTheFirstPassLeftADepth) {
    const auto session = scenario_session("fence_and_foliage", 4);
    for (const char* attributes : {"attributes=center", "attributes=sample"}) {
        Request request = with(masked_hardware, {attributes});
        request.outputs = {"depth_layers", "emission"};
        const auto run = must(session->run(request));
        const ReferenceImage depth = in_double(run.images.at("depth_layers")), emission = in_double(run.images.at("emission"));
        std::size_t surfaces = 0, lost = 0;
        for (std::size_t i = 0; i < depth.texels.size(); ++i) {
            surfaces += emission.texels[i].w > 0;
            lost += depth.texels[i].x > 0 && !(emission.texels[i].w > 0);
        }
        EXPECT_EQ(lost, 0u) << attributes;
        EXPECT_GT(surfaces, depth.texels.size() / 2);
    }
}

TEST(MaskedSurfaces, CostNothingInFramesWithoutThem) {
    const auto session = scenario_session("opaque_only", 4);
    const auto steps = [&](std::uint32_t mode) {
        std::vector<std::string> described;
        for (const PlannedStep& planned : must(session->plan(with(mode))).plan.steps) {
            std::string text = planned.step.name;
            for (const Fixed& fixed : planned.step.fixed)
                text += fmt::format(" {}={}", fixed.name, std::visit([](auto value) { return double(value); }, fixed.value));
            described.push_back(text);
        }
        return described;
    };
    const std::vector<std::string> plain = steps(masked_clip);
    for (std::uint32_t mode = 1; mode < modes().size(); ++mode) EXPECT_EQ(steps(mode), plain) << modes()[mode];
}

/// One sample lies at the pixel's center, where the plain test asks.
TEST(MaskedSurfaces, AtOneSampleAreTestedAtThePixelsCenterByTheModesOfSamples) {
    const auto session = scenario_session("fence_and_foliage");
    const std::vector<std::uint32_t> clipped = masks_of(*session, with(masked_clip)).of;
    for (const std::uint32_t mode : {masked_per_sample, masked_per_sample_fine, masked_sharpened, masked_hardware})
        EXPECT_EQ(masks_of(*session, with(mode)).of, clipped) << modes()[mode];
}

class MaskedBy : public testing::TestWithParam<std::uint32_t> {};

void expect_agreement(std::uint32_t mode, const std::vector<std::string>& more) {
    Request request = on_scenario("fence_and_foliage", 4);
    request.choices = with(mode, more).choices;
    const Technique& technique = **find_technique("gbuffer/octahedral");
    const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::gbuffer, Against::model));
    if (mode != masked_hardware) return expect_proven_within_tolerance(accuracy, technique, request, "fence_and_foliage");
    // The model leaves alphas between 0 and 1 to the device, and what lies behind them: 46 % of the samples.
    expect_within_tolerance(accuracy, technique, request, "fence_and_foliage");
    EXPECT_GT(accuracy.compared - accuracy.trivial, 10'000u);
}

TEST_P(MaskedBy, CoverTheSamplesOfAFenceThatTheModelSays) { expect_agreement(GetParam(), {}); }

INSTANTIATE_TEST_SUITE_P(Modes, MaskedBy, testing::Range(0u, masked_hardware + 1),
                         [](const auto& tested) { return std::string(modes()[tested.param]); });

class ExhaustiveMaskedBy : public testing::TestWithParam<std::uint32_t> {};

TEST_P(ExhaustiveMaskedBy, WithAttributesAtTheSampleToo) { expect_agreement(GetParam(), {"attributes=sample"}); }

INSTANTIATE_TEST_SUITE_P(Modes, ExhaustiveMaskedBy, testing::Range(0u, masked_hardware + 1),
                         [](const auto& tested) { return std::string(modes()[tested.param]); });

}  // namespace
}  // namespace strata
