// Facts of how large maps are and where they lie.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/scene/map_places.h"
#include "passes/shadows/kernel.h"

namespace strata::shadows {

namespace {

std::vector<ShadowView> views_of(std::initializer_list<std::uint32_t> sizes) {
    std::vector<ShadowView> views;
    for (const std::uint32_t size : sizes) views.push_back({.size = size});
    return views;
}

bool overlap(const ShadowView& a, const ShadowView& b) {
    const auto apart = [](std::uint32_t a_at, std::uint32_t a_size, std::uint32_t b_at, std::uint32_t b_size) {
        return a_at + a_size <= b_at || b_at + b_size <= a_at;
    };
    return a.layer == b.layer && !apart(a.offset.x, a.size, b.offset.x, b.size) && !apart(a.offset.y, a.size, b.offset.y, b.size);
}

/// A camera at the origin with square pixels that looks along -z of the world; at 1 m the picture is 2 m high.
Frame looking() {
    Frame frame;
    frame.view.width = 200;
    frame.view.height = 100;
    frame.view.to_view = glm::dmat3({1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    frame.view.projection = perspective(2 * std::atan(1.0), 2, 0.1);
    return frame;
}

Light lamp(glm::dvec3 position, float range) {
    return {.position = position, .range = range, .shadow = {.casts = true, .map_size = 512}};
}

}  // namespace

TEST(map_places, of_own_maps_are_layers) {
    auto views = views_of({512, 64, 1024});
    place_maps(views, Allocation::own);
    EXPECT_EQ(views[2].layer, 2u);
    EXPECT_EQ(views[2].offset, glm::uvec2(0));
    EXPECT_EQ(map_layers(views).extent, 1024u);
    EXPECT_EQ(map_layers(views).layers, 3u);
}

TEST(map_places, of_needed_maps_fill_layers_without_gaps_or_overlaps) {
    auto views = views_of({64, 256, 128, 32, 32, 128, 64, 256, 64, 32, 128, 32, 64, 64});
    place_maps(views, Allocation::need);
    std::uint32_t texels = 0;
    for (std::size_t a = 0; a < views.size(); ++a) {
        texels += views[a].size * views[a].size;
        for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(overlap(views[a], views[b])) << a << " and " << b;
    }
    const MapLayers in = map_layers(views);
    EXPECT_EQ(in.extent, 256u);
    EXPECT_EQ(in.layers, (texels + 65535) / 65536);
    EXPECT_EQ(views[1].layer, 0u);  // the largest come first
    EXPECT_EQ(views[7].layer, 1u);
    EXPECT_EQ(views[2].offset, glm::uvec2(0, 0));
    EXPECT_EQ(views[5].offset, glm::uvec2(128, 0));
    EXPECT_EQ(views[10].offset, glm::uvec2(0, 128));
}

TEST(map_places, leave_a_map_that_is_no_power_of_two_its_size_and_the_place_of_the_next_one) {
    auto views = views_of({100, 100, 64});
    place_maps(views, Allocation::need);
    EXPECT_EQ(views[1].layer, 1u);
    EXPECT_EQ(views[2].layer, 2u);
    EXPECT_EQ(map_layers(views).extent, 100u);
}

TEST(map_places, keep_lookups_at_a_rim_from_the_map_beside_it) {
    ReferenceImage maps(64, 64);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 32; x < 64; ++x) maps.at(x, y).x = 1;  // the map on the right is covered
    for (const bool is_face : {false, true}) {
        const Lookup rim{.size = 32, .u = {31.9, 16}, .depth = 0.5, .is_face = is_face};
        EXPECT_EQ(filter_map(maps, rim, 8).lit, 1);
    }
    const Lookup covered{.size = 32, .u = {0.1, 16}, .depth = 0.5, .offset = {32, 0}, .is_face = true};
    EXPECT_EQ(filter_map(maps, covered, 8).lit, 0) << "beyond a face's edge its outermost texels go on";
}

TEST(needed_maps, have_a_texel_per_pixel_of_the_lights_reach) {
    const Frame frame = looking();
    // Tangents from 10 m at a sphere of 1 m: slopes of 1 / sqrt(99); 50 pixels per slope: 10.05 wide.
    EXPECT_EQ(needed_size(frame, lamp({0, 0, -10}, 1)), 32u);
    // 4 m: 2 * 4 / sqrt(84) * 50 = 43.6
    EXPECT_EQ(needed_size(frame, lamp({0, 0, -10}, 4)), 64u);
    // 8 m: 2 * 8 / 6 * 50 = 133.3
    EXPECT_EQ(needed_size(frame, lamp({0, 0, -10}, 8)), 256u);
    // Off the axis a sphere is wider: 2 * 4 sqrt(36 + 100 - 16) / 84 * 50 = 52.2, and 12 m: 2 * 4 sqrt(144 + 100 - 16) / 84 * 50
    // = 71.9
    EXPECT_EQ(needed_size(frame, lamp({6, 0, -10}, 4)), 64u);
    EXPECT_EQ(needed_size(frame, lamp({12, 0, -10}, 4)), 128u);
}

TEST(needed_maps, are_no_larger_than_asked_for_and_as_large_where_the_light_reaches_the_eye) {
    Frame frame = looking();
    EXPECT_EQ(needed_size(frame, lamp({0, 0, -10}, 9.8f)), 512u);
    EXPECT_EQ(needed_size(frame, lamp({0, 0, -10}, 12)), 512u);
    EXPECT_EQ(needed_size(frame, lamp({0, 0, 20}, 3)), smallest_needed_map) << "behind the eye";
    Light odd = lamp({0, 0, -10}, 8);
    odd.shadow.map_size = 200;
    EXPECT_EQ(needed_size(frame, odd), 200u);
    odd.shadow.map_size = 7;
    EXPECT_EQ(needed_size(frame, odd), 7u);
}

TEST(needed_maps, are_of_the_same_lights_in_the_same_slots) {
    Frame frame = looking();
    frame.sun.irradiance = {1, 1, 1};
    frame.sun.shadow = {.casts = true, .map_size = 512};
    frame.lights = {lamp({0, 0, -10}, 1), lamp({0, 0, -10}, 4)};
    const auto own = shadow_views(frame), need = shadow_views(frame, Allocation::need);
    ASSERT_EQ(own.size(), 3u + 6u + 6u);
    ASSERT_EQ(need.size(), own.size());
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(need[i].light, own[i].light);
    EXPECT_EQ(need[2].size, 512u) << "a cascade is of the whole view";
    EXPECT_EQ(need[3].size, 32u);
    EXPECT_EQ(need.back().size, 64u);
    EXPECT_EQ(map_layers(own).layers, 15u);
    EXPECT_EQ(map_layers(need).layers, 4u);
}

}  // namespace strata::shadows
