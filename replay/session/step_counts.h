// How often the shaders of each step ran, by running them.
#pragma once

#include <optional>
#include <vector>

#include "replay/session/session.h"

namespace strata {

struct StepCounts {
    /// Of fragment and compute shaders, by step of Session::plan(); nothing where the device does not count.
    std::vector<std::optional<std::uint64_t>> invocations;
    std::vector<CounterRecord> counters;  ///< what techniques counted themselves
};

/// Runs the frame once, everything executed.
Result<StepCounts> count_steps(Session&, const Request&);

}  // namespace strata
