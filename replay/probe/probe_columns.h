// What a probe says of each fragment and each technique: the one list of columns for text, JSON, CSV and the window.
#pragma once

#include "replay/probe/probe.h"
#include "replay/tables/sheet.h"

namespace strata {

/// Nearest first.
Sheet fragments_of(const Probe&);
/// A row for each of the curves, in this order.
Sheet variants_of(std::span<const ProbeCurve* const>);

}  // namespace strata
