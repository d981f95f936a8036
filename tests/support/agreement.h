// Whether a technique's result is what its model in double says.
#pragma once

#include <string_view>

#include "tests/support/session.h"

namespace strata {

/// Expects errors within the tolerance of the request's settings, on a scenario if it is one, and records them: in what
/// --gtest_output=json:FILE writes, a test has a property "technique settings on scenario at samples" for each.
void expect_within_tolerance(const Accuracy&, const Technique&, const Request&, std::string_view scenario = {});

/// Of session_of_scenarios(): and enough texels that prove something.
void expect_proven_within_tolerance(const Accuracy&, const Technique&, const Request&, std::string_view scenario);

}  // namespace strata
