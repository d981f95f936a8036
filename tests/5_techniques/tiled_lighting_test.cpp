// Tiled lighting on the device: whatever is culled, listed, batched, classified and compiled away, the picture is that of a loop
// over all lights to the last bit (docs/algorithms/lighting.md 1.9, 2.10, 3.5 and 7).
#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "tests/5_techniques/light_scenes.h"

namespace strata {
namespace {

const std::string tiled_lighting = "lighting/tiled", brute_force_lighting = "lighting/brute_force";

void expect_same(const Run& a, const Run& b, const std::string& what) {
    EXPECT_EQ(differing_texels(a, b), 0u) << what;
    EXPECT_GT(lit_texels(b), 20u) << what << ": nothing to compare";
}

TEST(ExhaustiveTiledLighting, IsALoopOverAllLightsInEveryScenario) {
    for (const std::string_view scenario : lit_scenarios())
        for (const std::uint32_t samples : {1u, 4u}) {
            const Frame frame = at_most_96(scenario, samples);
            expect_same(lit(frame, tiled_lighting), lit(frame, brute_force_lighting),
                        fmt::format("{} at {} samples", scenario, samples));
        }
}

TEST(TiledLighting, IsALoopOverAllLightsHoweverManyReachATile) {
    for (const std::string_view scenario : {"hall_of_lights_1", "hall_of_lights_64", "hall_of_lights_65", "hall_of_lights_512",
                                            "hall_of_lights_4096", "agents_hq", "pair_overflow"}) {
        const Frame frame = at_most_96(scenario, 1);
        const auto all = lit(frame, brute_force_lighting), listed = lit(frame, tiled_lighting);
        expect_same(listed, all, std::string(scenario));
        EXPECT_LE(count_of(listed, "evaluations"), count_of(all, "evaluations")) << scenario;
        EXPECT_EQ(count_of(listed, "samples_shaded"), count_of(all, "samples_shaded")) << scenario;
    }
}

TEST(TiledLighting, DoesAnyNumberOfLights) {
    for (const std::size_t n : {1u, 31u, 32u, 33u, 63u, 64u, 65u, 255u, 256u, 257u, 4095u, 4096u}) {
        Frame frame = dark_frame("lights_room");
        RandomLights random(static_cast<unsigned>(n));
        random.add_lights(frame, n, n < 64 ? 20 : 4);
        const auto all = lit(frame, brute_force_lighting);
        for (const char* prefilter : {"prefilter=off", "prefilter=on"})
            expect_same(lit(frame, tiled_lighting, {prefilter}), all, fmt::format("{} lights, {}", n, prefilter));
    }
}

TEST(TiledLighting, DroppingLosesOneOf65LightsAndBatchesLoseNone) {
    Frame frame = dark_frame("lights_room");
    RandomLights random(65);
    Light lamp = random.light(frame, LightType::omni, 1000);
    lamp.intensity = glm::vec3(4);
    frame.lights.assign(65, lamp);
    frame.lights.back().intensity = {0, 64, 0};
    const auto all = lit(frame, brute_force_lighting), batches = lit(frame, tiled_lighting),
               dropped = lit(frame, tiled_lighting, {"overflow=drop"});
    expect_same(batches, all, "batches");
    EXPECT_EQ(count_of(batches, "tiles over lights"), count_of(batches, "tiles") - count_of(batches, "empty tiles"));
    EXPECT_EQ(count_of(dropped, "tiles over lights"), count_of(batches, "tiles over lights"));
    EXPECT_EQ(count_of(dropped, "lights touching") - count_of(dropped, "lights kept"), count_of(dropped, "tiles over lights"));
    frame.lights.pop_back();
    expect_same(dropped, lit(frame, brute_force_lighting), "without the last of 65");
}

TEST(TiledLighting, CountsATileAsFullBeyond64LightsAndNotAt64) {
    Frame frame = dark_frame("lights_room");
    RandomLights random(64);
    const Light lamp = random.light(frame, LightType::omni, 1000);
    for (const std::size_t n : {63u, 64u, 65u}) {
        frame.lights.assign(n, lamp);
        for (const char* set : {"overflow=batch", "overflow=drop"}) {
            const auto run = lit(frame, tiled_lighting, {set});
            const std::uint64_t tiles = count_of(run, "tiles") - count_of(run, "empty tiles");
            ASSERT_GT(tiles, 0u);
            EXPECT_EQ(count_of(run, "tiles over lights"), n > 64 ? tiles : 0) << n << " lights, " << set;
            EXPECT_EQ(count_of(run, "most lights"), n) << set;
        }
    }
}

TEST(TiledLighting, Of4096CoincidentLightsIsThatOfOne) {
    Frame frame = dark_frame("lights_room");
    RandomLights random(7);
    Light lamp = random.light(frame, LightType::omni, 30);
    lamp.intensity = glm::vec3(64);
    frame.lights = {lamp};
    const ReferenceImage one = in_double(lit(frame, tiled_lighting).images.at("light"));
    lamp.intensity /= 4096.f;
    frame.lights.assign(4096, lamp);
    const ReferenceImage many = in_double(lit(frame, tiled_lighting).images.at("light"));
    // 4096 roundings of a float are 2.4e-4, and a half float rounds by 4.9e-4; below 6e-5 it is denormal.
    for (std::size_t i = 0; i < one.texels.size(); ++i)
        EXPECT_NEAR(many.texels[i].x, one.texels[i].x, 1e-3 * one.texels[i].x + 1e-7) << i;
}

Frame blocked_frame(unsigned seed, std::uint32_t samples) {
    Frame frame = dark_frame(seed % 2 == 0 ? "lights_room" : "materials", samples);
    RandomLights random(seed);
    for (std::uint32_t lights = 1 + random.numbers.below(12); lights > 0; --lights)
        random.add_blocked_light(frame, random.numbers.below(3) == 0 ? 32 : 4);
    return frame;
}

TEST(ExhaustiveTiledLighting, OfBlockersIsTheSameWithAndWithoutTheirCulling) {
    std::uint64_t killed = 0, tests_left = 0, tests = 0;
    for (unsigned seed = 1; seed <= 24; ++seed) {
        const Frame frame = blocked_frame(seed, seed % 4 == 0 ? 4 : 1);
        const auto all = lit(frame, tiled_lighting, {"classify=off"}), culled = lit(frame, tiled_lighting, {"classify=on"});
        const auto loop = lit(frame, brute_force_lighting);
        EXPECT_EQ(differing_texels(culled, all), 0u) << seed;
        EXPECT_EQ(differing_texels(culled, loop), 0u) << seed;
        EXPECT_EQ(count_of(all, "lights killed"), 0u);
        killed += count_of(culled, "lights killed");
        tests_left += count_of(culled, "blocker tests"), tests += count_of(all, "blocker tests");
    }
    EXPECT_GT(killed, 0u);
    EXPECT_LT(tests_left, tests / 2);
}

TEST(TiledLighting, WithMorePairsThanFitIsTheSamePicture) {
    const Frame frame = at_most_96("pair_overflow", 1);
    const auto culled = lit(frame, tiled_lighting), all = lit(frame, tiled_lighting, {"classify=off"});
    expect_same(culled, all, "272 pairs");
    EXPECT_GT(count_of(culled, "tiles over blocker pairs"), 0u);
    EXPECT_GT(count_of(culled, "most blocker pairs"), 256u);
}

TEST(ExhaustiveTiledLighting, WithoutPixelTestsDarkensWholeTilesOrNothing) {
    const Frame frame = blocked_frame(3, 1);
    const ReferenceImage pixels = in_double(lit(frame, tiled_lighting).images.at("light"));
    const ReferenceImage tiles = in_double(lit(frame, tiled_lighting, {"blockers=tile_only"}).images.at("light"));
    const ReferenceImage none = in_double(lit(frame, tiled_lighting, {"blockers=off"}).images.at("light"));
    for (std::size_t i = 0; i < none.texels.size(); ++i) {
        EXPECT_LE(pixels.texels[i].x, tiles.texels[i].x) << i;
        EXPECT_LE(tiles.texels[i].x, none.texels[i].x) << i;
    }
}

TEST(ExhaustiveShadingModes, OfAnyNumberGiveTheSamePicture) {
    for (const char* scenario : {"agents_hq", "lights_room", "materials"}) {
        const Frame frame = at_most_96(scenario, 1);
        const auto one = lit(frame, tiled_lighting, {"modes=1"});
        for (const char* set : {"modes=2", "modes=4", "modes=16", "force=65535", "branches=uniform"})
            expect_same(lit(frame, tiled_lighting, {set}), one, fmt::format("{} {}", scenario, set));
    }
}

TEST(ShadingModes, HaveEveryTileThatIsNotEmptyOnce) {
    for (const std::string_view scenario : lit_scenarios()) {
        const auto run = lit(at_most_96(scenario, 1), tiled_lighting, {}, {"modes", "spectra"});
        double in_modes = 0, in_spectra = 0;
        std::uint64_t used = 0;
        for (const auto& row : run.tables.at(tiled_lighting + ":modes").rows) in_modes += row[2], used += row[2] > 0;
        for (const auto& row : run.tables.at(tiled_lighting + ":spectra").rows) in_spectra += row[1];
        EXPECT_EQ(in_modes + double(count_of(run, "empty tiles")), double(count_of(run, "tiles"))) << scenario;
        EXPECT_EQ(in_spectra, in_modes) << scenario;
        EXPECT_EQ(used, count_of(run, "modes used")) << scenario;
        EXPECT_EQ(count_of(run, "tiles unserved"), 0u) << scenario;
    }
}

TEST(ShadingModes, ThatNoTileOfAFrameMayChooseAreNotCompiled) {
    const Frame frame = at_most_96("lights_room", 1);
    const auto run = lit(frame, tiled_lighting);
    EXPECT_EQ(count_of(run, "modes compiled"), 1u) << "mode 2 serves the room's shadows, spots and omni lights";
    EXPECT_EQ(count_of(run, "modes used"), 1u);
    expect_same(run, lit(frame, tiled_lighting, {"modes=1"}), "a mode of all features");
}

TEST(ShadingModes, ThatAreForcedAreThoseOfAllFeatures) {
    const auto run = lit(at_most_96("lights_room", 1), tiled_lighting, {"force=65535"}, {"spectra"});
    const auto& rows = run.tables.at(tiled_lighting + ":spectra").rows;
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0], (std::vector<double>{65535, double(count_of(run, "tiles") - count_of(run, "empty tiles")), 0, 0}));
}

TEST(TiledLighting, OfTheSkyShadesNothing) {
    Frame frame = scenario_frames("lights_room").front();
    frame.view.width = 64, frame.view.height = 36;
    // Away from everything.
    frame.view.to_view = glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)) * frame.view.to_view;
    frame.view.origin += glm::transpose(frame.view.to_view) * glm::dvec3(0, 0, 500);
    const auto run = lit(frame, tiled_lighting);
    EXPECT_EQ(count_of(run, "tiles"), 4u * 3);
    EXPECT_EQ(count_of(run, "empty tiles"), 4u * 3);
    EXPECT_EQ(count_of(run, "modes used"), 0u);
    EXPECT_EQ(count_of(run, "samples_shaded"), 0u);
    EXPECT_EQ(lit_texels(run), 0u);
}

TEST(TiledLighting, IsTheSameOnEveryRun) {
    const Frame frame = at_most_96("agents_hq", 1);
    const std::vector<std::string> inside = {"lists", "portals", "spectra", "modes"};
    const auto first = lit(frame, tiled_lighting, {}, inside);
    session_of_scenarios().forget_memo();
    const auto second = lit(frame, tiled_lighting, {}, inside);
    expect_same(second, first, "again");
    for (const auto& [name, table] : first.tables) EXPECT_EQ(second.tables.at(name).rows, table.rows) << name;
}

TEST(TiledLighting, WithTwoCellsPerTileListsFewerLightsForTheSamePicture) {
    const Frame frame = at_most_96("agents_hq", 1);
    const auto one = lit(frame, tiled_lighting, {"half_z=off"}), two = lit(frame, tiled_lighting, {"half_z=on"});
    expect_same(two, one, "half-Z");
    EXPECT_LT(count_of(two, "lights touching"), count_of(one, "lights touching"));
}

TEST(ExhaustiveTiledLighting, FiltersShadowsItselfAsTheShadowStageDoes) {
    const Frame frame = at_most_96("spot_and_box", 1);
    const ReferenceImage image = in_double(lit(frame, tiled_lighting).images.at("light"));
    const ReferenceImage itself = in_double(lit(frame, tiled_lighting, {"shadows=inline"}).images.at("light"));
    double brightest = 0, sum = 0;
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        brightest = std::max(brightest, image.texels[i].x);
        sum += std::pow(image.texels[i].x - itself.texels[i].x, 2);
    }
    // Positions are the G-buffer's here and the depth image's there: a penumbra's texels round differently.
    EXPECT_LT(std::sqrt(sum / double(image.texels.size())), .02 * brightest);
    EXPECT_GT(brightest, 0);
}

}  // namespace
}  // namespace strata
