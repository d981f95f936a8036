// Deep images as frames: every sample is a fragment of its own pixel, whatever the file's order, windows, layout and packing.
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/import/deep.h"
#include "capture_format/reader.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/truth.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/deep_exr.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

Result<ImportedDeep> imported_deep(const std::string& file, const DeepOptions& options = {}) {
    return import_deep(bytes_of(file), "test.exr", options);
}

/// The image as a frame that check_frame() accepts.
ImportedDeep frame_of(const DeepSource& source) {
    auto result = imported_deep(deep_file(source));
    EXPECT_TRUE(result) << (result ? "" : result.error().sentence);
    const auto checked = check_frame(result->frame);
    EXPECT_TRUE(checked) << (checked ? "" : checked.error().sentence);
    return *std::move(result);
}

FragmentLists fragments_of(const Frame& frame) {
    return transparent_fragments(frame, ReferenceImage(frame.view.width, frame.view.height, frame.view.samples));
}

/// One pixel of (R, A, Z) samples: red, hiding all channels alike.
DeepSource pixel_of(std::vector<std::vector<float>> samples) {
    return {.channels = {"R", "A", "Z"}, .pixels = {std::move(samples)}};
}

/// What that pixel looks like in red, from nearest to farthest, over a background of 1.
double red_of(const ImportedDeep& image) { return exact_blend(fragments_of(image.frame).at(0, 0), glm::dvec3(1)).x; }

/// 0 to 5 samples in each pixel, in any order of depth.
DeepSource random_image(std::uint32_t width, std::uint32_t height) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    DeepSource source{.width = width, .height = height};
    for (std::uint32_t i = 0; i < width * height; ++i) {
        auto& pixel = source.pixels.emplace_back();
        for (auto n = random() % 6; n > 0; --n)
            pixel.push_back({unit(random), unit(random), unit(random), unit(random), 1 + 99 * unit(random)});
    }
    return source;
}

TEST(DeepImport, MakesEverySampleAFragmentOfItsOwnPixelAndOfNoOther) {
    const DeepSource source = random_image(37, 23);
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame frame = frame_of(source).frame;
        frame.view.samples = samples;
        const FragmentLists lists = fragments_of(frame);
        for (std::uint32_t i = 0; i < source.pixels.size(); ++i)
            for (std::uint32_t sample = 0; sample < samples; ++sample) {
                ASSERT_EQ(lists.at(i % 37, i / 37, sample).size(), source.pixels[i].size()) << "pixel " << i;
                EXPECT_FALSE(lists.undecided(i % 37, i / 37, sample)) << "pixel " << i;
            }
    }
}

TEST(DeepImport, ShowsAWholePixelOfTheImageInAPixelAtHalfExtent) {
    const DeepSource source = random_image(38, 24);
    Frame frame = frame_of(source).frame;
    frame.view.width /= 2;
    frame.view.height /= 2;
    const FragmentLists lists = fragments_of(frame);
    for (std::uint32_t y = 0; y < 12; ++y)
        for (std::uint32_t x = 0; x < 19; ++x)
            ASSERT_EQ(lists.at(x, y).size(), source.pixels[2 * y * 38 + 2 * x].size()) << x << ", " << y;
}

TEST(DeepImport, KeepsDepthColorAndAlphaOfEverySample) {
    const DeepSource source = random_image(9, 7);
    const FragmentLists lists = fragments_of(frame_of(source).frame);
    for (std::uint32_t i = 0; i < source.pixels.size(); ++i) {
        auto expected = source.pixels[i];
        std::ranges::sort(expected, std::ranges::greater{}, [](const auto& sample) { return sample[4]; });
        const auto found = lists.at(i % 9, i / 9);  // submitted far to near
        for (std::size_t s = 0; s < expected.size(); ++s) {
            // Interpolated in double over three equal corners: a few roundings of 1e-16, amplified by the triangle's distance.
            EXPECT_NEAR(found[s].depth / double(expected[s][4]), 1, 1e-12);
            EXPECT_NEAR(found[s].color.y, double(expected[s][1]), 1e-12);
            EXPECT_NEAR(found[s].transmittance.z, 1 - double(expected[s][3]), 1e-12);
        }
    }
}

TEST(DeepImport, SortsAndLetsTheEarlierOfEqualDepthsBeNearer) {
    const ImportedDeep unsorted = frame_of(pixel_of({{.5f, .5f, 9}, {.25f, .5f, 4}}));
    EXPECT_DOUBLE_EQ(red_of(unsorted), .25 + .5 * (.5 + .5));
    EXPECT_EQ(unsorted.census.unsorted_pixels, 1u);
    const ImportedDeep tied = frame_of(pixel_of({{.5f, .5f, 4}, {0, .5f, 4}}));
    EXPECT_DOUBLE_EQ(red_of(tied), .5 + .25);
    EXPECT_EQ(tied.census.ties, 1u);
    EXPECT_THAT(tied.warnings, Contains(HasSubstr("the earlier one counts as nearer")));
}

TEST(DeepImport, KeepsLightWithoutAlpha) {
    const ImportedDeep image = frame_of(pixel_of({{.75f, 0, 2}, {0, .5f, 3}}));
    EXPECT_DOUBLE_EQ(red_of(image), .75 + .5);
    EXPECT_EQ(image.census.without_alpha, 1u);
}

TEST(DeepImport, CutsVolumesWhereTheyOverlapAndMergesEqualCuts) {
    // Alpha .75 over depths 2 to 6 is .5 over 2 to 4 and over 4 to 6. The second volume, as dense, fills 4 to 6, where alphas
    // .5 and .5 make .75; light per thickness adds up.
    DeepSource source{.channels = {"R", "A", "Z", "ZBack"}};
    source.pixels = {{{.75f, .75f, 2, 6}, {0, .5f, 4, 6}}};
    const ImportedDeep image = frame_of(source);
    const FragmentLists lists = fragments_of(image.frame);
    ASSERT_EQ(lists.at(0, 0).size(), 2u);
    const Fragment &back = lists.at(0, 0)[0], &front = lists.at(0, 0)[1];
    EXPECT_NEAR(front.depth, 2, 1e-12);
    EXPECT_NEAR(front.alpha, .5, 1e-7);
    EXPECT_NEAR(front.color.x, .5, 1e-7);
    EXPECT_NEAR(back.depth, 4, 1e-12);
    EXPECT_NEAR(back.alpha, .75, 1e-7);
    EXPECT_NEAR(back.color.x, .375, 1e-7) << "half of the light of .75 at alpha .75, as half of the density shines";
    EXPECT_EQ(image.census.volumes, 2u);
    EXPECT_EQ(image.census.split_pixels, 1u);
}

TEST(DeepImport, CutsAVolumeAtAPointInsideAndNotAtOneOnItsBorder) {
    DeepSource inside{.channels = {"A", "Z", "ZBack"}}, border = inside;
    inside.pixels = {{{.75f, 2, 6}, {.5f, 4, 4}}};
    border.pixels = {{{.75f, 2, 6}, {.5f, 6, 6}}};
    EXPECT_EQ(frame_of(inside).census.fragments, 3u);
    EXPECT_EQ(frame_of(border).census.fragments, 2u);
}

TEST(DeepImport, SplitsOpaqueVolumesIntoOpaqueOnesAndSharesTheirColor) {
    DeepSource source{.channels = {"R", "A", "Z", "ZBack"}};
    source.pixels = {{{1, 1, 2, 4}, {.5f, 1, 2, 4}, {9, .5f, 2, 4}}};
    const ImportedDeep image = frame_of(source);
    EXPECT_EQ(image.census.fragments, 1u);
    EXPECT_DOUBLE_EQ(red_of(image), .75);
}

TEST(DeepImport, FillsInMissingChannelsAndSaysSo) {
    DeepSource gray{.channels = {"Y", "A", "Z"}}, black{.channels = {"A", "Z"}}, opaque{.channels = {"R", "Z"}};
    gray.pixels = {{{.5f, .5f, 2}}};
    black.pixels = {{{.5f, 2}}};
    opaque.pixels = {{{.5f, 2}}};
    EXPECT_DOUBLE_EQ(red_of(frame_of(gray)), 1);
    EXPECT_THAT(frame_of(gray).warnings, Contains(HasSubstr("Y is taken")));
    EXPECT_DOUBLE_EQ(red_of(frame_of(black)), .5);
    EXPECT_THAT(frame_of(black).warnings, Contains(HasSubstr("the samples are black")));
    EXPECT_DOUBLE_EQ(red_of(frame_of(opaque)), .5);
    EXPECT_THAT(frame_of(opaque).warnings, Contains(HasSubstr("every sample is opaque")));
}

TEST(DeepImport, KeepsAnAlphaPerChannelAsThreeFragments) {
    DeepSource source{.channels = {"R", "G", "B", "A", "AR", "AG", "AB", "Z"}};
    source.pixels = {{{.5f, .25f, 0, .5f, .75f, .5f, 0, 3}, {.5f, .5f, .5f, .5f, .5f, .5f, .5f, 5}}};
    const ImportedDeep image = frame_of(source);
    const glm::dvec3 seen = exact_blend(fragments_of(image.frame).at(0, 0), glm::dvec3(1));
    EXPECT_EQ(image.census.fragments, 6u);
    EXPECT_DOUBLE_EQ(seen.x, .5 + .25 * (.5 + .5));
    EXPECT_DOUBLE_EQ(seen.y, .25 + .5 * (.5 + .5));
    EXPECT_DOUBLE_EQ(seen.z, 0 + (.5 + .5));
}

TEST(DeepImport, LeavesOutWhatHasNoPlaceInFrontOfTheEyeAndMendsTheRest) {
    const ImportedDeep image = frame_of(pixel_of({{1, 1, not_a_number},
                                                  {1, 1, 0},
                                                  {1, 1, -3},
                                                  {1, 1, -infinite},
                                                  {not_a_number, .5f, 2},
                                                  {1, not_a_number, 3},
                                                  {.5f, 2, 5},
                                                  {1, -1, 4},
                                                  {1, 1, infinite}}));
    EXPECT_EQ(image.census.depth_not_a_number, 1u);
    EXPECT_EQ(image.census.depth_not_in_front, 3u);
    EXPECT_EQ(image.census.depth_infinite, 1u);
    EXPECT_EQ(image.census.bad_color, 2u);
    EXPECT_EQ(image.census.bad_alpha, 2u);
    EXPECT_DOUBLE_EQ(red_of(image), .5 * (1 + 1 + .5)) << "black half, light without alpha twice, then an opaque half";
    EXPECT_NEAR(fragments_of(image.frame).at(0, 0)[0].depth, 10, 1e-12) << "twice as far as the farthest finite one";
}

TEST(DeepImport, PutsWhatIsInfinitelyFarIntoItsOwnPixelInEveryLine) {
    DeepSource source{.channels = {"R", "A", "Z"}, .width = 2, .height = 3};
    for (std::uint32_t i = 0; i < 6; ++i) source.pixels.push_back({{1, .5f, infinite}, {0, .5f, float(1 + i)}});
    const ImportedDeep image = frame_of(source);
    EXPECT_EQ(image.census.depth_infinite, 6u);
    const FragmentLists lists = fragments_of(image.frame);
    for (std::uint32_t i = 0; i < 6; ++i) {
        ASSERT_EQ(lists.at(i % 2, i / 2).size(), 2u) << "pixel " << i;
        EXPECT_NEAR(lists.at(i % 2, i / 2)[0].depth, 12, 1e-6);
        EXPECT_NEAR(lists.at(i % 2, i / 2)[1].depth, 1 + i, 1e-6);
    }
}

TEST(DeepImport, PutsDepthsBelowTheSmallestThatCanBeDrawnThereInTheirOrder) {
    const ImportedDeep image = frame_of(pixel_of({{1, 1, 2e-40f}, {0, .5f, 1e-40f}}));
    EXPECT_EQ(image.census.depth_too_near, 2u);
    EXPECT_EQ(image.census.depth_not_in_front, 0u);
    EXPECT_DOUBLE_EQ(red_of(image), .5) << "the half that is nearer is black";
}

TEST(DeepImport, ReadsEveryLayoutPackingAndTypeAlike) {
    DeepSource source = random_image(11, 8);
    for (auto& pixel : source.pixels)
        for (auto& sample : pixel)
            for (float& value : sample) value = std::round(value * 8) / 8;  // a half holds these
    const Frame expected = frame_of(source).frame;
    for (const DeepLayout layout : {DeepLayout::lines, DeepLayout::tiles})
        for (const DeepPacking packing : {DeepPacking::none, DeepPacking::rle, DeepPacking::zips})
            for (const char* suffix : {"", ":half"}) {
                source.layout = layout;
                source.packing = packing;
                source.channels = {"R", fmt::format("G{}", suffix), "B", "A", fmt::format("Z{}", suffix)};
                Frame frame = frame_of(source).frame;
                ASSERT_EQ(frame.meshes[0].positions.size(), expected.meshes[0].positions.size());
                // Tiles come in another order: the lists of pixels tell.
                const FragmentLists got = fragments_of(frame), wanted = fragments_of(expected);
                for (std::uint32_t i = 0; i < 88; ++i)
                    for (std::size_t s = 0; s < wanted.at(i % 11, i / 11).size(); ++s)
                        EXPECT_EQ(got.at(i % 11, i / 11)[s].depth, wanted.at(i % 11, i / 11)[s].depth);
            }
}

TEST(DeepImport, PlacesTheDataWindowInTheDisplayWindowAndLeavesOutWhatIsOutside) {
    DeepSource source{.channels = {"A", "Z"}, .width = 2, .height = 2, .at = {-1, 3}};
    source.display_from = {-2, -2};
    source.display_to = {0, 3};
    source.pixels = {{{1, 1}}, {{1, 2}}, {{1, 3}}, {{1, 4}}};
    const ImportedDeep image = frame_of(source);
    EXPECT_EQ(image.frame.view.width, 3u);
    EXPECT_EQ(image.frame.view.height, 6u);
    EXPECT_EQ(image.census.outside, 2u) << "the row below the display window";
    const FragmentLists lists = fragments_of(image.frame);
    ASSERT_EQ(lists.at(1, 5).size(), 1u);
    EXPECT_NEAR(lists.at(2, 5)[0].depth, 2, 1e-12);
}

TEST(DeepImport, ReadsAWindowOfALargeImageAndCountsNoFurther) {
    const std::string file = deep_file(random_image(37, 23));
    const ImportedDeep all = *imported_deep(file);
    const auto middle = imported_deep(file, {.window = DeepWindow{10, 8, 5, 4}, .most_samples = all.census.samples / 3});
    ASSERT_TRUE(middle) << middle.error().sentence;
    EXPECT_EQ(middle->frame.view.width, 5u);
    const FragmentLists part = fragments_of(middle->frame), whole = fragments_of(all.frame);
    for (std::uint32_t i = 0; i < 20; ++i)
        EXPECT_EQ(part.at(i % 5, i / 5).size(), whole.at(10 + i % 5, 8 + i / 5).size()) << "pixel " << i;
    EXPECT_FALSE(imported_deep(file, {.window = DeepWindow{0, 0, 0, 4}}));
}

TEST(DeepImport, ReadsThePartThatIsAskedFor) {
    const std::string file = deep_file({{"near", pixel_of({{1, 1, 1}})}, {"far", pixel_of({{1, 1, 9}})}});
    const auto depth_of = [&](const char* part) {
        return fragments_of(imported_deep(file, {.part = part})->frame).at(0, 0)[0].depth;
    };
    EXPECT_NEAR(depth_of(""), 1, 1e-12);
    EXPECT_NEAR(depth_of("far"), 9, 1e-12);
    EXPECT_NEAR(depth_of("1"), 9, 1e-12);
    const auto missing = imported_deep(file, {.part = "middle"});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().fault, Fault::usage);
    EXPECT_THAT(missing, FailsWith("import.deep.part_missing", Field("part", "middle"), Field("parts", "0 'near', 1 'far'")));
}

TEST(DeepImport, KeepsProductsInDoubleBehindTwoHundredLayers) {
    // Alpha .07 two hundred times, then a light of 3e5: what is left is .0000005 of it, and a float's 1 - A cannot say that.
    std::vector<std::vector<float>> samples(200, {0, .07f, 0});
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i][2] = 1 + float(i);
    samples.push_back({3e5f, 1, 1000});
    const DeepSource source{.channels = {"R", "A", "Z", "G", "B"}, .pixels = {samples}};
    DeepSource complete = source;
    for (auto& sample : complete.pixels[0]) sample.resize(5, 0);
    const TemporaryFile path("deep.exr");
    write_file(path.path(), bytes_of(deep_file(complete)));
    const double exact = 3e5 * std::pow(1 - double(.07f), 200), float_result = double(openexr_composite(path.path()).texels[0].x);
    EXPECT_NEAR(red_of(frame_of(complete)) / exact, 1, 1e-12);
    EXPECT_LT(float_result / exact, .97) << "OpenEXR's own compositing keeps alpha in float: 4.1 % low measured with 3.1.5";
}

TEST(DeepPreview, IsTheCompositeOfEachPixelWhereTheImageIsSmall) {
    DeepSource source = pixel_of({{.5f, .5f, 2}, {.25f, 1, 1}, {.125f, .75f, .5f}});
    source.width = 2;
    source.pixels.emplace_back();  // nothing: black
    const ImportedDeep image = frame_of(source);
    ASSERT_EQ(image.preview.size(), 2u);
    EXPECT_EQ(image.preview[0], glm::dvec3(.125 + .25 * .25, 0, 0)) << "what lies behind the opaque sample is hidden";
    EXPECT_EQ(image.preview[1], glm::dvec3(0));
}

TEST(DeepPreview, TakesTheMeanOfPixelsWhereTheImageIsLarge) {
    // 321 pixels wide: a thumbnail of 160 would need parts of pixels, so that 3 x 3 become one.
    DeepSource source{.channels = {"R", "A", "Z"}, .width = 321, .height = 7};
    for (std::uint32_t i = 0; i < source.width * source.height; ++i) source.pixels.push_back({{float(i % 3), 1, 1}});
    source.pixels[0][0][0] = 9;
    const ImportedDeep image = frame_of(source);
    ASSERT_EQ(image.preview.size(), 107u * 2) << "the seventh line is left over";
    EXPECT_DOUBLE_EQ(image.preview[0].x, 1 + 9. / 9) << "0, 1 and 2 thrice, and 9 in place of a 0";
    for (std::size_t i = 1; i < image.preview.size(); ++i) EXPECT_DOUBLE_EQ(image.preview[i].x, 1);
}

TEST(DeepPreview, IsAsBrightWhereTheImageIsThinnerThanATexel) {
    DeepSource source{.channels = {"R", "A", "Z"}, .width = 2000, .height = 1};
    source.pixels.assign(source.width, {{.5f, 1, 1}});
    for (const glm::dvec3& texel : frame_of(source).preview) EXPECT_NEAR(texel.x, .5, 1e-12);
}

}  // namespace
}  // namespace strata
