// The radii within which surfaces occlude ambient light. Each has a truth of its own, so that every setting of a technique is
// held against what it approximates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace strata::occlusion {

inline constexpr std::array<double, 4> radii = {0.5, 1, 2, 4};  // meters
inline constexpr std::array<std::string_view, 4> radius_names = {"50cm", "1m", "2m", "4m"};
/// 50 cm: what occludes within it is nearly always in the picture. A corner 3 m away is .02 too bright, and .08 with the 2 m that
/// X-Ray's attenuation reaches (docs/algorithms/deferred.md 8.4). Its truth is the stage's.
inline constexpr std::uint32_t default_radius = 0;

/// What the occlusion image holds besides visibility V, as the material's occlusion M multiplies it later (8.3).
enum class MaterialRule : std::uint32_t {
    product,  ///< V, so that M V arrives: both darken
    darker,   ///< min(1, V / M), so that min(M, V) arrives
};

/// Names of truths, in the order of the radii; empty: the stage's truth.
inline constexpr std::array<std::string_view, 4> product_truths = {"", "1m", "2m", "4m"};
inline constexpr std::array<std::string_view, 4> darker_truths = {"50cm, darker", "1m, darker", "2m, darker", "4m, darker"};

constexpr std::string_view truth_name(std::size_t radius, MaterialRule rule) {
    return rule == MaterialRule::product ? product_truths[radius] : darker_truths[radius];
}

}  // namespace strata::occlusion
