// strata isa --tiles: every tile of a frame by the waves per SIMD of the mode that shades it.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/images/image_io.h"
#include "tests/7_tool/process.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;

constexpr std::uint32_t tile = 16;

void record_room() { ASSERT_EQ(strata("record lights_room -o room.strata --size 80x48").code, 0); }

json with_tiles(const std::string& arguments) {
    const Finished made = strata("isa room.strata --gpu-model bonaire --json " + arguments);
    EXPECT_EQ(made.code, 0) << made.err;
    return made.code == 0 ? json::parse(made.out)["gpus"][0] : json();
}

HostImage only_image(const std::string& file) { return must(read_exr(folder() / file)).begin()->second; }

/// What the compiler's report says of the pipeline of a mode, by the constants in its label.
double waves_of_mode(const json& gpu, std::uint64_t number) {
    for (const json& program : gpu["programs"]) {
        const std::string label = program["label"].get<std::string>() + " ";
        if (label.find(fmt::format(" mode={} ", number)) != label.npos && label.find(" mode_features=") != label.npos)
            return program["occupancy"]["waves_per_simd"];
    }
    ADD_FAILURE() << "no pipeline of mode " << number;
    return 0;
}

TEST(IsaTiles, ArePaintedWithTheWavesOfTheModeThatShadesThem) {
    record_room();
    const std::string modes = "--set modes=3 --set mode_0=65535 --set mode_1=64 --set mode_2=2943 ";
    const json gpu = with_tiles(modes + "--tiles tiles.exr");
    const std::string technique = gpu["tiles"]["technique"];
    ASSERT_EQ(
        strata("export room.strata --use " + technique + " " + modes + "--image '" + technique + ":mode numbers' -o numbers.exr")
            .code,
        0);
    const HostImage waves = only_image("tiles.exr"), numbers = only_image("numbers.exr");
    ASSERT_EQ(waves.shape.extent, numbers.shape.extent);
    std::map<std::uint64_t, std::uint64_t> tiles;
    for (std::uint32_t y = 0; y < waves.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < waves.shape.extent.width; ++x) {
            const double number = texel(numbers, x, y).x;
            ASSERT_GE(number, 0) << "all of the room is shaded";
            const auto mode = static_cast<std::uint64_t>(number);
            ASSERT_EQ(texel(waves, x, y).x, waves_of_mode(gpu, mode)) << x << " " << y;
            tiles[mode] += x % tile == 0 && y % tile == 0;
        }
    EXPECT_GE(tiles.size(), 2u) << "one mode shades all: nothing was told apart";
    double sum = 0;
    std::set<double> different;
    for (const json& variant : gpu["tiles"]["variants"]) {
        EXPECT_EQ(variant["tiles"], tiles[variant["mode"]]) << variant;
        EXPECT_EQ(variant["occupancy"]["waves_per_simd"], waves_of_mode(gpu, variant["mode"]));
        different.insert(variant["occupancy"]["waves_per_simd"].get<double>());
        sum += variant["tiles"].get<double>() * variant["occupancy"]["waves_per_simd"].get<double>();
    }
    EXPECT_GE(different.size(), 2u);
    EXPECT_EQ(gpu["tiles"]["tiles"], 5 * 3);
    EXPECT_NEAR(gpu["tiles"]["mean_waves_per_simd"].get<double>(), sum / 15, 1e-12);
}

TEST(IsaTiles, AverageToWhatTheSearchForModesPredicted) {
    record_room();
    const Finished made = strata("spectra room.strata --modes 4 --gpu-model bonaire --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json spectra = json::parse(made.out);
    std::string settings;
    for (const json& setting : spectra["settings"]) settings += " --set " + setting.get<std::string>();
    const json tiles = with_tiles("--tiles tiles.png" + settings)["tiles"];
    EXPECT_DOUBLE_EQ(tiles["mean_waves_per_simd"].get<double>(), spectra["mean_waves_per_simd"].get<double>());
    std::size_t shading = 0;
    for (const json& mode : spectra["modes"]) shading += mode["tiles"].get<std::uint64_t>() > 0;
    EXPECT_EQ(tiles["variants"].size(), shading) << "what shades no tile is not compiled";
    const HostImage picture = must(read_png(folder() / "tiles.png"));
    EXPECT_GT(picture.shape.extent.width, 12 * 80u) << "enlarged, with a margin";
    EXPECT_GT(picture.shape.extent.height, 12 * 48u) << "and a legend";
}

TEST(IsaTiles, ThatCannotBeShownAreRefusedWithASentence) {
    record_room();
    ASSERT_EQ(strata("record one_pane -o pane.strata").code, 0);
    const Refusal wrongs[] = {
        {"pane.strata --gpu-model bonaire --tiles t.png", 2, "isa.no_shaded_tile", ""},
        {"room.strata --gpu-model bonaire --tiles t.jpg", 2, "output.unknown_ending", "file=t.jpg"},
        {"room.strata --gpu-model bonaire,navi21 --tiles t.png", 2, "isa.tiles_of_one_gpu", "gpus=2"},
        {"room.strata --gpu-model bonaire --tiles t.png --no-run", 2, "options.excluded", "--no-run"},
        {"room.strata --gpu-model bonaire --tiles t.png --use lighting/brute_force", 2, "technique.is_unable",
         "technique=lighting/brute_force"},
        {"room.strata --gpu-model bonaire --tiles nowhere/t.png", 2, "file.cannot_write", "file=nowhere/t.png"},
    };
    expect_refusals("isa", wrongs);
}

}  // namespace
}  // namespace strata
