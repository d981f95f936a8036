// What ratios and tables have in common: which variants a frame can run, and the time of some of their steps.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "replay/report/variants.h"
#include "replay/session/session.h"

namespace strata {

/// Fails (usage) for a variant whose stage the frame does not need, or which cannot do what is in it.
Result<void> check_can_run(Session&, const Variant&);

/// The time of the technique's steps whose names have one of the parts, or of all where there are none, repeat by repeat; nothing
/// where it has no such step.
std::vector<double> times_of_steps(const Run&, std::string_view technique, std::span<const std::string_view> parts);

}  // namespace strata
