// The truth of a stage on a scenario, computed once per program however many techniques are held against it.
#pragma once

#include <optional>
#include <string>

#include "passes/technique.h"
#include "tests/support/session.h"

namespace strata {

/// Of a request made by on_scenario(). It starts from what the default techniques of the earlier stages gave.
const ImageSet& truth_of(Stage, const Request&);
/// Why the request's frame does not need the stage, or nothing.
std::optional<std::string> unneeded(const Request&, Stage);

}  // namespace strata
