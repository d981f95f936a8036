// Lights at random and what they may light, for tests of culling.
#pragma once

#include <cmath>

#include "capture_format/frame/light.h"
#include "passes/lighting/tile_cell.h"
#include "passes/shaders/light_features.shared.h"
#include "passes/shaders/scene/view.shared.h"
#include "tests/support/random_numbers.h"

namespace strata::lighting {

/// Half its height is 1 at z = 1.
inline ViewRecord view_of(glm::uvec2 extent, glm::vec2 offset = {0, 0}) {
    return {.ndc_scale = {float(extent.y) / float(extent.x), 1}, .ndc_offset = offset, .extent = extent};
}

inline LightRecord omni(const glm::vec3& position, float range) {
    return {.position = position,
            .type = static_cast<uint>(LightType::omni),
            .direction = {0, -1, 0},
            .range = range,
            .intensity = glm::vec3(1),
            .axis_u = {1, 0, 0},
            .texture = no_index,
            .features = feature_omni,
            .shadow = no_index,
            .visibility_layer = no_index};
}

inline LightRecord random_light(Numbers& numbers) {
    LightRecord light = omni(numbers.box(12) + glm::vec3(0, 0, 12), numbers.from(.5f, 15));
    light.type = numbers.below(static_cast<uint>(LightType::directional) + 1);
    light.direction = numbers.direction();
    light.axis_u = numbers.across(light.direction);
    const float outer = numbers.from(.02f, 1.5f);
    light.cos_outer = std::cos(outer);
    light.cos_inner = std::cos(outer * numbers.from(0, 1));
    light.tan_half = {std::tan(outer), std::tan(numbers.from(.02f, 1.5f))};
    return light;
}

/// Whether the light's own formulas may light the point, in double.
inline bool may_light(const LightRecord& light, const glm::dvec3& p) {
    const glm::dvec3 off = p - glm::dvec3(light.position), direction(light.direction), u(light.axis_u);
    const double d = glm::length(off), ahead = glm::dot(off, direction);
    switch (static_cast<LightType>(light.type)) {
        case LightType::directional:
            return true;
        case LightType::round_spot:
            return d < double(light.range) && ahead > double(light.cos_outer) * d;
        case LightType::square_spot:
            return d < double(light.range) && ahead > 0 && std::abs(glm::dot(off, u)) < ahead * double(light.tan_half.x) &&
                   std::abs(glm::dot(off, glm::cross(direction, u))) < ahead * double(light.tan_half.y);
        case LightType::disc:
        case LightType::rectangle:
            return d < double(light.range) && ahead > 0;
        default:
            return d < double(light.range);
    }
}

inline glm::vec3 random_point(Numbers& numbers, const ViewRecord& view, glm::uvec2 tile, glm::vec2 z) {
    const glm::vec2 first = glm::vec2(tile) * 16.f, last = glm::min(first + 16.f, glm::vec2(view.extent));
    const glm::vec2 pixel(numbers.from(first.x, last.x), numbers.from(first.y, last.y));
    return view_ray(view, pixel) * numbers.from(z.x, z.y);
}

}  // namespace strata::lighting
