// The tests of two samples' surfaces in double, for models of techniques that make them.
#pragma once

#include <cstdint>
#include <functional>

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::edges {

/// What a model says of a pixel; undecided where a float may fall on the other side of a limit.
enum class Verdict { plain, edge, undecided };
inline Verdict verdict_of(bool is_edge) { return is_edge ? Verdict::edge : Verdict::plain; }

/// Limits as parameters have them: degrees, shares, sums. Tests are bits of edges.shared.h.
struct ModelLimits {
    double normal_angle = 8, depth_step = 0.01, color_step = 0.1;
    std::uint32_t tests = 0;
};

/// Edge where only some samples have a surface; else what the tests of samples against sample 0 say.
Verdict surface_verdict(const StageInput&, std::uint32_t x, std::uint32_t y, const ModelLimits&);

/// How many samples of the pixel have a surface.
std::uint32_t covered_samples(const StageInput&, std::uint32_t x, std::uint32_t y);

/// "edges" of a verdict per pixel; nothing at one sample.
ImageSet marked(const StageInput&, const std::function<Verdict(std::uint32_t x, std::uint32_t y)>&);

}  // namespace strata::edges
