// Interfaces in front of the world, layer by layer, whatever the depth of their surfaces (docs/algorithms/transparency.md 6.13).
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// In the order of blending, nearest first: layers 3, 2 and 1, then the world. Depths and submission say otherwise.
Frame windows() {
    const std::array cards{
        Card{.center = {0, 0, 5}, .color = {.8f, .8f, .8f, .25f}}, Card{.center = {0, 0, 2}, .color = {1, 1, 1, .5f}},
        Card{.center = {0, 0, 6}, .color = {.4f, .4f, .4f, .75f}}, Card{.center = {0, 0, 1.2}, .color = {.2f, .2f, .2f, .5f}}};
    Frame frame = frame_of_cards(cards, 16);
    frame.draws[0].layer = 2;
    frame.draws[2].layer = 3;
    frame.draws[3].layer = 1;
    return frame;
}

// .75 x .4, then .25 (.25 x .8), then .1875 (.5 x .2), then .09375 (.5 x 1).
constexpr double strictly_ordered = .3 + .05 + .01875 + .046875;

double seen_by(Session& session, const std::string& technique, std::vector<std::string> sets = {}) {
    const Run run = must(session.run({.choices = chosen({technique}, std::move(sets)), .outputs = {"color"}}));
    return texel(run.images.at("color"), 5, 9).x;
}

TEST(InterfaceLayers, AreBlendedInTheirOrderByEveryTechniqueThatHasOne) {
    const auto session = session_of({windows()});
    for (const char* exact :
         {"sorted_lists", "alpha_blend", "depth_peeling", "k_buffer", "multi_layer", "adaptive", "exact_function"})
        EXPECT_NEAR(seen_by(*session, std::string("transparency/") + exact), strictly_ordered, 5e-3) << exact;
}

TEST(InterfaceLayers, HaveAVoxelSliceEachHoweverItIsRead) {
    const auto session = session_of({windows()});
    for (const auto& [splatting, sampling] :
         {std::pair("point", "point"), std::pair("linear", "linear"), std::pair("linear", "bicubic")})
        for (const char* splat : {"splat=overflow_minimum", "splat=multiply"}) {
            std::vector<std::string> sets{std::string("splatting=") + splatting, std::string("sampling=") + sampling, splat};
            EXPECT_NEAR(seen_by(*session, "transparency/voxel", sets), strictly_ordered, 3e-3) << sampling << splat;
            sets.emplace_back("bits=16");
            EXPECT_NEAR(seen_by(*session, "transparency/voxel", sets), strictly_ordered, 5e-4) << sampling << splat;
        }
}

TEST(InterfaceLayers, TakeNoSliceFromTheWorld) {
    Frame frame = windows();
    const auto used = [](const Frame& shown) {
        const auto session = session_of({shown});
        return counted(must(session->run({.choices = chosen({"transparency/voxel"})})), "virtual slices");
    };
    frame.draws.erase(frame.draws.begin() + 2, frame.draws.end());
    frame.draws.erase(frame.draws.begin());
    EXPECT_EQ(used(windows()), used(frame)) << "the world is the same card";
}

}  // namespace
}  // namespace strata
