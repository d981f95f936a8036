// Tiles by the waves of the shader that shades them, joined by hand: two modes, one of which a SIMD holds 3 waves of, one 10.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/technique.h"
#include "replay/isa/isa_report.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

Technique technique_with_variants() {
    return {.stage = Stage::lighting,
            .name = "lighting/some",
            .abilities = {.variants = ShaderVariants{.constant = "mode", .view = "numbers", .table = "modes"}}};
}

const GpuModel& bonaire() { return **find_gpu_model("bonaire"); }

HostImage numbers_of(std::initializer_list<float> numbers) {
    HostImage image{{.extent = {static_cast<std::uint32_t>(numbers.size()), 1, 1}, .format = Format::rgba32f}, {}};
    for (const float number : numbers)
        for (const float channel : {number, number, number, 1.f}) {
            const auto bytes = std::as_bytes(std::span(&channel, 1));
            image.texels.insert(image.texels.end(), bytes.begin(), bytes.end());
        }
    return image;
}

struct Joined {
    Technique technique = technique_with_variants();
    strata::Run run;
    IsaOfGpu gpu{.name = "bonaire", .model = &bonaire()};
    PipelineRequests requests;

    /// Mode 5 needs 84 registers, mode 2 needs 24; a shader of another technique has a constant of that name, too.
    Joined() {
        add(Stage::transparency, "transparency/other", 5, 256);
        add(Stage::lighting, "lighting/some", 5, 84);
        add(Stage::lighting, "lighting/some", 2, 24);
        run.images.emplace("lighting/some:numbers", numbers_of({5, 5, 2, -1, 5}));
        run.tables["lighting/some:modes"] = {.columns = {{"mode", ""}, {"features", "bits"}, {"tiles", ""}},
                                             .rows = {{2, 0x20, 1}, {5, 0xffff, 3}}};
    }
    void add(Stage stage, const char* other, std::uint32_t mode, std::uint32_t registers) {
        const std::size_t pipeline = requests.pipelines.size();
        PipelineRequest& request = requests.pipelines.emplace_back();
        request.step.step.fixed = {{"mode", mode}};
        gpu.steps.push_back({.scope = {ScopeKind::pass, stage, stage, other}, .pipeline = pipeline});
        const ShaderResources taken{.registers = registers, .group_threads = 256, .wave_lanes = 64};
        gpu.programs.push_back(
            {.pipeline = pipeline, .stage = "compute", .registers = registers, .occupancy = occupancy(bonaire(), taken)});
    }
    Result<TileWaves> waves() const { return waves_of_tiles({technique, run, gpu, requests}); }
};

TEST(TileWaves, ArePixelByPixelThoseOfTheModeAndNoneWhereNothingIsShaded) {
    const auto made = Joined().waves();
    ASSERT_TRUE(made) << made.error().sentence;
    ASSERT_EQ(made->picture.shape.format, Format::r32f);
    const double expected[] = {3, 3, 10, 0, 3};
    for (std::uint32_t x = 0; x < 5; ++x) EXPECT_EQ(texel(made->picture, x, 0).x, expected[x]) << x;
}

TEST(TileWaves, AreAveragedOverTheTilesThatAnythingShades) {
    const auto made = Joined().waves();
    ASSERT_TRUE(made);
    EXPECT_EQ(made->tiles, 4u);
    EXPECT_DOUBLE_EQ(made->mean, (3 * 3 + 1 * 10) / 4.);
    ASSERT_EQ(made->variants.size(), 2u);
    EXPECT_EQ(made->variants[1].occupancy.limit, OccupancyLimit::registers);
    EXPECT_EQ(made->variants[0].occupancy.limit, OccupancyLimit::wave_slots);
}

TEST(TileWaves, AreNotMadeUpWhereTheCompilerSaysNothingOfAMode) {
    Joined joined;
    joined.gpu.programs.back().occupancy.reset();
    const auto made = joined.waves();
    ASSERT_THAT(made, FailsWith("isa.no_occupancy", Field("gpu", "bonaire"), Field("constant", "mode"), Field("variant", 2)));
    EXPECT_EQ(made.error().fault, Fault::device_lacks);
}

TEST(TileWaves, OfAFrameWithoutTheStageSayWhy) {
    Joined joined;
    joined.run.skipped.push_back({Stage::lighting, "the frame has no lights"});
    EXPECT_THAT(joined.waves(), FailsWith("isa.no_shaded_tile", Field("technique", "lighting/some"),
                                          Field("reason", joined.run.skipped.back().reason)));
    Joined empty;
    for (std::vector<double>& row : empty.run.tables["lighting/some:modes"].rows) row.back() = 0;
    EXPECT_THAT(empty.waves(), FailsWith("isa.no_shaded_tile", Field("reason", testing::HasSubstr("opaque"))));
}

TEST(TileWaves, AreDrawnInColorsThatTheLegendHasToo) {
    const auto made = Joined().waves();
    ASSERT_TRUE(made);
    const Canvas canvas = tile_waves_picture(*made, bonaire());
    std::map<std::array<std::uint8_t, 3>, std::size_t> area;
    for (const Rgb& pixel : canvas.pixels()) ++area[{pixel.x, pixel.y, pixel.z}];
    const auto area_of = [&](Rgb color) { return area[{color.x, color.y, color.z}]; };
    const Rgb three = magma(std::log2(4.) / std::log2(11.)), ten = magma(1), nothing = magma(0);
    // One pixel of five is 192 x 192 here; the swatches come on top.
    constexpr std::size_t pixel = 192 * 192;
    EXPECT_GT(area_of(three), 3 * pixel);
    EXPECT_GT(area_of(ten), pixel);
    EXPECT_EQ(area_of(three) - 3 * pixel, area_of(ten) - pixel) << "swatches of one size";
    EXPECT_EQ(area_of(nothing) - pixel, area_of(ten) - pixel) << "one for what is not shaded, too";
    TileWaves narrow = *made;
    narrow.picture = {{.extent = {2, 300, 1}, .format = Format::r32f}, std::vector<std::byte>(2 * 300 * sizeof(float))};
    EXPECT_LT(tile_waves_picture(narrow, bonaire()).height(), 1400) << "two pixels wide are not 480 times enlarged";
}

TEST(TileWaves, OfAReportAreInItsTextAndItsJson) {
    IsaReport report{.capture = "some.strata"};
    Joined joined;
    joined.gpu.tiles = *joined.waves();
    report.gpus.push_back(joined.gpu);
    const std::string text = as_text(report), json = as_json(report);
    for (const char* part : {"lighting/some: 4.75 waves per SIMD, the mean over 4 shaded tiles", "mode 5", "0xffff", "75.0"})
        EXPECT_NE(text.find(part), text.npos) << part << "\n" << text;
    for (const char* part : {R"("mean_waves_per_simd": 4.75)", R"("features": 65535)", R"("vector_registers": 84)"})
        EXPECT_NE(json.find(part), json.npos) << part << "\n" << json;
}

}  // namespace
}  // namespace strata
