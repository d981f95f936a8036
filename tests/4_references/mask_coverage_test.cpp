// Why the true coverage of masked surfaces can be believed: rays with an intersection, a lookup of texels and places of their
// own, and a mask that is solid on a quarter of its card at every distance.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame.h"
#include "captures/scenarios.h"
#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/gbuffer/coverage/judge.h"
#include "passes/gbuffer/nearest.h"
#include "passes/gbuffer/truth.h"
#include "passes/stage_input.h"
#include "tests/4_references/tiny_frame.h"
#include "tests/support/plain_rays.h"

namespace strata::gbuffer {
namespace {

/// Of a pixel: the share of rays that meet a mask first, and mean alpha of the masks before the nearest other surface.
struct ByRays {
    double area = 0, alpha = 0;
};

bool is_mask(const PlainHit& hit) { return hit.triangle->material->alpha_mode == AlphaMode::mask; }

ByRays along(const std::vector<PlainHit>& hits) {
    double solid = HUGE_VAL, cut = HUGE_VAL, passes = 1;
    for (const PlainHit& hit : hits) {
        if (!is_mask(hit)) solid = std::min(solid, hit.z);
        else if (hit.alpha >= double(hit.triangle->material->mask_cutoff)) cut = std::min(cut, hit.z);
    }
    for (const PlainHit& hit : hits)
        if (is_mask(hit) && hit.z < solid) passes *= 1 - hit.alpha;
    return {cut < solid ? 1. : 0., 1 - passes};
}

/// At 1024 places of Roberts' additive recurrence in the pixel, moved by `moved`.
ByRays by_rays(const PlainRays& rays, glm::dvec2 pixel, glm::dvec2 moved) {
    constexpr int places = 1024;
    ByRays mean;
    for (int i = 0; i < places; ++i) {
        const glm::dvec2 place = glm::fract(moved + double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        const ByRays one = along(rays.hits(pixel + place));
        mean.area += one.area / places;
        mean.alpha += one.alpha / places;
    }
    return mean;
}

ImageSet truth_of(const Frame& frame) { return gbuffer_truth({frame, {}}); }

/// 64 x 36 pixels of 1024 rays take 2 s; the truth takes as long.
TEST(MaskCoverage, OfAFenceAndFoliageIsWhatRaysThatShareNoCodeCount) {
    const Frame frame = (*find_scenario("fence_and_foliage"))->build(0, {.width = 64, .height = 36, .samples = 1});
    const ReferenceImage depth = truth_of(frame).at("depth_layers");
    const PlainRays rays(frame);
    tiny::Random random(11);
    double area = 0, alpha = 0, area_by_rays = 0, alpha_by_rays = 0, squares = 0, alpha_squares = 0, own = 0;
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            const ByRays wanted = by_rays(rays, {x, y}, {random(), random()});
            const std::size_t i = depth.index(x, y);
            area += depth.texels[i].y;
            alpha += depth.texels[i].z;
            area_by_rays += wanted.area;
            alpha_by_rays += wanted.alpha;
            squares += std::pow(depth.texels[i].y - wanted.area, 2);
            alpha_squares += std::pow(depth.texels[i].z - wanted.alpha, 2);
            own += std::pow(depth.standard_error[i].y, 2);
        }
    const double pixels = double(depth.texels.size()), rms = std::sqrt(squares / pixels), own_rms = std::sqrt(own / pixels);
    RecordProperty("area", std::to_string(area) + ", by rays " + std::to_string(area_by_rays));
    RecordProperty("rms", std::to_string(rms) + ", own error " + std::to_string(own_rms));
    EXPECT_GT(area_by_rays, 200);
    // Of the whole area, .08 %.
    const double own_of_area = std::sqrt(own);
    EXPECT_LT(own_of_area, .001 * area);
    EXPECT_NEAR(area, area_by_rays, 3 * own_of_area);
    EXPECT_NEAR(alpha, alpha_by_rays, 3 * own_of_area);
    // The rays have an error, too, of half as much and more.
    EXPECT_LT(rms, 2 * own_rms);
    EXPECT_LT(own_rms, .015);
    EXPECT_LT(std::sqrt(alpha_squares / pixels), .015);
}

/// A card over 32 x 32 pixels whose mask is solid on one of four columns, so many times from left to right.
Frame quarter_card(double repeats, std::uint32_t samples = 1) {
    Frame frame = tiny::frame(32, 32, samples);
    const std::uint32_t draw = tiny::add_quad(frame, {.right = 32, .bottom = 32}, 3, AlphaMode::mask);
    for (glm::vec2& uv : frame.meshes.back().uv0) uv.x *= float(repeats);
    Texture& columns = frame.textures.emplace_back(Texture{.width = 4, .height = 1, .mips = 3});
    for (const int alpha : {255, 0, 0, 0, 128, 0, 64})
        for (const int channel : {255, 255, 255, alpha}) columns.texels.push_back(std::byte(channel));
    tiny::material(frame, draw).base_color_texture.texture = 0;
    return frame;
}

// A column of 1 between columns of 0 is at least a half, bilinearly, over one column's width: a quarter of the card.
TEST(MaskCoverage, OfAMaskThatIsSolidOnAQuarterIsAQuarterAtEveryDistance) {
    // Wider than the card's pixels, as wide, in step with the places that are counted at, and far narrower.
    for (const double repeats : {1., 7., 32., 128., 512., 1024., 4096., 99991.}) {
        const ReferenceImage depth = truth_of(quarter_card(repeats)).at("depth_layers");
        double area = 0, alpha = 0, own = 0;
        for (std::size_t i = 0; i < depth.texels.size(); ++i) {
            area += depth.texels[i].y / 1024;
            alpha += depth.texels[i].z / 1024;
            own += std::pow(depth.standard_error[i].y / 1024, 2);
        }
        EXPECT_NEAR(area, .25, 4 * std::sqrt(own) + 1e-4) << repeats;
        EXPECT_NEAR(alpha, .25, .002) << repeats;
        EXPECT_LT(std::sqrt(own), .0015) << repeats;
    }
}

using Metrics = std::map<std::string, double>;

Metrics metrics_of(const Frame& frame, std::uint32_t mode) {
    const ImageSet result = surface_images(frame, nearest_surfaces(frame, ShadeAt::pixel_center, mode));
    Metrics named;
    for (const Metric& metric : coverage_metrics(result, truth_of(frame), frame)) named[metric.name] = metric.value;
    return named;
}

TEST(MaskCoverage, JudgesTheModeThatKeepsTheQuarterAboveThoseThatLoseIt) {
    const Frame frame = quarter_card(4096, 4);
    for (const std::uint32_t mode : {masked_clip, masked_per_sample}) {
        const Metrics lost = metrics_of(frame, mode);
        EXPECT_NEAR(lost.at("masked coverage off"), .25, .002) << mode;
        EXPECT_EQ(lost.at("masked area off"), 100) << mode;
        EXPECT_EQ(lost.at("masked alpha area off"), 100) << mode;
    }
    for (const std::uint32_t mode : {masked_a2c_1, masked_unbiased}) {
        const Metrics kept = metrics_of(frame, mode);
        EXPECT_LT(kept.at("masked coverage off"), .03) << mode;
        EXPECT_LT(kept.at("masked area off"), 1) << mode;
        EXPECT_LT(kept.at("masked alpha off"), .03) << mode;
        EXPECT_LT(kept.at("masked coverage truth error"), .03);
        EXPECT_LT(kept.at("masked area truth error"), .5);
    }
}

// The float nearest to 128/255 is above the double nearest to it: a card of that alpha and that cutoff is there.
TEST(MaskCoverage, OfAnAlphaThatIsTheCutoffIsWhole) {
    for (const int alpha : {128, 51, 129, 77}) {
        Frame frame = quarter_card(1);
        frame.textures[0].texels.clear();
        for (int texel = 0; texel < 7; ++texel)
            for (const int channel : {255, 255, 255, alpha}) frame.textures[0].texels.push_back(std::byte(channel));
        frame.materials[0].mask_cutoff = float(alpha) / 255;
        const ReferenceImage depth = truth_of(frame).at("depth_layers");
        double area = 0;
        for (const glm::dvec4& texel : depth.texels) area += texel.y;
        EXPECT_EQ(area, 1024) << alpha;
    }
}

// Its alpha is everywhere below the cutoff: nothing is covered, and two of four samples are in bands.
TEST(MaskCoverage, HasAFloorWhereNothingIsCovered) {
    Frame frame = quarter_card(1, 4);
    frame.materials[0].base_color_texture.texture = no_index;
    frame.materials[0].base_color.w = .45f;
    const Metrics banded = metrics_of(frame, masked_a2c_1);
    EXPECT_DOUBLE_EQ(banded.at("masked coverage off"), .5);
    EXPECT_DOUBLE_EQ(banded.at("masked area off"), 5000) << "of 1 % of the pixels";
    EXPECT_NEAR(banded.at("masked alpha area off"), 100 * (.5 / .45 - 1), 1e-4);
    EXPECT_EQ(metrics_of(frame, masked_clip).at("masked area off"), 0);
    EXPECT_EQ(metrics_of(frame, masked_clip).at("masked alpha area off"), 100);
}

}  // namespace
}  // namespace strata::gbuffer
