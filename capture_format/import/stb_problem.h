// Why stb_image gave nothing, for every importer and reader that uses it.
#pragma once

#include <string_view>

namespace strata {

/// Makes stb forget the reasons of earlier calls in this thread: stb_gave_a_reason() is then about the next call, of a PNG or
/// JPEG.
void forget_stb_problem();
bool stb_gave_a_reason();

/// The reason of the last call that failed in this thread, or the other words: of some files that end too early stb says nothing.
/// Throws std::bad_alloc where it lacked memory.
std::string_view stb_problem(std::string_view otherwise);

}  // namespace strata
