// The table of light types, said again by hand: shaders' records, models and truths believe it alike, so that no comparison of
// pictures would show a wrong row.
#include <set>

#include <gtest/gtest.h>

#include "capture_format/light_types.h"

namespace strata {
namespace {

using LightTypeSet = std::set<LightType>;

template <typename Predicate>
LightTypeSet types_that(const Predicate& holds) {
    LightTypeSet found;
    for (const LightTypeFacts& row : light_type_table)
        if (holds(row)) found.insert(row.type);
    return found;
}

const LightTypeSet every_type = types_that([](const LightTypeFacts&) { return true; });

LightTypeSet every_type_but(LightType type) {
    LightTypeSet rest = every_type;
    rest.erase(type);
    return rest;
}

TEST(LightTypes, AreEight) {
    using enum LightType;
    EXPECT_EQ(every_type.size(), 8u);
    EXPECT_EQ(last_light_type, directional);
}

TEST(LightTypes, HaveARangeUnlessTheirLightIsParallel) {
    using enum LightType;
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return has_range(row.type); }), every_type_but(directional));
}

TEST(LightTypes, ShineFromAPointASurfaceOrNowhere) {
    using enum LightType;
    const LightTypeSet areas{tube, sphere, disc, rectangle};
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return is_area(row.type); }), areas);
    const auto shape = [](LightType type) { return facts_of(type).shape; };
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return row.shape == LightShape::point; }),
              (LightTypeSet{omni, round_spot, square_spot}));
    EXPECT_EQ(shape(tube), LightShape::tube);
    EXPECT_EQ(shape(sphere), LightShape::sphere);
    EXPECT_EQ(shape(disc), LightShape::disc);
    EXPECT_EQ(shape(rectangle), LightShape::rectangle);
    EXPECT_EQ(shape(directional), LightShape::parallel);
}

TEST(LightTypes, HaveADirectionWhereTheyDoNotShineAllAround) {
    using enum LightType;
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return has_direction(row.type); }),
              (LightTypeSet{round_spot, square_spot, disc, rectangle, directional}));
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return is_flat(row.type); }), (LightTypeSet{disc, rectangle}));
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return is_spot(row.type); }), (LightTypeSet{round_spot, square_spot}));
    EXPECT_EQ(facts_of(round_spot).cone, LightCone::round);
    EXPECT_EQ(facts_of(square_spot).cone, LightCone::square);
}

TEST(LightTypes, HaveShadowMapsIfTheyAreSpotsOrShineAllAroundFromAPointOrSphere) {
    using enum LightType;
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return row.maps == LightMaps::one; }),
              (LightTypeSet{round_spot, square_spot}));
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return row.maps == LightMaps::six; }), (LightTypeSet{omni, sphere}));
}

TEST(LightTypes, ShowAPictureIfTheyAreSpotsOrRectangles) {
    using enum LightType;
    EXPECT_EQ(types_that([](const LightTypeFacts& row) { return row.shows_picture; }),
              (LightTypeSet{round_spot, square_spot, rectangle}));
}

TEST(LightTypes, AreBoundedByTheirRangeAndByWhereTheyShine) {
    using enum LightType;
    const auto bounded_by = [](LightBounds bounds) {
        return types_that([&](const LightTypeFacts& row) { return row.bounds == bounds; });
    };
    EXPECT_EQ(bounded_by(LightBounds::everywhere), LightTypeSet{directional});
    EXPECT_EQ(bounded_by(LightBounds::sphere), (LightTypeSet{omni, tube, sphere}));
    EXPECT_EQ(bounded_by(LightBounds::round_cone), LightTypeSet{round_spot});
    EXPECT_EQ(bounded_by(LightBounds::pyramid), LightTypeSet{square_spot});
    EXPECT_EQ(bounded_by(LightBounds::half_sphere), LightTypeSet{disc});
    EXPECT_EQ(bounded_by(LightBounds::half_box), LightTypeSet{rectangle});
}

TEST(LightTypes, OfAnUnknownNumberHaveTheFirstRow) { EXPECT_EQ(&facts_of(LightType{99}), &light_type_table[0]); }

}  // namespace
}  // namespace strata
