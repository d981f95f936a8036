// Words of a line for a shell.
#pragma once

#include <string>
#include <string_view>

namespace strata {

/// In quotes whatever it holds.
std::string shell_word(std::string_view word);
/// In quotes where it needs them.
std::string as_shell_word(std::string_view word);

}  // namespace strata
