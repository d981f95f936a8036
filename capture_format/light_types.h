// What is true of each type of light, a row each: what shines, what narrows it, what bounds its reach, which shadow maps it has.
// Code asks for a property and names no type, so that a new type is a row here. Only facts are shared: shaders, models and truths
// have formulas of their own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "capture_format/frame/light.h"

namespace strata {

/// The source of the light. A point has no size; parallel light has no position and no range.
enum class LightShape : std::uint8_t { point, tube, sphere, disc, rectangle, parallel };
/// What narrows the light of a point: nothing, the cone of a round spot, the pyramid of a square one.
enum class LightCone : std::uint8_t { none, round, square };
/// Volume around everything that the light reaches, within its range: what culling tests.
enum class LightBounds : std::uint8_t { everywhere, sphere, round_cone, pyramid, half_sphere, half_box };
/// Shadow maps of a light of Frame::lights: none, one along its direction, one for each face of a cube. The sun has cascades.
enum class LightMaps : std::uint8_t { none, one, six };

struct LightTypeFacts {
    LightType type;
    std::string_view title;  ///< what sentences call it
    LightShape shape;
    LightCone cone;
    LightBounds bounds;
    LightMaps maps;
    bool shows_picture;  ///< projects or emits Light::texture
};

/// In the order of LightType.
inline constexpr std::array light_type_table = {
    LightTypeFacts{LightType::omni, "omni light", LightShape::point, LightCone::none, LightBounds::sphere, LightMaps::six, false},
    LightTypeFacts{LightType::round_spot, "round spot", LightShape::point, LightCone::round, LightBounds::round_cone,
                   LightMaps::one, true},
    LightTypeFacts{LightType::square_spot, "square spot", LightShape::point, LightCone::square, LightBounds::pyramid,
                   LightMaps::one, true},
    LightTypeFacts{LightType::tube, "tube", LightShape::tube, LightCone::none, LightBounds::sphere, LightMaps::none, false},
    LightTypeFacts{LightType::sphere, "sphere", LightShape::sphere, LightCone::none, LightBounds::sphere, LightMaps::six, false},
    LightTypeFacts{LightType::disc, "disc", LightShape::disc, LightCone::none, LightBounds::half_sphere, LightMaps::none, false},
    LightTypeFacts{LightType::rectangle, "rectangle", LightShape::rectangle, LightCone::none, LightBounds::half_box,
                   LightMaps::none, true},
    LightTypeFacts{LightType::directional, "directional light", LightShape::parallel, LightCone::none, LightBounds::everywhere,
                   LightMaps::none, false},
};
inline constexpr LightType last_light_type = light_type_table.back().type;
static_assert(
    [] {
        for (std::size_t i = 0; i < light_type_table.size(); ++i)
            if (light_type_table[i].type != static_cast<LightType>(i)) return false;
        return true;
    }(),
    "one row per type, in order");

/// The row of a type. A number that is no type has the first row: check_frame() refuses such a light.
constexpr const LightTypeFacts& facts_of(LightType type) {
    const auto index = static_cast<std::size_t>(type);
    return light_type_table[index < light_type_table.size() ? index : 0];
}

/// Whether the light has a position, and ends at its range.
constexpr bool has_range(LightType type) { return facts_of(type).shape != LightShape::parallel; }
/// Whether it shines around its direction alone, between two angles.
constexpr bool is_spot(LightType type) { return facts_of(type).cone != LightCone::none; }
/// Whether it shines from a surface.
constexpr bool is_area(LightType type) { return has_range(type) && facts_of(type).shape != LightShape::point; }
/// Whether that surface is flat, and shines from its front alone.
constexpr bool is_flat(LightType type) {
    return facts_of(type).shape == LightShape::disc || facts_of(type).shape == LightShape::rectangle;
}
/// Whether Light::direction means anything.
constexpr bool has_direction(LightType type) { return is_spot(type) || is_flat(type) || !has_range(type); }

}  // namespace strata
