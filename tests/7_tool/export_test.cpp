// strata export and import --deep: one file of one kind per call, whole, and the same for equal runs.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <set>
#include <span>

#include <flatbuffers/idl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/codec/decode_frame.h"
#include "capture_format/codec/frame_json.h"
#include "capture_format/container/container.h"
#include "capture_format/frame.h"
#include "capture_format/reader.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/difference/picture.h"
#include "replay/images/image_io.h"
#include "tests/7_tool/process.h"
#include "tests/support/deep_exr.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string contents_of(const std::string& name) { return file_text(folder() / name); }

TEST(Export, WantsExactlyOneKind) {
    ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0);
    EXPECT_THAT(strata("-v export panes.strata -o x"),
                Refuses(2, "options.missing", "option=\"--deep, --image, --gltf, --json\""));
    EXPECT_THAT(strata("-v export panes.strata --deep --json -o x"),
                Refuses(2, "options.excluded", "option=--deep other=--json"));
    EXPECT_EQ(strata("export panes.strata --json").code, 2) << "without -o";
    EXPECT_EQ(strata("export panes.strata --json --frame 9 -o x").code, 2);
    EXPECT_EQ(strata("export nowhere.strata --json -o x").code, 3);
    EXPECT_FALSE(std::filesystem::exists(folder() / "x"));
}

TEST(Export, WritesADeepImageThatComesBackAsTheSameFragments) {
    ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0);
    const Finished exported = strata("export panes.strata --deep -o panes.exr");
    ASSERT_EQ(exported.code, 0) << exported.err;
    EXPECT_THAT(exported.err, HasSubstr("exported 1801 fragments; flattened again, the radiance of every pixel is within"));
    const Finished imported = strata_after("export VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent",
                                           "import --deep panes.exr -o again.strata");
    ASSERT_EQ(imported.code, 0) << "without a device: " << imported.err;
    EXPECT_GT(Capture::open(folder() / "again.strata")->thumbnail().width, 0u);
    EXPECT_THAT(imported.err, HasSubstr("imported 1801 samples of panes.exr as 1801 fragments"));
    ASSERT_EQ(strata("export again.strata --deep -o again.exr").code, 0);
    EXPECT_EQ(openexr_composite(folder() / "again.exr").texels, openexr_composite(folder() / "panes.exr").texels);
    ASSERT_EQ(strata("export panes.strata --deep -o equal.exr").code, 0);
    EXPECT_EQ(contents_of("equal.exr"), contents_of("panes.exr"));
}

TEST(Export, RefusesGlassAndSamplesThatADeepImageCannotHoldUntilToldHow) {
    ASSERT_EQ(strata("record red_and_green_glass --samples 4 -o glass.strata").code, 0);
    EXPECT_THAT(strata("-v export glass.strata --deep -o glass.exr"), Refuses(2, "export.choose_sample", "samples=4"));
    EXPECT_THAT(strata("-v export glass.strata --deep --sample 2 -o glass.exr"), Refuses(2, "deep.chromatic"));
    EXPECT_FALSE(std::filesystem::exists(folder() / "glass.exr"));
    EXPECT_EQ(strata("export glass.strata --deep --sample 2 --transmittance mean -o glass.exr").code, 0);
    EXPECT_EQ(strata("export glass.strata --deep --sample 4 -o glass.exr").code, 2);
}

std::filesystem::path only_named(const std::string& in, const std::string& end) {
    std::filesystem::path found;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / in))
        if (entry.path().filename().string().ends_with(end)) {
            EXPECT_EQ(found, "") << entry.path();
            found = entry.path();
        }
    return found;
}

TEST(Export, WritesImagesAndViewsByTheirNames) {
    ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0);
    ASSERT_EQ(strata("export panes.strata --image color,display -o both.exr").code, 0);
    EXPECT_EQ(must(read_exr(folder() / "both.exr")).size(), 2u);
    EXPECT_EQ(strata("export panes.strata --image transparency/sorted_lists:layers -o layers.png").code, 0);
    EXPECT_THAT(contents_of("layers.png"), testing::StartsWith("\x89PNG"));
    EXPECT_EQ(strata("export panes.strata --image depth_layers -o depth.png").code, 0);
    // The panes have no edges; the others are written.
    EXPECT_EQ(strata("replay panes.strata --outputs display,edges,transparency/sorted_lists:layers -o out").code, 2);
    const HostImage display = must(read_png(only_named("out", "f0000.png")));
    const HostImage layers = must(read_png(only_named("out", "transparency-sorted_lists-layers.png")));
    EXPECT_EQ(display.shape.extent.width, 64u) << "the picture, as it is";
    EXPECT_GE(layers.shape.extent.width, 480u) << "under a title, over a legend";
    const Finished plain = strata("export panes.strata --image color -o color.png");
    EXPECT_THAT(plain.err,
                testing::ContainsRegex("in color.png 0 W/.m.2 sr. is black, [0-9.]+ W/.m.2 sr. white; an .exr has the values"));
    EXPECT_EQ(must(read_png(folder() / "color.png")).shape.extent, display.shape.extent) << "texels and no words";
    ASSERT_EQ(strata("export panes.strata --image color --caption -o color.png").code, 0);
    EXPECT_GE(must(read_png(folder() / "color.png")).shape.extent.width, 480u);
    EXPECT_EQ(strata("export panes.strata --image color,display -o both.png").code, 2);
    EXPECT_EQ(strata("export panes.strata --image color -o color.jpg").code, 2);
    EXPECT_THAT(strata("-v export panes.strata --image colr -o color.exr"),
                Refuses(2, "frame.unknown_image", "image=colr suggestion=\"; did you mean color?\""));
}

/// A square map in a picture that is not square.
TEST(Export, ShowsARainMapWithSquareTexels) {
    ASSERT_EQ(strata("record roof_in_rain --size 64x36 -o roof.strata").code, 0);
    ASSERT_EQ(strata("export roof.strata --image 'rain/wetness:rain map' -o map.exr").code, 0);
    const HostImage map = must(read_exr(folder() / "map.exr")).begin()->second;
    ASSERT_EQ(map.shape.extent, (Extent{64, 36, 1}));
    std::uint32_t drawn = 0;
    for (std::uint32_t y = 0; y < 36; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
            const bool inside = x >= 14 && x < 50;
            if (texel(map, x, y).x > 0) ++drawn;
            EXPECT_TRUE(inside || texel(map, x, y).x == 0) << x << " " << y;
        }
    EXPECT_GT(drawn, 20u);
}

/// Reads its own picture back: the swatches and the bar are where the legend says.
TEST(OutputPictures, ListTheColorsThatAreSeenAndScaleToTheValues) {
    HostImage image{{.extent = {8, 8, 1}, .format = Format::rgba32f}, std::vector<std::byte>(8 * 8 * sizeof(glm::vec4))};
    const auto set = [&](std::size_t texel, const glm::vec4& value) {
        std::memcpy(image.texels.data() + texel * sizeof value, &value, sizeof value);
    };
    for (std::size_t i = 0; i < 64; ++i) set(i, i < 32 ? glm::vec4(.25f, 1, .25f, 1) : glm::vec4(0, 0, 0, 1));
    const ImageLegend modes{.low = 0, .colors = {{{64, 255, 64}, "mode 1"}, {{255, 64, 64}, "mode 2"}, {{0, 0, 0}, "nothing"}}};
    const ImageLegend two{.low = 0, .colors = {{{64, 255, 64}, "mode 1"}, {{0, 0, 0}, "nothing"}}};
    EXPECT_EQ(image_picture("a:b", image, "title", modes).pixels(), image_picture("a:b", image, "title", two).pixels());
    for (std::size_t i = 0; i < 64; ++i) set(i, glm::vec4(i == 63 ? 200.f : 100.f));
    const Canvas layers = image_picture("a:b", image, "title", {.low = 0, .unit = "fragments"});
    const auto at = [&](int x, int y) { return layers.pixels()[static_cast<std::size_t>(y * layers.width() + x)]; };
    EXPECT_EQ(at(20, 100), Rgb(128, 128, 128)) << "half of the largest value, linear";
    const auto lines_of = [](const std::string& title) { return wrapped(title, 200).size(); };
    EXPECT_EQ(lines_of("short"), 1u);
    EXPECT_GT(lines_of("several words that do not fit into two hundred pixels"), 1u);
    EXPECT_GT(lines_of(std::string(60, 'x')), 1u);
    EXPECT_THAT(shortened(std::string(60, 'x'), 200), testing::EndsWith("x..."));
    EXPECT_LE(text_width(shortened(std::string(60, 'x'), 200)), 200);
}

/// A view of 8 x 8 pixels whose value is everywhere the same.
HostImage even(float value) {
    HostImage image{{.extent = {8, 8, 1}, .format = Format::rgba32f}, {}};
    const auto bytes = std::as_bytes(std::span(&value, 1));
    for (int i = 0; i < 8 * 8 * 4; ++i) image.texels.insert(image.texels.end(), bytes.begin(), bytes.end());
    return image;
}

/// Two legends that differ in their last word alone are two pictures.
TEST(OutputPictures, BreakLongSentencesInsteadOfCuttingThem) {
    const std::string text = "no blocker is near the macro-cell of a visible surface in this ";
    const auto said_of_zeros = [&](const std::string& end) {
        return image_picture("a:b", even(0), "title", {.low = 0, .if_zero = text + end}).pixels();
    };
    EXPECT_NE(said_of_zeros("frame"), said_of_zeros("scene"));
    const auto said_of_red = [&](const std::string& end) {
        return image_picture("a:b", even(1), "title", {.low = 0, .channels = {{{255, 0, 0}, text + end}}}).pixels();
    };
    EXPECT_NE(said_of_red("frame"), said_of_red("scene"));
    EXPECT_EQ(image_picture("a:b", even(1388), "title", {.low = 0, .if_zero = text}).pixels(),
              image_picture("a:b", even(1388), "title", {.low = 0}).pixels());
}

/// An occlusion image that is open everywhere was black.
TEST(OutputPictures, OfOneValueEverywhereAreWhiteAboveZeroAndBlackAtIt) {
    const auto middle_of = [](float value) {
        const Canvas canvas = image_picture("occlusion", even(value), "title", {});
        return canvas.pixels()[static_cast<std::size_t>(100 * canvas.width() + canvas.width() / 2)];
    };
    EXPECT_EQ(middle_of(1), Rgb(255, 255, 255));
    EXPECT_EQ(middle_of(.25f), Rgb(255, 255, 255)) << "the scale ends there";
    EXPECT_EQ(middle_of(0), Rgb(0, 0, 0));
    EXPECT_EQ(middle_of(-1), Rgb(0, 0, 0));
}

TEST(OutputPictures, ColorANumberBySignWhereItHasOne) {
    const auto middle_of = [](float value) {
        const Canvas canvas = image_picture("a:b", even(value), "title", {.low = -16, .middle = 0});
        return canvas.pixels()[static_cast<std::size_t>(100 * canvas.width() + canvas.width() / 2)];
    };
    EXPECT_EQ(middle_of(3), Rgb(255, 89, 0));
    EXPECT_EQ(middle_of(-3), Rgb(0, 115, 255));
    EXPECT_EQ(middle_of(0), Rgb(0, 0, 0));
}

/// The view `class` is of one light, the view `pyramid` of one level: which, was said only where it was not the default.
TEST(OutputPictures, NameTheParametersThatTheViewDependsOn) {
    ASSERT_EQ(strata("record spot_and_box --size 64x36 -o spot.strata").code, 0);
    const std::string class_of = "export spot.strata --use shadows/min_max --image shadows/min_max:class --caption ";
    ASSERT_EQ(strata(class_of + "-o default.png").code, 0);
    ASSERT_EQ(strata(class_of + "--set class_light=9 -o other.png").code, 0) << "the last light: there is one";
    const HostImage named = must(read_png(folder() / "default.png")), other = must(read_png(folder() / "other.png"));
    EXPECT_EQ(named.shape.extent, other.shape.extent) << "as many lines of title";
    EXPECT_NE(named.texels, other.texels) << "class_light=0, class_light=9";
}

/// Outlines of two kinds on one pixel have a color of their own, which the legend has.
TEST(OutputPictures, NameTheColorsOfCrossingBounds) {
    ASSERT_EQ(strata("record city_of_boxes --size 96x54 -o city.strata").code, 0);
    ASSERT_EQ(strata("export city.strata --use hiz_two_phase --image culling/hiz_two_phase:bounds -o bounds.exr").code, 0);
    const auto views = must(find_technique("culling/hiz_two_phase"))->views;
    const auto view = std::ranges::find(views, "bounds", &DebugView::name);
    ASSERT_NE(view, views.end());
    std::set<std::string> seen;
    for (const glm::dvec4& texel : in_double(must(read_exr(folder() / "bounds.exr")).begin()->second).texels) {
        const auto color = std::ranges::find(view->colors, glm::vec3(texel), &ViewColor::color);
        ASSERT_NE(color, view->colors.end()) << texel.x << " " << texel.y << " " << texel.z;
        seen.insert(color->meaning);
    }
    EXPECT_TRUE(seen.contains("red and green on one pixel"));
}

/// One formula gives the colors to the shader and to the legend.
TEST(OutputPictures, NameEveryModeThatTilesAreShadedBy) {
    ASSERT_EQ(strata("record agents_hq --size 96x54 -o hq.strata").code, 0);
    ASSERT_EQ(strata("export hq.strata --use tiled --image 'lighting/tiled:tile modes' -o modes.exr").code, 0);
    const auto views = must(find_technique("lighting/tiled"))->views;
    const auto view = std::ranges::find(views, "tile modes", &DebugView::name);
    ASSERT_NE(view, views.end());
    const ReferenceImage modes = in_double(must(read_exr(folder() / "modes.exr")).begin()->second);
    std::set<std::string> seen;
    for (const glm::dvec4& texel : modes.texels) {
        const auto is_it = [&](const ViewColor& c) { return glm::distance(glm::dvec3(c.color), glm::dvec3(texel)) < 1e-3; };
        const auto color = std::ranges::find_if(view->colors, is_it);
        ASSERT_NE(color, view->colors.end()) << texel.x << " " << texel.y << " " << texel.z;
        seen.insert(color->meaning);
    }
    EXPECT_GE(seen.size(), 3u);
}

TEST(Export, WritesTheFrameAsJsonThatTheSchemaReadsBackBitForBit) {
    ASSERT_EQ(strata("record glass_and_smoke -o room.strata").code, 0);
    const Finished exported = strata("export room.strata --json -o room.json");
    ASSERT_EQ(exported.code, 0) << exported.err;
    const std::string text = contents_of("room.json");
    EXPECT_EQ(json::parse(text)["view"]["samples"], 1);
    flatbuffers::Parser parser;
    ASSERT_TRUE(parser.Parse(file_text(STRATA_SOURCE_DIR "/capture_format/schema/capture.fbs").c_str())) << parser.error_;
    ASSERT_TRUE(parser.Parse(text.c_str())) << parser.error_;
    // Read by flatbuffers' own parser into the frame that was recorded, which gives the same text: no digit was lost.
    const std::span parsed(parser.builder_.GetBufferPointer(), parser.builder_.GetSize());
    const Container container = must(Container::open(folder() / "room.strata"));
    MemoryBudget budget;
    BlobStore blobs = must(BlobStore::open(container, budget));
    EXPECT_EQ(must(frame_json(must(decode_frame(std::as_bytes(parsed), blobs, budget)))), text);
}

TEST(Export, WritesTheSceneAsGltfThatImportReads) {
    ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0);
    ASSERT_EQ(strata("export panes.strata --gltf -o panes.glb").code, 0);
    EXPECT_EQ(strata("import panes.glb -o again.strata --size 64x36").code, 0);
}

TEST(ImportDeep, ADamagedImageIsExitThreeAndLeavesNothing) {
    std::ofstream(folder() / "broken.exr") << "v/1\x01, but no picture";
    EXPECT_EQ(strata("import --deep broken.exr -o broken.strata").code, 3);
    EXPECT_EQ(strata("import --deep nowhere.exr -o broken.strata").code, 3);
    EXPECT_FALSE(std::filesystem::exists(folder() / "broken.strata"));
}

}  // namespace
}  // namespace strata
