// Which columns of a sheet a format for people shows.
#pragma once

#include <vector>

#include "replay/tables/sheet.h"

namespace strata {

/// By index, in their order, without those that no row has (Described::if_any).
std::vector<std::size_t> shown_columns(const Sheet&, Place);

}  // namespace strata
