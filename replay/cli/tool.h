// The command line: one verb per file, one row per verb. JSON and tables go to stdout, everything else to stderr.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "replay/cli/verb.h"

namespace strata {

/// Runs the verb that the arguments name, of those given; the program's exit code.
int run_tool(std::vector<std::string> arguments, std::span<const Verb> verbs);

}  // namespace strata
