// How our values are called in what tests print.
#pragma once

#include <iosfwd>
#include <string>

#include "capture_format/result.h"
#include "passes/technique.h"

namespace strata {

void PrintTo(const Error&, std::ostream*);
void PrintTo(const Technique&, std::ostream*);

/// A technique's name, or a text that begins with one, as part of a test's name: "transparency_voxel".
std::string as_identifier(std::string text);

}  // namespace strata
