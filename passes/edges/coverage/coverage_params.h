// Parameters of the coverage test.
#pragma once

#include <cstdint>

namespace strata::edges {

inline constexpr std::uint32_t coverage_alone = 0;
inline constexpr std::uint32_t coverage_and_depth = 1;
inline constexpr std::uint32_t coverage_and_material = 2;
inline constexpr std::uint32_t coverage_and_both = 3;

struct CoverageParams {
    std::uint32_t with_tests;
    float depth_step;
    float color_step;
};

}  // namespace strata::edges
