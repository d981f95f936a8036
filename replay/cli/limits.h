// Limits with a unit on the command line: --error 1%, --within 2x.
#pragma once

#include <optional>
#include <string_view>

#include "capture_format/result.h"

namespace strata {

/// A number above 0 with an optional unit at its end, which stands for the factor: "1%" is .01, "2x" is 2. Empty: none. A number
/// of 1 or more without its % is refused.
Result<std::optional<double>> parse_limit(const char* option, std::string_view given, std::string_view unit, double factor);

}  // namespace strata
