// Deep images out of a frame and back into one: OpenEXR's compositing, oiiotool's and our own give our truth.
#include <cstdlib>
#include <map>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/import/deep.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/transparency/truth.h"
#include "replay/deep/deep_image.h"
#include "replay/deep/flatten_deep.h"
#include "replay/session/loaded_frame.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/agreement.h"
#include "tests/support/deep_exr.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// A scenario's fragments in front of its replayed depth, and what lies behind and comes out.
struct ReplayedFragments {
    Frame frame;
    FragmentLists lists{0, 0, 1};
    ReferenceImage depth, behind, truth;

    explicit ReplayedFragments(std::string_view scenario, std::uint32_t samples = 1) {
        Request request = on_scenario(scenario, samples);
        Session& session = session_of_scenarios();
        frame = must(load_frame(must(session.frame(request.variant.frame)), request.variant))->frame;
        truth = must(session.truth(request, Stage::transparency)).at("color");
        depth = ReferenceImage(truth.width, truth.height, truth.layers);
        for (const PassImages& pass : must(session.pass_images(request))) {
            if (pass.label == "combine") behind = in_double(pass.images.at("color"));
            if (const auto found = pass.images.find("depth_layers"); found != pass.images.end()) depth = in_double(found->second);
        }
        lists = transparent_fragments(frame, depth);
    }

    std::string exported(Transmittance transmittance = Transmittance::refused, std::uint32_t sample = 0) const {
        return must(deep_exr(must(deep_image(FragmentRows(frame, depth), sample, transmittance, frame)), {}));
    }
};

/// With one sample; replayed once per program, however many tests look at it.
const ReplayedFragments& replayed_once(const std::string& scenario) {
    static std::map<std::string, ReplayedFragments> known;
    return known.try_emplace(scenario, scenario).first->second;
}

/// Holds an image of premultiplied RGBA over what is behind against the truth. Relative to the larger of 1 and the truth: sums
/// of dozens of floats, and an alpha in float that dims what is behind.
template <typename Texel>
void expect_truth(const ReplayedFragments& replayed, const Texel& flattened, std::uint32_t sample = 0) {
    for (std::uint32_t y = 0; y < replayed.truth.height; ++y)
        for (std::uint32_t x = 0; x < replayed.truth.width; ++x) {
            const glm::dvec4 over = flattened(x, y), &wanted = replayed.truth.at(x, y, sample);
            for (int c = 0; c < 3; ++c) {
                const double got = over[c] + (1 - over.w) * replayed.behind.at(x, y, sample)[c];
                ASSERT_NEAR(got, wanted[c], 1e-5 * std::max(1., std::abs(wanted[c]))) << x << ", " << y << " channel " << c;
            }
        }
}

class DeepExport : public testing::TestWithParam<const char*> {};

TEST_P(DeepExport, IsFlattenedToTheTruthByOpenExrAndByUs) {
    const ReplayedFragments& replayed = replayed_once(GetParam());
    ASSERT_GT(replayed.lists.total(), 100u);
    const TemporaryFile file("deep.exr");
    const std::string exr = replayed.exported();
    write_file(file.path(), bytes_of(exr));
    const std::vector<glm::vec4> theirs = openexr_composite(file.path()).texels;
    const FlatDeep ours = must(flatten_deep(bytes_of(exr), "exported"));
    expect_truth(replayed, [&](std::uint32_t x, std::uint32_t y) { return glm::dvec4(theirs[y * replayed.truth.width + x]); });
    expect_truth(replayed, [&](std::uint32_t x, std::uint32_t y) { return texel(ours.image, x, y); });
}

TEST_P(DeepExport, IsFlattenedToTheTruthByOiiotoolWhereItIsInstalled) {
    if (std::system("oiiotool --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "oiiotool is not installed";
    const ReplayedFragments& replayed = replayed_once(GetParam());
    const TemporaryFile deep("deep.exr"), flat("flat.exr");
    write_file(deep.path(), bytes_of(replayed.exported()));
    const std::string command =
        fmt::format("oiiotool '{}' --flatten --ch R,G,B,A -d float -o '{}'", deep.path().string(), flat.path().string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto images = must(read_exr(flat.path()));
    ASSERT_EQ(images.size(), 1u);
    expect_truth(replayed, [&](std::uint32_t x, std::uint32_t y) { return texel(images.begin()->second, x, y); });
}

TEST_P(DeepExport, ComesBackAsAFrameWithTheSameTruth) {
    const ReplayedFragments& replayed = replayed_once(GetParam());
    const ImportedDeep back = must(import_deep(bytes_of(replayed.exported()), "exported", {}));
    EXPECT_EQ(back.census.samples, replayed.lists.total());
    EXPECT_EQ(back.census.unsorted_pixels, 0u);
    const FragmentLists lists =
        transparent_fragments(back.frame, ReferenceImage(replayed.lists.width(), replayed.lists.height()));
    for (std::uint32_t y = 0; y < lists.height(); ++y)
        for (std::uint32_t x = 0; x < lists.width(); ++x) {
            const glm::dvec3 wanted = exact_blend(replayed.lists.at(x, y), glm::dvec3(.5));
            const glm::dvec3 got = exact_blend(lists.at(x, y), glm::dvec3(.5));
            // Every value was rounded to a float once.
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(got[c], wanted[c], 1e-6 * std::max(1., wanted[c])) << x << ", " << y;
        }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, DeepExport,
                         testing::Values("smoke_grenade", "three_panes", "additive_sparks", "coincident_panes", "foggy_panes"),
                         [](const auto& scenario) { return std::string(scenario.param); });

TEST(DeepExportOfGlass, IsRefusedWithTheDrawThatHasMostOfIt) {
    const ReplayedFragments& replayed = replayed_once("red_and_green_glass");
    const auto refused = deep_image(FragmentRows(replayed.frame, replayed.depth), 0, Transmittance::refused, replayed.frame);
    ASSERT_THAT(refused, FailsWith("deep.chromatic", Field("draw", testing::ContainsRegex("^draw [0-9]+ '"))));
    EXPECT_EQ(refused.error().fault, Fault::usage);
    EXPECT_THAT(refused.error().sentence, testing::HasSubstr("--transmittance"));
}

TEST(DeepExportOfGlass, KeepsItsColorsInChannelsOfTheirOwn) {
    const ReplayedFragments& replayed = replayed_once("red_and_green_glass");
    const ImportedDeep back = must(import_deep(bytes_of(replayed.exported(Transmittance::channels)), "glass", {}));
    const FragmentLists lists =
        transparent_fragments(back.frame, ReferenceImage(replayed.lists.width(), replayed.lists.height()));
    for (std::uint32_t y = 0; y < lists.height(); ++y)
        for (std::uint32_t x = 0; x < lists.width(); ++x) {
            const glm::dvec3 off =
                exact_blend(lists.at(x, y), glm::dvec3(1)) - exact_blend(replayed.lists.at(x, y), glm::dvec3(1));
            ASSERT_LT(glm::length(off), 1e-6) << x << ", " << y;
        }
}

TEST(DeepExportOfGlass, TakesTheMeanByChoice) {
    const ReplayedFragments& replayed = replayed_once("red_and_green_glass");
    const ImportedDeep back = must(import_deep(bytes_of(replayed.exported(Transmittance::mean)), "glass", {}));
    EXPECT_EQ(back.frame.draws.size(), 1u);
    EXPECT_EQ(back.census.fragments, replayed.lists.total());
}

TEST(DeepExportOfSamples, TakesTheOneAskedFor) {
    const ReplayedFragments replayed("three_panes", 4);
    for (const std::uint32_t sample : {0u, 3u}) {
        const FlatDeep flat = must(flatten_deep(bytes_of(replayed.exported(Transmittance::refused, sample)), "sample"));
        expect_truth(
            replayed, [&](std::uint32_t x, std::uint32_t y) { return texel(flat.image, x, y); }, sample);
    }
}

TEST(DeepExportTwice, GivesEqualFiles) {
    const ReplayedFragments& replayed = replayed_once("three_panes");
    EXPECT_EQ(replayed.exported(), replayed.exported());
}

/// Pixels with up to 12 samples, unsorted, some of them volumes, one in eight without alpha.
DeepSource wild_image() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    DeepSource source{.channels = {"R", "G", "B", "A", "Z", "ZBack"}, .width = 24, .height = 16};
    for (std::uint32_t i = 0; i < source.width * source.height; ++i) {
        auto& pixel = source.pixels.emplace_back();
        for (auto n = random() % 13; n > 0; --n) {
            const float alpha = random() % 8 == 0 ? 0 : .5f * unit(random), depth = 1 + 20 * unit(random);
            pixel.push_back(
                {alpha * unit(random), .3f * unit(random), 0, alpha, depth, depth + (random() % 3 == 0 ? 4 * unit(random) : 0)});
        }
    }
    return source;
}

TEST(DeepFlattening, GivesWhatTheImportedFrameLooksLike) {
    const std::string file = deep_file(wild_image());
    const ImportedDeep image = must(import_deep(bytes_of(file), "wild", {}));
    ASSERT_GT(image.census.split_pixels, 100u);
    const FlatDeep flat = must(flatten_deep(bytes_of(file), "wild"));
    const FragmentLists lists = transparent_fragments(image.frame, ReferenceImage(24, 16));
    for (std::uint32_t i = 0; i < 24 * 16; ++i) {
        const glm::dvec3 wanted = exact_blend(lists.at(i % 24, i / 24), glm::dvec3(0));
        // The frame holds floats, and drops what is fainter than 1e-5.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(texel(flat.image, i % 24, i / 24)[c], wanted[c], 2e-5) << "pixel " << i;
    }
}

TEST(DeepImportReplayed, IsResolvedByEveryTechniqueWithinItsTolerance) {
    const auto session =
        must(Session::open({must(import_deep(bytes_of(deep_file(wild_image())), "wild", {})).frame}, {.validation = true}));
    for (const Technique* technique : techniques_of(Stage::transparency)) {
        const Request request{.choices = chosen({std::string(technique->name)})};
        const Accuracy accuracy = must(session->judge(request, Stage::transparency));
        EXPECT_GT(accuracy.compared, 300u) << technique->name;
        expect_within_tolerance(accuracy, *technique, request);
        // Exact but for float: sums of a dozen numbers below 1.
        if (technique->abilities.stands_in_for_truth) {
            EXPECT_LT(accuracy.technique_errors.front().value, 1e-6) << technique->name;
        }
    }
}

}  // namespace
}  // namespace strata
