#include "passes/indirect/lpv/propagation/half_cells_model.h"

#include <algorithm>
#include <cmath>

#include "passes/gbuffer/codes.h"

namespace strata::indirect::in_double {
namespace {

/// As halves of a unit of 2^-scale keep it.
Channel rounded(Channel light, int scale) {
    for (glm::dvec4& cell : light)
        for (glm::length_t i = 0; i < 4; ++i) cell[i] = std::ldexp(gbuffer::nearest_half(std::ldexp(cell[i], scale)), -scale);
    return light;
}

}  // namespace

HalfCells::HalfCells(const Field& injected) {
    double brightest = 0;
    for (const Channel& channel : injected)
        for (const glm::dvec4& cell : channel) brightest = std::max(brightest, cell.x);
    if (brightest > 0) exponent_ = std::ilogb(brightest);
}

Channel HalfCells::before_step(const Channel& light, const PropagationRule& rule) const {
    Channel sent = light;
    for (glm::dvec4& cell : sent) cell *= sent_share(cell, rule);
    return rounded(sent, 12 - exponent_);
}

Channel HalfCells::summed(const Channel& light) const { return rounded(light, 7 - exponent_); }

Channel propagated_in_halves(const StepLinks& links, const HalfCells& halves, const FirstLight& first,
                             const PropagationRule& rule, std::uint32_t iterations) {
    // What is stored is scaled already.
    PropagationRule sending = rule;
    if (rule.propagation == propagation_energy_true) sending.propagation = propagation_clamped;
    Channel sum = halves.summed(first.shown), light = first.injected;
    for (std::uint32_t i = 0; i < iterations; ++i) {
        light = next_step(i == 0 ? links.first : links.later, halves.before_step(light, rule), sending);
        for (std::size_t cell = 0; cell < sum.size(); ++cell) sum[cell] += light[cell];
        sum = halves.summed(sum);
    }
    return sum;
}

}  // namespace strata::indirect::in_double
