// How often the shaders of each step ran, by running what that depends on.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "replay/session/session.h"

namespace strata {

/// The counter by which a technique that draws once tells how often its fragment shader ran.
inline constexpr std::string_view fragments_counter = "fragments";
/// Whether exactly one step of the scope draws.
bool draws_once(const Plan&, std::uint32_t scope);

struct StepCounts {
    /// Of fragment and compute shaders, by step of Session::plan(); nothing where the device does not count.
    std::vector<std::optional<std::uint64_t>> invocations;
    /// Invocations of fragment shaders, by step, rasterized in double where a device's count of fragments is wrong; empty for
    /// other devices. Known at one sample per pixel, where a step draws all that is transparent at the frame's extent and its
    /// shader runs behind the test against opaque depth, or without a test.
    std::vector<std::optional<std::uint64_t>> rasterized;
    std::vector<CounterRecord> counters;  ///< what techniques counted themselves
};

/// Counts what the plan does not tell. A GPU runs the frame once, everything executed. A CPU driver's count of fragments is
/// wrong, so it only runs the steps on which the arguments of indirect dispatches, opaque depth (for `rasterized`) and
/// fragments_counter depend: none where there are no such steps. Most of its time would be the making of pipelines.
Result<StepCounts> count_steps(Session&, const Request&);

}  // namespace strata
