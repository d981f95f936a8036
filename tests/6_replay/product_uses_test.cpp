// What frames make and read: watching changes no pixel, and counts are those that pictures show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "captures/scenarios.h"
#include "replay/images/image_io.h"
#include "replay/session/product_uses.h"
#include "tests/support/session.h"

namespace strata {
namespace {

struct WatchedView {
    std::string scenario;
    std::uint32_t samples = 1;
    std::vector<std::string> uses = {};
    EyeMove eye = {};
};
void PrintTo(const WatchedView& view, std::ostream* out) { *out << view.scenario; }

Request request_of(const WatchedView& view, std::uint32_t divisor) {
    Request request = on_scenario(view.scenario, view.samples);
    if (!view.uses.empty()) request.choices = chosen(view.uses);
    request.variant.eye = view.eye;
    request.variant.extent_divisor = divisor;
    request.outputs = {"display", "depth_layers"};
    request.once = true;
    return request;
}

const ProductUse* find(const ProductUses& uses, std::string_view name) {
    const auto found = std::ranges::find(uses.products, name, &ProductUse::name);
    return found == uses.products.end() ? nullptr : &*found;
}

class WatchedFrames : public testing::TestWithParam<WatchedView> {
protected:
    static void expect_the_same_pixels(std::uint32_t divisor) {
        const Request request = request_of(GetParam(), divisor);
        session_of_scenarios().forget_memo();  // what is kept from another frame is not counted again
        const auto plain = must(session_of_scenarios().run(request));
        const ProductUses watched = must(product_uses(session_of_scenarios(), request));
        for (const auto& [name, image] : plain.images) EXPECT_EQ(hash_of(image), hash_of(watched.run.images.at(name))) << name;
        for (const CounterRecord& counter : plain.counters)
            EXPECT_TRUE(std::ranges::any_of(watched.run.counters,
                                            [&](const CounterRecord& same) {
                                                return same.technique == counter.technique && same.name == counter.name &&
                                                       same.value == counter.value;
                                            }))
                << counter.technique << ' ' << counter.name;
        for (const ProductUse& use : watched.products) {
            EXPECT_LE(use.made, use.units) << use.name;
            EXPECT_LE(use.read, use.made) << use.name;
        }
        EXPECT_EQ(find(watched, "display")->read, find(watched, "display")->units);
    }
};
class ExhaustiveWatchedFrames : public WatchedFrames {};

TEST_P(WatchedFrames, GiveThePixelsAndCountsOfFramesWithoutMarks) { expect_the_same_pixels(8); }
TEST_P(ExhaustiveWatchedFrames, GiveThePixelsAndCountsOfFramesWithoutMarks) { expect_the_same_pixels(2); }

std::vector<WatchedView> every_scenario() {
    std::vector<WatchedView> all;
    for (const Scenario& scenario : scenarios()) all.push_back({std::string(scenario.name)});
    return all;
}

INSTANTIATE_TEST_SUITE_P(Views, WatchedFrames,
                         testing::Values(WatchedView{"two_rooms"}, WatchedView{"roof_in_rain", 4},
                                         WatchedView{"glass_and_smoke", 1, {"transparency/voxel"}},
                                         WatchedView{"spot_and_box", 4, {"shadows/min_max", "lighting/tiled"}}));
INSTANTIATE_TEST_SUITE_P(Views, ExhaustiveWatchedFrames, testing::ValuesIn(every_scenario()));

TEST(ProductUses, OfLightAreThePixelsThatShowASurface) {
    const ProductUses uses = must(product_uses(session_of_scenarios(), request_of({"two_rooms"}, 2)));
    const HostImage& depth = uses.run.images.at("depth_layers");
    std::uint64_t surfaces = 0;
    for (std::uint32_t y = 0; y < depth.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < depth.shape.extent.width; ++x) surfaces += texel(depth, x, y).x > 0;
    ASSERT_GT(surfaces, 100u);
    ASSERT_LT(surfaces, std::uint64_t{depth.shape.extent.width} * depth.shape.extent.height);
    EXPECT_EQ(find(uses, "light")->read, surfaces);
    EXPECT_EQ(find(uses, "depth")->made, surfaces);
}

TEST(ProductUses, OfAViewTurnedAwayAreNoShadowMaps) {
    const ProductUses facing = must(product_uses(session_of_scenarios(), request_of({"two_rooms"}, 4)));
    const ProductUses away = must(product_uses(session_of_scenarios(), request_of({"two_rooms", 1, {}, {.pan = 3.14}}, 4)));
    const auto light = [](const ProductUses& uses) {
        std::uint64_t made = 0;
        for (const ProductUse& use : uses.products)
            if (use.name.starts_with("injected light")) made += use.made;
        return made;
    };
    EXPECT_GT(light(facing), 0u);
    EXPECT_EQ(light(away), 0u);
    EXPECT_GT(find(facing, "shadow_maps")->read, 0u);
    EXPECT_LT(find(facing, "shadow_maps")->read, find(facing, "shadow_maps")->made);
    EXPECT_EQ(find(away, "shadow_maps"), nullptr);
}

TEST(ProductUses, OfAFrameThatFollowsItselfAreNoLightInjected) {
    Request request = request_of({"two_rooms"}, 4);
    request.unchanged = true;
    const ProductUses uses = must(product_uses(session_of_scenarios(), request));
    EXPECT_EQ(find(uses, "injected light of grid 0")->made, 0u);
    EXPECT_TRUE(find(uses, "light of kept grid 0")->is_remembered);
}

}  // namespace
}  // namespace strata
