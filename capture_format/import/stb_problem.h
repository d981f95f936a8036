// Why stb_image gave nothing, for every importer and reader that uses it.
#pragma once

#include <string_view>

namespace strata {

/// The reason of the last call that failed in this thread, or the other words: of some files that end too early stb says nothing.
/// Throws std::bad_alloc where it lacked memory.
std::string_view stb_problem(std::string_view otherwise);

}  // namespace strata
