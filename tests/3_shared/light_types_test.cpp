// What shaders say of a type of light is what the table of a capture's types says.
#include <gtest/gtest.h>

#include "capture_format/light_types.h"
#include "passes/shaders/light_types.shared.h"

namespace strata {
namespace {

TEST(LightTypesInGlsl, HaveThePropertiesOfTheTable) {
    for (const LightTypeFacts& row : light_type_table) {
        const auto type = static_cast<uint>(row.type);
        EXPECT_EQ(light_has_range(type), has_range(row.type)) << row.title;
        EXPECT_EQ(light_is_spot(type), is_spot(row.type)) << row.title;
        EXPECT_EQ(light_has_area(type), is_area(row.type)) << row.title;
        EXPECT_EQ(light_is_flat(type), is_flat(row.type)) << row.title;
        EXPECT_EQ(light_has_round_cone(type), row.cone == LightCone::round) << row.title;
        EXPECT_EQ(light_has_square_cone(type), row.cone == LightCone::square) << row.title;
    }
}

}  // namespace
}  // namespace strata
