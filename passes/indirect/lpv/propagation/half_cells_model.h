// Cells that hold half floats, in double: every number that is stored is rounded to the nearest one (docs/algorithms/lighting.md
// 7, N13). A unit is a power of two, so that scaling rounds nothing.
#pragma once

#include <cstdint>

#include "passes/indirect/lpv/propagation/propagation_model.h"

namespace strata::indirect::in_double {

/// The places of halves: the brightest l0 that is injected lies between 128 and 256 in what is summed over steps, between 4096
/// and 8192 in what one step holds.
class HalfCells {
public:
    explicit HalfCells(const Field& injected);

    /// What cells hold before a step, as it is stored: with propagation_energy_true what each of them sends.
    Channel before_step(const Channel&, const PropagationRule&) const;
    /// A sum over steps.
    Channel summed(const Channel&) const;

private:
    int exponent_ = 0;  ///< of the brightest injected l0
};

/// The links of the first step and of those after it.
struct StepLinks {
    const Links &first, &later;
};

/// What the first step sends on, and what the sum over steps begins with.
struct FirstLight {
    const Channel &injected, &shown;
};

/// The sum of what is shown at first and of what every step gives, all of it as halves keep it.
Channel propagated_in_halves(const StepLinks&, const HalfCells&, const FirstLight&, const PropagationRule&,
                             std::uint32_t iterations);

}  // namespace strata::indirect::in_double
