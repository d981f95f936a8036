// What is done with a file that was cut short.
#pragma once

namespace strata {

/// Whether a file that was cut short may be read up to the cut.
enum class Partial { refused, allowed };

}  // namespace strata
