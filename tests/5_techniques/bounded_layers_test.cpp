// What transparency/k_buffer, a_buffer and depth_peeling count, lose and store, on cards whose fragments can be counted by hand.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/transparency/a_buffer/model.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

constexpr std::uint32_t extent = 16, pixels = extent * extent;

/// So many black cards of alpha `a` over each other, far ones submitted first, before a white wall.
Frame stack_of_cards(std::uint32_t count, float alpha) {
    std::vector<Card> cards{{.center = {0, 0, 9}}};
    for (std::uint32_t i = count; i > 0; --i) cards.push_back({.center = {0, 0, 1 + .02 * i}, .color = {0, 0, 0, alpha}});
    Frame frame = frame_of_cards(cards, extent);
    frame.materials[0].alpha_mode = AlphaMode::opaque;
    frame.materials[0].double_sided = true;  // the eye sees the cards' backs
    return frame;
}

Run run_on(Frame frame, std::string technique, std::vector<std::string> sets, std::string output = "color") {
    const auto session = session_of({std::move(frame)});
    return must(session->run({.choices = chosen({std::move(technique)}, std::move(sets)), .outputs = {std::move(output)}}));
}

TEST(ABufferOnDevice, CountsMoreFragmentsThanItsEightBitsHold) {
    // Wrapped at 256, the count would let fragments 257 to 265 into the first nine slots.
    const auto run = run_on(stack_of_cards(300, .01f), "transparency/a_buffer", {});
    EXPECT_EQ(counted(run, "fragments"), 300u * pixels);
    EXPECT_EQ(counted(run, "overflow"), 291u * pixels);
    const double through = texel(run.images.at("color"), 3, 5).x;
    EXPECT_NEAR(through, std::pow(252. / 255, 9) * std::pow(.99, 291), 1e-5) << ".99 is stored as 252 of 255";
}

TEST(KBufferOnDevice, CountsWhatFallsOutWhateverBecomesOfIt) {
    for (const char* tail : {"tail=drop", "tail=blend", "tail=hybrid"}) {
        const auto run = run_on(stack_of_cards(40, .5f), "transparency/k_buffer", {tail});
        EXPECT_EQ(counted(run, "fragments"), 40u * pixels);
        EXPECT_EQ(counted(run, "displaced"), 32u * pixels);
        // Far to near: each is in front of all others and goes through every slot that is taken, and one more.
        EXPECT_EQ(counted(run, "atomics"), (1 + 2 + 3 + 4 + 5 + 6 + 7 + 33 * 8) * pixels);
    }
}

TEST(KBufferOnDevice, SpendsNoAtomicOnWhatIsBehindItsLastSlot) {
    Frame frame = stack_of_cards(40, .5f);
    std::reverse(frame.draws.begin() + 1, frame.draws.end());
    const auto run = run_on(frame, "transparency/k_buffer", {});
    EXPECT_EQ(counted(run, "displaced"), 32u * pixels);
    EXPECT_EQ(counted(run, "atomics"), (1 + 2 + 3 + 4 + 5 + 6 + 7 + 8) * pixels);
}

TEST(DepthPeelingOnDevice, ShadesEverythingInEveryPass) {
    const auto run = run_on(stack_of_cards(40, .5f), "transparency/depth_peeling", {"passes=5"});
    EXPECT_EQ(counted(run, "fragments"), 5 * 40u * pixels);
    EXPECT_EQ(counted(run, "peeled"), 5u * pixels);
}

TEST(DepthPeelingOnDevice, DrawsNothingAfterAPassThatFoundNothing) {
    const auto run = run_on(stack_of_cards(3, .5f), "transparency/depth_peeling", {"passes=64"});
    EXPECT_EQ(counted(run, "fragments"), 4 * 3u * pixels) << "the fourth pass finds nothing, and there is no fifth";
    EXPECT_EQ(counted(run, "peeled"), 3u * pixels);
}

TEST(DepthPeelingOnDevice, LosesOneOfTwoCoincidentCards) {
    // A failure of the technique: half of the wall shows where a quarter should. The card submitted last is the one that is left.
    for (const float last : {0.f, 1.f}) {
        Frame frame = stack_of_cards(2, .5f);
        frame.draws[1].to_world = frame.draws[2].to_world;
        frame.materials[1].base_color = glm::vec4(glm::vec3(1 - last), .5f);
        frame.materials[2].base_color = glm::vec4(glm::vec3(last), .5f);
        const double exact = .5 * double(last) + .25 * double(1 - last) + .25;
        EXPECT_NEAR(texel(run_on(frame, "transparency/sorted_lists", {}).images.at("color"), 7, 7).x, exact, 1e-6);
        const auto run = run_on(frame, "transparency/depth_peeling", {});
        EXPECT_NEAR(texel(run.images.at("color"), 7, 7).x, .5 * double(last) + .5, 1e-6);
        EXPECT_EQ(counted(run, "peeled"), pixels);
    }
}

TEST(LayersBeyond, AreShownByEveryTechniqueThatKeepsSome) {
    for (const auto& [view, set, beyond] : {std::tuple("transparency/k_buffer:beyond", "layers=3", 37.),
                                            std::tuple("transparency/a_buffer:overflow", "layers=16", 24.),
                                            std::tuple("transparency/depth_peeling:beyond", "passes=64", 0.)}) {
        const std::string technique(view, std::string_view(view).find(':'));
        const auto run = run_on(stack_of_cards(40, .5f), technique, {set}, view);
        EXPECT_EQ(texel(run.images.at(view), 2, 9), glm::dvec4(beyond, beyond, beyond, 1)) << view;
    }
}

TEST(BoundedLayers, OrderByTheOffsetDepthAndHideByTheSurfaces) {
    // A white puff behind a black pane, brought before it, even before the eye; and one behind the wall, where it stays.
    for (const float offset : {3.f, 20.f})
        for (const char* technique : {"transparency/k_buffer", "transparency/a_buffer", "transparency/depth_peeling"}) {
            Frame frame =
                frame_of_cards(std::array{Card{.center = {0, 0, 6}}, Card{.center = {0, 0, 3}, .color = {0, 0, 0, .5}}}, extent);
            frame.materials[0].alpha_mode = AlphaMode::opaque;
            frame.materials[0].double_sided = true;
            const Particle puff{.center = {0, 0, 5}, .size = 20, .color = glm::vec3(1), .alpha = .5f, .depth_offset = offset};
            frame.emitters.push_back({.name = "smoke", .particles = {puff, puff}});
            frame.emitters[0].particles[1].center.z = 8;
            const auto run = run_on(frame, technique, {});
            EXPECT_NEAR(texel(run.images.at("color"), 4, 4).x, .75, 3e-3) << technique << " by " << offset;
        }
}

/// Numbers of every size the formats have, some halfway between two of theirs, and some beyond them.
std::vector<float> numbers_to_round() {
    std::vector<float> numbers{0,        1,          .1f,   .5f,   1 + 0x1p-7f, 1 + 0x1p-6f, 1 - 0x1p-8f,
                               0x1p-14f, 0x1.8p-20f, 65024, 65500, 1e6f,        -3};
    std::mt19937 random(3);
    while (numbers.size() < 4096)
        numbers.push_back(std::ldexp(1 + float(random() >> 8) * 0x1p-24f, static_cast<int>(random() % 40) - 23));
    return numbers;
}

/// What an image of the format holds after `value` was stored in it, a number x per texel.
std::vector<glm::dvec4> stored(Format format, const std::string& value) {
    TestFrame frame;
    frame.shader("store.comp", R"(
        #include "passes/transparency/a_buffer/rounding.glsl"
        layout(local_size_x = 64) in;
        layout(set = 0, binding = 0, scalar) readonly buffer Numbers { float numbers[]; };
        layout(set = 0, binding = 1) writeonly uniform image2DArray target;
        void main() {
            const float x = numbers[gl_GlobalInvocationID.x];
            imageStore(target, ivec3(gl_GlobalInvocationID.x, 0, 0), )" +
                                   value + "); }");
    const std::vector<float> numbers = numbers_to_round();
    const auto count = static_cast<std::uint32_t>(numbers.size());
    Image target = frame.graph.create("stored", {.extent = {count, 1}, .format = format});
    frame.graph.compute("store.comp")
        .loads("Numbers", import_values(frame.graph, "numbers", ImportId{0xab0f}, numbers))
        .stores("target", target)
        .over({count, 1});
    return in_double(frame.result(target)).texels;
}

TEST(ABufferOnDevice, StoresNumbersAsItRoundedThem) {
    const auto colors = stored(Format::r11g11b10f, "vec4(rounded_r11g11b10(vec3(x)), 1.0)");
    const auto depths = stored(Format::r16f, "vec4(rounded_half(x))"),
               coverages = stored(Format::r8_unorm, "vec4(rounded_unorm8(x))");
    const std::vector<float> numbers = numbers_to_round();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double x = double(numbers[i]);
        EXPECT_EQ(glm::dvec3(colors[i]), transparency::nearest_r11g11b10(glm::dvec3(x))) << x;
        EXPECT_EQ(depths[i].x, transparency::nearest_half(x)) << x;
        EXPECT_NEAR(coverages[i].x, transparency::nearest_unorm8(x), 1e-12) << x;
    }
}

}  // namespace
}  // namespace strata
