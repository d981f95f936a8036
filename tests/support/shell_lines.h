// Lines for a shell that show what a failed test saw: they run as they are printed, in any folder, and write into it.
#pragma once

#include <string>
#include <string_view>

#include "passes/technique.h"
#include "replay/session/session.h"

namespace strata {

/// Records the frame of a scenario that on_scenario() of tests/support/session.h asks for, into SCENARIO.strata.
std::string line_that_records(std::string_view scenario, const FrameVariant&);

/// The same, then measures the technique, at the request's settings, against its model.
std::string line_that_judges(const Technique&, const Request&, std::string_view scenario);

/// The same as the first, then replays the frame into the folder "out".
std::string line_that_replays(std::string_view scenario, const FrameVariant&);

}  // namespace strata
