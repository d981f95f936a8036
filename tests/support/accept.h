// Recorded expectations (golden images, baselines) change by an explicit command alone: STRATA_ACCEPT=1 in the environment of one
// run of the test program. That run writes what it got and fails all the same, so that nothing is accepted in passing.
#pragma once

#include <string>

namespace strata {

bool accepting();
/// The command that accepts what the running test found.
std::string command_that_accepts();

}  // namespace strata
