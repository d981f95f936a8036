// A declaration and what its execution gave as the plain values of a Run.
#pragma once

#include "replay/gpu/executor.h"
#include "replay/session/declaration.h"
#include "replay/session/session.h"

namespace strata {

/// Everything about a run that is known before it.
Run describe_run(const Declaration&);
/// The outputs asked for, as far as the run got.
std::map<std::string, HostImage> images_of(const Declaration&, const Execution&);
NumberTable table_of(const DebugTable&, const HostImage&);
/// The tables asked for.
std::map<std::string, NumberTable> tables_of(const Declaration&, const Execution&);
/// What the techniques counted in this execution, or in the steps of one scope.
std::vector<CounterRecord> read_counters(const Declaration&, const Execution&, std::optional<std::uint32_t> scope = {});
/// The execution, unless a technique counted what makes its picture wrong (Counter::is_fatal).
Result<Execution> without_fatal_counts(const Declaration&, Execution);
/// Techniques that counted too little: a step that counts was left out, or comes after the last one to run.
std::set<std::string> not_counted(const Declaration&, std::optional<std::size_t> until);
/// A technique that runs at several stages counts in each: equal counters are added up.
std::vector<CounterRecord> summed(std::vector<CounterRecord>);
/// The counters of a run: of this execution and of the passes that the memo kept, without the techniques of not_counted().
std::vector<CounterRecord> run_counters(const Declaration&, const Execution&, std::optional<std::size_t> until = {});
/// By stage: what the host sorted for it in each repeat, in milliseconds.
using SortTimes = std::map<std::string, std::vector<double>>;
/// How often shaders ran.
void add_invocations(Run&, const std::vector<StepCost>&);
/// Spreads over repeats of the milliseconds of each step, and of what was sorted.
void add_costs(Run&, const std::vector<std::vector<StepCost>>& repeats, const SortTimes&);
/// The techniques of the frame's passes that cannot do one of its features.
std::vector<UnsupportedChoice> not_supported(const Declaration&, const Features&);
/// What the techniques of the frame's passes say of it (Technique::notes).
std::vector<std::string> notes_of_techniques(const Declaration&);
/// "technique key=value ..."
std::string choice_line(const Choice&);

}  // namespace strata
