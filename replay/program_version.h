// What the program calls itself in what it writes.
#pragma once

#include <string>

#include "replay/revision.h"

namespace strata {

/// "strata 0.1.0 REVISION".
inline std::string program_version() { return std::string("strata 0.1.0 ") + tool_revision; }

}  // namespace strata
