// Whether a technique's result is what its model in double says.
#pragma once

#include <string_view>

#include "tests/support/session.h"

namespace strata {

/// Expects errors within the tolerance of the request's settings on the scenario, and enough texels that prove something.
void expect_within_tolerance(const Accuracy&, const Technique&, const Request&, std::string_view scenario);

}  // namespace strata
