// A declaration and what its execution gave as the plain values of a Run.
#pragma once

#include "replay/declaration.h"
#include "replay/gpu/executor.h"
#include "replay/session.h"

namespace strata {

/// Everything about a run that is known before it.
Run describe_run(const Declaration&);
/// What the techniques counted; one that acts at several stages counts in each.
std::vector<CounterRecord> read_counters(const Declaration&, const Execution&);
/// Spreads over repeats of the milliseconds of each step.
void add_times(Run&, const std::vector<std::vector<double>>& repeats);
/// "technique key=value ..."
std::string choice_line(const Choice&);

}  // namespace strata
