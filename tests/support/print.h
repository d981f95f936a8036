// PrintTo for our values.
#pragma once

#include <iosfwd>

#include "capture_format/result.h"
#include "passes/technique.h"

namespace strata {

void PrintTo(const Error&, std::ostream*);
void PrintTo(const Technique&, std::ostream*);

}  // namespace strata
