// Partial coverage where surfaces are masked, by whichever mode: read off the depths that the G-buffer has.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passes/edges/surface_tests_model.h"
#include "passes/reference/fragments.h"

namespace strata::edges {

/// A triangle in a pixel: bits of samples, and its depths there.
struct Covering {
    std::uint32_t draw = 0, triangle = 0, covered = 0;
    bool is_masked = false;
    bool is_fractional = false;  ///< masked, and its alpha at the pixel's center is between 0 and 1
    std::array<double, 4> depth{}, tolerance{};
};

bool has_masks(const Frame&);

/// A triangle is there where its depth is the sample's, and cut out where it is nearer than that. A pixel is an edge where a
/// triangle that is there does not cover all samples. Undecided: what lies behind others, whose masks no depth tells; surfaces of
/// one depth; and alpha between 0 and 1 that covers all samples, which the technique marks where it cannot know that.
Verdict verdict_by_depth(const std::vector<Covering>&, const StageInput&, glm::uvec2 pixel);

}  // namespace strata::edges
